"""The semi-naive fixpoint on Python rows, stratum by stratum: what is new in a round is joined in the next."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from casper.kb.bottom_up.join import Emit, Join
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator


def row_fixpoint(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """The fixpoint on Python rows.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    relations = {i: Relation(*i, program.given[i]) for stratum in program.strata for i in stratum}
    room, round_ = Room(most_rows, relations), 0
    for stratum in program.strata:
        round_ = _Stratum(program, stratum, relations, room).run(round_)
    return relations


def fixpoint_of(program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation]) -> None:
    """Evaluate some predicates' rules on relations that hold their given rows and all rows of what else they need."""
    _Stratum(program, stratum, relations, Room(MOST_ROWS, relations)).run(0)


@dataclass
class _Recursive:
    """A rule, and which of its conditions ranges over what is new; compiled when something new comes."""

    number: int
    rule: Clause
    at: int

    @cached_property
    def join(self) -> Join:
        """The compiled rule."""
        return Join(self.rule, self.at)


class _Stratum:
    """The fixpoint of one stratum: what is new in a round is joined with everything in the next.

    A round costs what is new in it, however many rules there are.
    """

    def __init__(
        self, program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], room: Room
    ) -> None:
        self.relations, self.room, self.stratum = relations, room, stratum
        self.rules = [c for indicator in sorted(stratum) for c in program.rules[indicator]]
        self.fresh: dict[Indicator, dict[Row, None]] = {}

    def run(self, round_: int) -> int:
        """Evaluate to the fixpoint; the last round's number."""
        for rule in self.rules:
            if self._may_fire(rule):
                Join(rule).run(self.relations, (), self._emitter(rule))
        recursive = self._recursive()
        while delta := self._take(round_ := round_ + 1):
            due = [each for indicator in delta for each in recursive.get(indicator, ())]
            for each in sorted(due, key=lambda each: each.number):
                new = delta[each.rule.body[each.at].atom.indicator]
                each.join.run(self.relations, new, self._emitter(each.rule))
        return round_

    def _may_fire(self, rule: Clause) -> bool:
        """Whether there is something to look up for every condition: otherwise the rule need not be compiled yet."""
        return all(self.relations[x.atom.indicator] for x in rule.body if not x.negated and not x.is_comparison)

    def _recursive(self) -> dict[Indicator, list[_Recursive]]:
        found: dict[Indicator, list[_Recursive]] = {}
        for number, rule in enumerate(self.rules):
            for at, literal in enumerate(rule.body):
                if not literal.negated and literal.atom.indicator in self.stratum:
                    found.setdefault(literal.atom.indicator, []).append(_Recursive(number, rule, at))
        return found

    def _emitter(self, rule: Clause) -> Emit:
        known = self.relations[rule.head.indicator].rows
        fresh = self.fresh.setdefault(rule.head.indicator, {})

        def emit(row: Row) -> None:
            if row not in known:
                fresh[row] = None

        return emit

    def _take(self, round_: int) -> dict[Indicator, list[Row]]:
        """Move what the last round found into the relations; what was new, by predicate."""
        found, self.fresh = self.fresh, {}
        delta: dict[Indicator, list[Row]] = {}
        for indicator, rows in found.items():
            relation = self.relations[indicator]
            new = [row for row in rows if relation.add(row, round_)]
            if new:
                delta[indicator] = new
        self.room.take(sum(map(len, delta.values())))
        return delta
