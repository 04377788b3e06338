"""Materialisation: the rows of every stored predicate, by semi-naive evaluation, stratum by stratum.

A row keeps the round in which it appeared. Rounds count up through all strata, so the premises of a row always come
from earlier rounds: that is all that `kb.why` needs to rebuild a well-founded proof. Within a stratum the round is the
least height of a proof.

Small programs are evaluated on Python rows; a program of plain rules that has, or comes to have, ``COLUMNS_FROM`` rows
goes to numpy columns (`kb.columnar`).
"""

from __future__ import annotations

from casper.kb.clauses import Clause
from casper.kb.errors import BudgetExceeded
from casper.kb.join import Emit, Join
from casper.kb.program import Indicator, Program
from casper.kb.relation import Relation, Row

MOST_ROWS = 20_000_000
COLUMNS_FROM = 2_000


def materialise(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """All rows of every stored predicate.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    stored = [indicator for stratum in program.strata for indicator in stratum]
    if sum(len(program.given[i]) for i in stored) < COLUMNS_FROM:
        try:
            return row_fixpoint(program, min(COLUMNS_FROM, most_rows))
        except BudgetExceeded:
            pass  # few facts can have many consequences: then it was a large program after all
    from casper.kb.columnar_fixpoint import columnar_fixpoint  # numpy is loaded for large programs only

    return columnar_fixpoint(program, most_rows) or row_fixpoint(program, most_rows)


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


def check_size(sizes: dict[Indicator, int], most_rows: int) -> None:
    """Refuse a program that derives without end before it eats the memory.

    Raises:
        BudgetExceeded: there are more rows than that; the sentence names the largest predicate.
    """
    if sum(sizes.values()) > most_rows:
        name, arity = max(sizes, key=lambda indicator: sizes[indicator])
        raise BudgetExceeded(f"there are more than {most_rows} facts; {name}/{arity} has most of them")
