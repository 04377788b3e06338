"""The semi-naive fixpoint on Python rows, stratum by stratum: what is new in a round is joined in the next."""

from __future__ import annotations

from casper.kb.bottom_up.join import Emit, Join
from casper.kb.bottom_up.size import MOST_ROWS, check_size
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.clauses import Clause, Indicator


def row_fixpoint(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """The fixpoint on Python rows.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    relations = {i: Relation(*i, program.given[i]) for stratum in program.strata for i in stratum}
    round_ = 0
    for stratum in program.strata:
        round_ = _Stratum(program, stratum, relations, most_rows).run(round_)
    return relations


def fixpoint_of(program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation]) -> None:
    """Evaluate some predicates' rules on relations that hold their given rows and all rows of what else they need."""
    _Stratum(program, stratum, relations, MOST_ROWS).run(0)


class _Stratum:
    """The fixpoint of one stratum: what is new in a round is joined with everything in the next."""

    def __init__(
        self, program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], most_rows: int
    ) -> None:
        self.relations, self.most_rows, self.stratum = relations, most_rows, stratum
        self.rules = [c for indicator in sorted(stratum) for c in program.rules[indicator]]
        self.fresh: dict[Indicator, dict[Row, None]] = {}

    def run(self, round_: int) -> int:
        """Evaluate to the fixpoint; the last round's number."""
        for rule in self.rules:
            Join(rule).run(self.relations, (), self._emitter(rule))
        recursive = [
            (literal.atom.indicator, Join(rule, at), self._emitter(rule))
            for rule in self.rules
            for at, literal in enumerate(rule.body)
            if not literal.negated and literal.atom.indicator in self.stratum
        ]
        while delta := self._take(round_ := round_ + 1):
            for indicator, join, emit in recursive:
                if indicator in delta:
                    join.run(self.relations, delta[indicator], emit)
        return round_

    def _emitter(self, rule: Clause) -> Emit:
        known = self.relations[rule.head.indicator].rows
        fresh = self.fresh.setdefault(rule.head.indicator, {})

        def emit(row: Row) -> None:
            if row not in known:
                fresh[row] = None

        return emit

    def _take(self, round_: int) -> dict[Indicator, list[Row]]:
        """Move what the last round found into the relations; what was new, by predicate."""
        delta: dict[Indicator, list[Row]] = {}
        for indicator, rows in self.fresh.items():
            relation = self.relations[indicator]
            new = [row for row in rows if relation.add(row, round_)]
            rows.clear()
            if new:
                delta[indicator] = new
        check_size({i: len(r) for i, r in self.relations.items()}, self.most_rows)
        return delta
