"""The semi-naive fixpoint of one stratum on Python rows: what is new in a round is joined in the next."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from casper.kb.bottom_up.join import Join
from casper.kb.bottom_up.size import Room
from casper.kb.bottom_up.steps import Emit
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.unification import Bindings


class Joins(dict[tuple[int, int | None], Join]):
    """Rules of a stratum by their number and the condition that ranges over what is new, compiled when they are run.

    They hold for the same rules in the same order, whatever the rows are.
    """

    def of(self, number: int, rule: Clause, at: int | None = None) -> Join:
        """The compiled rule."""
        found = self.get((number, at))
        if found is None:
            found = self[number, at] = Join(rule, at)
        return found


@dataclass(frozen=True, slots=True)
class _Recursive:
    """A rule, and which of its conditions ranges over what is new."""

    number: int
    rule: Clause
    at: int


class Stratum:
    """The fixpoint of one stratum: what is new in a round is joined with everything in the next.

    A round costs what is new in it, however many rules there are.

    Args:
        relations: those of the stratum, which grow, and all rows of what else it needs.
        absent: where negations are looked up; the relations themselves when it is None.
        joins: what was compiled before for the same stratum of the same rules.
    """

    def __init__(
        self,
        program: Program,
        stratum: frozenset[Indicator],
        relations: Mapping[Indicator, Relation],
        room: Room,
        absent: Mapping[Indicator, Relation] | None = None,
        joins: Joins | None = None,
    ) -> None:
        self.joins = Joins() if joins is None else joins
        self.relations, self.room, self.stratum, self.absent = relations, room, stratum, absent
        self.failures: list[tuple[Clause, Bindings]] = []  # evaluations: the rule, and what was known of its variables
        self.rules = [c for indicator in sorted(stratum) for c in program.rules[indicator]]
        self.fresh: dict[Indicator, dict[Row, None]] = {}

    def run(self, round_: int) -> int:
        """Evaluate to the fixpoint; the last round's number."""
        for number, rule in enumerate(self.rules):
            if self._may_fire(rule):
                self._run(self.joins.of(number, rule), rule, ())
        recursive = self._recursive()
        while delta := self._take(round_ := round_ + 1):
            due = [each for indicator in delta for each in recursive.get(indicator, ())]
            for each in sorted(due, key=lambda each: each.number):
                new = delta[each.rule.body[each.at].atom.indicator]
                self._run(self.joins.of(each.number, each.rule, each.at), each.rule, new)
        return round_

    def _run(self, join: Join, rule: Clause, new: Iterable[Row]) -> None:
        def failed(known: Bindings) -> None:
            self.failures.append((rule, known))

        join.run(self.relations, new, self._emitter(rule), self.absent, failed)

    def _may_fire(self, rule: Clause) -> bool:
        """Whether there is something to look up for every condition: otherwise the rule need not be compiled yet."""
        return all(self.relations[x.atom.indicator] for x in rule.body if not x.is_strict and not x.is_comparison)

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
        most = self.room.left

        def emit(row: Row) -> None:
            if row not in known:
                fresh[row] = None
                if len(fresh) > most:  # within a round, too
                    self.room.take(len(fresh), rule.head.indicator)

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
