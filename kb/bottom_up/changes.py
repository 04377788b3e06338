"""What a change of rows is followed by: a rule for one of its conditions, and the relations as they were before it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from casper.kb.bottom_up.circles.doubts import Failure
from casper.kb.bottom_up.join import Join
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import Bindings, substitute, variables_of

Change: TypeAlias = dict[Indicator, dict[Row, None]]


@dataclass
class ChangePlan:
    """A rule for a change of one of its conditions: to find what it gives, and what it may have given.

    A row that comes or goes of what an aggregate counts changes its group: all that the group gives now is found, and
    all that it may have given is what stands there, whatever the result was.
    """

    rule: Clause
    at: int

    @cached_property
    def head(self) -> Indicator:
        """The predicate it gives rows of."""
        return self.rule.head.indicator

    @cached_property
    def gives(self) -> Join:
        """The rule compiled for rows that came."""
        if self.rule.body[self.at].is_aggregate:
            return Join(replace(self.rule, body=(self._seed, *self.rule.body)), 0)
        return Join(self.rule, self.at)

    def gave(self, view: Mapping[Indicator, Relation], rows: Iterable[Row], found: dict[Row, None]) -> None:
        """Add a superset of what the rule gave by way of rows that changed."""
        if not any(x.is_aggregate for x in self.rule.body):
            self._gave.run(view, rows, found.setdefault)
            return
        keys: dict[Row, None] = {}
        self._groups.run(view, rows, keys.setdefault)
        for key in keys:
            found.update(dict.fromkeys(view[self.head].matching(self._columns, key)))

    @cached_property
    def _gave(self) -> Join:
        return Join(self.rule, self.at, negations=False)

    @cached_property
    def _seed(self) -> Literal:
        """The condition as a look-up of the row that changed, with wildcards of its own."""
        literal = self.rule.body[self.at]
        atom: Compound = literal.atom[2] if literal.is_aggregate else literal.atom
        fresh: Bindings = {v: Variable(f"{v.name}again") for v in variables_of(atom) if v.is_anonymous}
        return Literal(substitute(atom, fresh))

    @cached_property
    def _looked_up(self) -> tuple[Literal, ...]:
        others = (x for at, x in enumerate(self.rule.body) if at != self.at)
        return (self._seed, *(x for x in others if not x.is_strict and not x.is_comparison))

    @cached_property
    def _columns(self) -> tuple[int, ...]:
        """The columns of the head that are known without any aggregate."""
        known = {v for x in self._looked_up for v in x.variables()}
        return tuple(c for c, arg in enumerate(self.rule.head.args) if known.issuperset(variables_of(arg)))

    @cached_property
    def _groups(self) -> Join:
        """What is known of the rows that the changed row has to do with."""
        key = Compound((self.rule.head[0], *(self.rule.head.args[c] for c in self._columns)))
        return Join(Clause(key, self._looked_up), 0)


def noting(rule: Clause, failures: list[Failure]) -> Callable[[Bindings], None]:
    """What notes where an evaluation of a rule failed."""

    def failed(known: Bindings) -> None:
        failures.append((rule, known))

    return failed


def derives(check: Join, relations: Mapping[Indicator, Relation], row: Row, failures: list[Failure]) -> bool:
    """Whether a rule gives a row; where an evaluation fails, the row's value for its result was never worked out."""

    def failed(known: Bindings) -> None:
        computed = {v for x in check.clause.body if x.is_aggregate for v in variables_of(x.atom[3])}
        computed |= {v for x in check.clause.body if x.is_comparison for v in variables_of(x.atom[1])}
        failures.append((check.clause, {v: value for v, value in known.items() if v not in computed}))

    return check.derives(relations, row, failed)


class Before(dict[Indicator, Relation]):
    """The relations with the rows that already went in lower strata laid back in."""

    def __init__(self, relations: Mapping[Indicator, Relation], went: Change) -> None:
        super().__init__()
        self.relations, self.went = relations, went

    def __missing__(self, indicator: Indicator) -> Relation:
        rows = self.went.get(indicator)
        relation = self.relations[indicator]
        found = _With(relation, rows) if rows else relation
        self[indicator] = found
        return found


class _With(Relation):
    """A relation together with some more rows, to be looked up only."""

    def __init__(self, below: Relation, more: Iterable[Row]) -> None:
        super().__init__(below.name, below.arity, more)
        self.below = below

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        return [*self.below.matching(columns, key), *super().matching(columns, key)]
