"""The fixpoint on Python rows, stratum by stratum, with what is undefined beside what holds."""

from __future__ import annotations

from casper.kb.bottom_up.circles.alternating import well_founded
from casper.kb.bottom_up.circles.doubts import add_undefined
from casper.kb.bottom_up.circles.minimum import least_rows
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.bottom_up.stratum import Stratum
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation
from casper.kb.relations.undefined import Possible, are_settled
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.values.effort import charged_to


def row_fixpoint(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """The fixpoint on Python rows.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    relations = {i: Relation(*i, program.given[i]) for stratum in program.strata for i in stratum}
    room, round_ = Room(most_rows, relations), 0
    with charged_to(room.spend):
        for stratum in program.strata:
            round_ = evaluate_stratum(program, stratum, relations, room, round_)
    return relations


def evaluate_stratum(
    program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation], room: Room, round_: int
) -> int:
    """Evaluate one stratum on relations that hold its given rows, and all rows of what it needs.

    Rows get rounds after ``round_``; the last of them comes back.
    """
    if not stratum.isdisjoint(program.circular):
        return well_founded(program, stratum, relations, room, round_)
    if not stratum.isdisjoint(program.least):
        return least_rows(program, stratum, relations, room, round_)
    rules = [rule for indicator in stratum for rule in program.rules[indicator]]
    needed = {x.needed for rule in rules for x in rule.body if x.needed is not None}
    settled = are_settled(relations, needed)
    evaluation = Stratum(program, stratum, relations, room, None if settled else Possible(relations))
    round_ = evaluation.run(round_)
    if evaluation.failures or not settled:
        add_undefined(rules, stratum, relations, evaluation.failures, room)
    return round_
