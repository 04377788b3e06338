"""A recursive minimum or maximum as one fixpoint: one row for each key, and a better one takes its place.

That is `:- table path(_, _, min).` as in SWI-Prolog. It means something only where better premises never make worse
rows; so the rows that are left are derived once more from one another alone, which gives them their rounds. Where one
of them has lost what it rests on, all of the stratum is undefined. Where something cannot be evaluated, or rests on
what is undefined, the keys are undefined that can be reached from there. A large stratum is worked out on columns
(`least_columns`), where its rules allow.
"""

from __future__ import annotations

from collections.abc import Mapping

from casper.kb.bottom_up.circles.doubts import Doubts
from casper.kb.bottom_up.size import Room
from casper.kb.bottom_up.steps import Emit
from casper.kb.bottom_up.stratum import Joins, Stratum
from casper.kb.errors import BudgetExceeded, NotOnColumns
from casper.kb.program.declarations import Moded
from casper.kb.program.program import Program
from casper.kb.program.strata import needs
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import UndefinedRows, are_settled
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.unknown import UNKNOWN, may_equal

COLUMNS_FROM = 300  # rows below the stratum from which it is worked out on columns, where that can be


def least_rows(
    program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], room: Room, round_: int
) -> int:
    """Give a stratum of predicates with a moded argument its rows; the last round's number.

    Raises:
        BudgetExceeded: it improves without end.
    """
    needed = set(needs(rule for i in stratum for rule in program.rules[i])) - stratum
    if sum(len(relations[i]) for i in needed) >= COLUMNS_FROM and are_settled(relations, needed):
        from casper.kb.bottom_up.circles.least_columns import least_on_columns  # numpy for large programs only

        try:
            return least_on_columns(program, stratum, relations, room, round_)
        except NotOnColumns:
            pass
    search = _Search(program, stratum, relations, room)
    search.run(0)
    final = {i: Relation(*i, search.best[i].values()) for i in stratum}
    affected: dict[Indicator, UndefinedRows] = {}
    if search.failures or not are_settled(relations, needed):
        affected = _affected(search, {**relations, **final})
    for indicator in stratum:
        relations[indicator] = Relation(*indicator, (r for r in program.given[indicator] if r in final[indicator]))
    last = Within(program, stratum, relations, Room(room.most_rows, relations), final).run(round_)
    complete = all(len(relations[i]) == len(final[i]) for i in stratum)
    for indicator, undefined in affected.items() if complete else ():
        relations[indicator].undefined = undefined
    if not complete:
        for indicator in stratum:
            relations[indicator] = Relation(*indicator)
            relations[indicator].undefined = UndefinedRows(*indicator, [(UNKNOWN,) * indicator[1]])
    return last


def _affected(search: _Search, final: dict[Indicator, Relation]) -> dict[Indicator, UndefinedRows]:
    """The keys whose best row may rest on something undefined, each with an unknown value; ``final`` loses their rows.

    Every instance of a rule whose head has another key has premises of other keys alone, and is settled. So the rows
    of other keys are what the stratum would have without these, whatever they turn out to be.
    """
    doubts = _AffectedKeys(search.rules, search.stratum, final, search.room)
    doubts.modes = search.modes
    doubts.run(search.failures)
    return {i: found for i in search.stratum if isinstance(found := final[i].undefined, UndefinedRows)}


class _AffectedKeys(Doubts):
    """Follows what is undefined from key to key."""

    modes: Mapping[Indicator, Moded]

    def found(self, indicator: Indicator, row: Row) -> None:
        """The row's key is affected; what stood there goes."""
        at, relation = self.modes[indicator].at, self.relations[indicator]
        affected = (*row[:at], UNKNOWN, *row[at + 1 :])
        if relation.undefined is None:
            relation.undefined = UndefinedRows(*indicator)
        if relation.undefined.add(affected):
            self.fresh.append((indicator, affected))
            for other in [r for r in relation if all(map(may_equal, affected, r))]:
                relation.remove(other)


class Within(Stratum):
    """The fixpoint of some predicates within rows that are known already: it finds out in which round each comes."""

    def __init__(
        self,
        program: Program,
        stratum: frozenset[Indicator],
        relations: Mapping[Indicator, Relation],
        room: Room,
        within: Mapping[Indicator, Relation],
        absent: Mapping[Indicator, Relation] | None = None,
        joins: Joins | None = None,
    ) -> None:
        super().__init__(program, stratum, relations, room, absent, joins)
        self.within = within

    def _emitter(self, rule: Clause) -> Emit:
        emit, within = super()._emitter(rule), self.within[rule.head.indicator]

        def emit_known(row: Row) -> None:
            if row in within:
                emit(row)

        return emit_known


class _Search(Stratum):
    """Semi-naive evaluation in which a better row replaces the one of the same key."""

    def __init__(
        self, program: Program, stratum: frozenset[Indicator], relations: Mapping[Indicator, Relation], room: Room
    ) -> None:
        super().__init__(program, stratum, {**relations, **{i: Relation(*i) for i in stratum}}, room)
        self.modes: dict[Indicator, Moded] = {i: program.least[i] for i in stratum}
        self.best: dict[Indicator, dict[Row, Row]] = {i: {} for i in stratum}
        self.better: dict[Indicator, dict[Row, Row]] = {}
        for indicator in stratum:
            emit = self._keeper(indicator)
            for row in program.given[indicator]:
                emit(row)
        self._take(0)

    def run(self, round_: int) -> int:
        """Evaluate until nothing gets better; the number of rounds."""
        for number, rule in enumerate(self.rules):
            if self._may_fire(rule):
                self._run(self.joins.of(number, rule), rule, ())
        recursive = self._recursive()
        while delta := self._take(round_ := round_ + 1):
            for each in (each for indicator in delta for each in recursive.get(indicator, ())):
                new = delta[each.rule.body[each.at].atom.indicator]
                self._run(self.joins.of(each.number, each.rule, each.at), each.rule, new)
            if round_ > sum(map(len, self.best.values())) + 1:  # a row would rest on one of the same key
                name, arity = min(self.stratum)
                raise BudgetExceeded(f"the rows of {name}/{arity} improve without end: the answer is unknown")
        return round_

    def _emitter(self, rule: Clause) -> Emit:
        return self._keeper(rule.head.indicator)

    def _keeper(self, indicator: Indicator) -> Emit:
        at, is_better = self.modes[indicator].at, self.modes[indicator].is_better
        best, better = self.best[indicator], self.better.setdefault(indicator, {})
        most = self.room.left + len(best)

        def emit(row: Row) -> None:
            key = row[:at] + row[at + 1 :]
            old = better.get(key) or best.get(key)
            if old is None or is_better(row[at], old[at]):
                better[key] = row
                if len(better) > most:  # within a round, too
                    self.room.take(len(better))

        return emit

    def _take(self, round_: int) -> dict[Indicator, list[Row]]:
        found, self.better = self.better, {}
        delta: dict[Indicator, list[Row]] = {}
        for indicator, rows in found.items():
            relation, best = self.relations[indicator], self.best[indicator]
            for key, row in rows.items():
                old = best.get(key)
                if old is None:
                    self.room.take(1)
                else:
                    relation.remove(old)
                best[key] = row
                relation.add(row, round_)
            if rows:
                delta[indicator] = list(rows.values())
        return delta
