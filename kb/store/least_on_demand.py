"""The best rows of a recursive minimum, worked out for what a question names of them, and remembered until a change."""

from __future__ import annotations

from collections.abc import Mapping, MutableMapping
from typing import TypeAlias

from casper.kb.bottom_up.circles.asked import asked_rows, fixed_columns
from casper.kb.program.program import Program
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.store.on_demand import facts_key
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground
from casper.kb.terms.values.effort import PARTS_A_STEP, charge

Remembered: TypeAlias = "MutableMapping[tuple[Indicator, Columns, Row], Relation]"
MOST_REMEMBERED = 1_000  # questions


def best_rows(
    atom: Compound, program: Program, facts: Mapping[Indicator, Relation], best: Remembered
) -> Relation | None:
    """A relation with every row that an atom of a moded predicate can be; None where it names nothing they rest on.

    Raises:
        BudgetExceeded: they improve without end.
    """
    indicator = atom.indicator
    columns = tuple(c for c in fixed_columns(program, indicator) if is_ground(atom.args[c]))
    if not columns:
        return None
    asked = indicator, columns, tuple([atom.args[c] for c in columns])
    found = best.get(asked)
    if found is None:
        given = list(facts[facts_key(program, indicator)].matching(columns, asked[2]))
        found = asked_rows(program, indicator, facts, given, dict(zip(columns, asked[2])))
        charge(PARTS_A_STEP * len(found))
        if len(best) >= MOST_REMEMBERED:
            best.clear()
        best[asked] = found
    return found
