"""Undefined rows: what a rule gives only if something undefined held.

The rows that hold are known. Every other row that is possible rests on an evaluation that failed, on an undefined row,
or on the negation of one: from these its rules are followed, by the search, which knows three truth values.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

from casper.kb.bottom_up.size import Room
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.unification import Bindings, substitute, unify
from casper.kb.terms.unknown import closed, opened
from casper.kb.top_down.compiled.cells import serials as fresh_numbers
from casper.kb.top_down.solve import Solver

Failure: TypeAlias = tuple[Clause, Bindings]  # a rule, and what was known where an evaluation failed
NO_END = 10**15  # steps: rows are bounded, and each is looked at once


def add_undefined(
    rules: Iterable[Clause],
    stratum: frozenset[Indicator],
    relations: Mapping[Indicator, Relation],
    failures: Iterable[Failure],
    room: Room,
) -> None:
    """Give the relations of a stratum their undefined rows; those they have already are taken as followed.

    Raises:
        BudgetExceeded: there are too many rows.
    """
    Doubts(list(rules), stratum, relations, room).run(failures)


class Doubts:
    """Follows what is undefined through the rules of a stratum; `found` is told of every row it may give."""

    def __init__(
        self, rules: list[Clause], stratum: frozenset[Indicator], relations: Mapping[Indicator, Relation], room: Room
    ) -> None:
        self.relations, self.stratum, self.room = relations, stratum, room
        self.solver = Solver(relations, {}, budget=NO_END)
        self.uses: dict[Indicator, list[tuple[Clause, Literal]]] = {}
        for rule in rules:
            for literal in rule.body:
                if literal.needed is not None:
                    self.uses.setdefault(literal.needed, []).append((rule, literal))
        self.fresh: list[tuple[Indicator, Row]] = []

    def run(self, failures: Iterable[Failure]) -> None:
        """Follow what failed and what is undefined below, then whatever that makes undefined."""
        for rule, bindings in failures:
            self._follow(rule, bindings)
        for indicator in self.uses:
            below = self.relations[indicator].undefined if indicator not in self.stratum else None
            for row in list(below or ()):
                self._follow_row(indicator, row)
        while self.fresh:
            found, self.fresh = self.fresh, []
            self.room.take(len(found))
            for indicator, row in found:
                self._follow_row(indicator, row)

    def _follow_row(self, indicator: Indicator, row: Row) -> None:
        for rule, literal in self.uses.get(indicator, ()):
            for bindings in seeds(literal, row):
                self._follow(rule, bindings)

    def _follow(self, rule: Clause, bindings: Bindings) -> None:
        for solution in list(self.solver.possible(rule.body, bindings)):  # rows are added meanwhile
            self.found(rule.head.indicator, tuple([closed(substitute(arg, solution)) for arg in rule.head.args]))

    def found(self, indicator: Indicator, row: Row) -> None:
        """A row that a rule gives if something undefined holds: undefined, unless it holds anyway."""
        relation = self.relations[indicator]
        if row in relation:
            return
        if relation.undefined is None:
            relation.undefined = UndefinedRows(*indicator)
        if relation.undefined.add(row):
            self.fresh.append((indicator, row))


def seeds(literal: Literal, row: Row) -> Iterator[Bindings]:
    """What a rule's variables are where one of its conditions meets an undefined row."""
    pattern = literal.atom[2] if literal.is_aggregate else literal.atom
    bindings = unify(type(pattern)(pattern.args), type(pattern)([opened(value, fresh_numbers) for value in row]), {})
    if bindings is None:
        return
    if literal.is_strict:  # it is about all that its wildcards may be
        bindings = {v: value for v, value in bindings.items() if not v.is_anonymous}
    yield bindings
