"""Materialisation: the rows of every stored predicate, by semi-naive evaluation, stratum by stratum.

A row keeps the round in which it appeared. Rounds count up through all strata, so the premises of a row always come
from earlier rounds: that is all that `kb.why` needs to rebuild a well-founded proof.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from casper.kb.clauses import Clause
from casper.kb.errors import BudgetExceeded
from casper.kb.join import compile_join
from casper.kb.program import Indicator, Program
from casper.kb.relation import Relation, Row

MOST_ROWS = 20_000_000


def materialise(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """All rows of every stored predicate.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    relations = {i: Relation(*i) for stratum in program.strata for i in stratum}
    round_ = 0
    for stratum in program.strata:
        round_ = _Stratum(program, stratum, relations, most_rows).run(round_)
    return relations


class _Stratum:
    """The fixpoint of one stratum: what is new in a round is joined with everything in the next."""

    def __init__(
        self, program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], most_rows: int
    ) -> None:
        self.relations, self.most_rows = relations, most_rows
        self.clauses = [c for indicator in sorted(stratum) for c in program.clauses[indicator]]
        self.stratum = stratum
        self.fresh: dict[Indicator, dict[Row, None]] = {}

    def run(self, round_: int) -> int:
        """Evaluate to the fixpoint; the last round's number."""
        for clause in self.clauses:
            if not clause.body:
                self.relations[clause.head.indicator].add(clause.head.args, round_)
        rules = [c for c in self.clauses if c.body]
        for clause in rules:
            compile_join(clause, self.relations, None, self._emitter(clause))(())
        joins = [join for clause in rules for join in self._recursive_joins(clause)]
        while delta := self._take(round_ := round_ + 1):
            for indicator, join in joins:
                if indicator in delta:
                    join(delta[indicator])
        return round_

    def _recursive_joins(self, clause: Clause) -> Iterable[tuple[Indicator, Callable[[Iterable[Row]], None]]]:
        for at, literal in enumerate(clause.body):
            if not literal.negated and literal.atom.indicator in self.stratum:
                yield literal.atom.indicator, compile_join(clause, self.relations, at, self._emitter(clause))

    def _emitter(self, clause: Clause) -> Callable[[Row], None]:
        known = self.relations[clause.head.indicator].rows
        fresh = self.fresh.setdefault(clause.head.indicator, {})

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
        total = sum(len(r) for r in self.relations.values())
        if total > self.most_rows:
            most = _largest(self.relations)
            raise BudgetExceeded(f"there are more than {self.most_rows} facts; {most} has most of them")
        return delta


def _largest(relations: dict[Indicator, Relation]) -> str:
    name, arity = max(relations, key=lambda indicator: len(relations[indicator]))
    return f"{name}/{arity}"
