"""Premises of a row: an instance of a rule's body that rests on earlier rows, whatever the order of its conditions.

Conditions are taken as they can be: a test as soon as its variables are known, else the look-up with the fewest rows.
So a proof costs what it is long, also where its author put the condition with many rows first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from casper.kb.errors import BudgetExceeded
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.comparison import compare, is_ready
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, unify
from casper.kb.terms.values.arithmetic import EvaluationFailed

_Open: TypeAlias = list[tuple[int, Variable]]


class NotLookedUp(Exception):
    """A body has something in it that is no look-up in rows that are all known, and no test of their values."""


@dataclass(slots=True)
class Premises:
    """A search for the rows behind a row.

    Args:
        relations: all rows, with their rounds.
        settled: the relations with their undefined rows, too: what nothing proves is neither among those.
        earlier: predicates of which only rows from before the round count.
        round: in which the row appeared.
        budget: rows that may be looked at.
    """

    relations: Mapping[Indicator, Relation]
    settled: Mapping[Indicator, Relation]
    earlier: Collection[Indicator | None]
    round: int
    budget: int

    def of(self, atom: Compound, clause: Clause) -> tuple[Literal, ...] | None:
        """An instance of the clause's body that holds and gives the atom, or None.

        Raises:
            NotLookedUp: something in the body is left to a search.
            BudgetExceeded: too many rows were looked at.
        """
        bindings = unify(clause.head, atom, {})
        solution = None if bindings is None else next(self._solutions(clause.body, bindings), None)
        return None if solution is None else tuple([x.instance(solution) for x in clause.body])

    def _solutions(self, waiting: Sequence[Literal], bindings: Bindings) -> Iterator[Bindings]:
        if not waiting:
            yield bindings
            return
        at, rows, open_ = self._next(waiting, bindings)
        literal, rest = waiting[at], [*waiting[:at], *waiting[at + 1 :]]
        found = self._tested(literal, bindings) if rows is None else self._extended(literal, rows, open_, bindings)
        for extended in found:
            yield from self._solutions(rest, extended)

    def _next(self, waiting: Sequence[Literal], bindings: Bindings) -> tuple[int, Collection[Row] | None, _Open]:
        """The condition to take now; of a look-up with its rows and the columns that they settle."""
        best: tuple[int, Collection[Row], _Open] | None = None
        for at, literal in enumerate(waiting):
            if literal.is_comparison:
                if is_ready(literal, bindings):
                    return at, None, []
                continue
            columns, key, open_ = _pattern(literal, bindings)
            if literal.negated:
                if not open_:
                    return at, None, []
                continue
            rows = self._relation(literal).matching(columns, key)
            if best is None or len(rows) < len(best[1]):
                best = at, rows, open_
        if best is None:
            raise NotLookedUp
        return best

    def _tested(self, literal: Literal, bindings: Bindings) -> Iterator[Bindings]:
        """The bindings where a comparison or an absence holds."""
        if literal.is_comparison:
            try:
                extended = compare(literal, bindings)
            except EvaluationFailed:
                return
            if extended is not None:
                yield extended
        elif _pattern(literal, bindings)[1] not in self._relation(literal):
            yield bindings

    def _extended(
        self, literal: Literal, rows: Collection[Row], open_: _Open, bindings: Bindings
    ) -> Iterator[Bindings]:
        """The bindings with what each of the rows says that is early enough."""
        relation, is_earlier = self._relation(literal), literal.atom.indicator in self.earlier
        for row in rows:
            self.budget -= 1
            if self.budget < 0:
                raise BudgetExceeded("the search for a proof stopped at its budget: the answer is unknown")
            if is_earlier and relation.round_of(row) >= self.round:
                continue
            extended = bindings.copy()
            if all(extended.setdefault(variable, row[column]) == row[column] for column, variable in open_):
                yield extended

    def _relation(self, literal: Literal) -> Relation:
        everything = self.settled if literal.negated else self.relations
        relation = None if literal.is_aggregate else everything.get(literal.atom.indicator)
        if relation is None or relation.undefined is not None:
            raise NotLookedUp
        return relation


def _pattern(literal: Literal, bindings: Bindings) -> tuple[Columns, Row, _Open]:
    """The known columns of a condition, their values, and the others with their variables."""
    columns: list[int] = []
    key: list[Term] = []
    open_: _Open = []
    for column, arg in enumerate(literal.atom.args):
        value = bindings.get(arg, arg) if type(arg) is Variable else arg
        if type(value) is Variable:
            if value is not arg:
                raise NotLookedUp
            open_.append((column, value))
        elif type(value) is str or is_ground(value):
            columns.append(column)
            key.append(value)
        else:
            raise NotLookedUp
    return tuple(columns), tuple(key), open_
