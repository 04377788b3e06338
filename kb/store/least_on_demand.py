"""The best rows of a recursive minimum, worked out for what a question names of them, and remembered until a change."""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import TYPE_CHECKING, TypeAlias

from casper.kb.bottom_up.circles.asked import asked_rows, fixed_columns
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.store.on_demand import facts_key
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground
from casper.kb.terms.values.effort import PARTS_A_STEP, charge

if TYPE_CHECKING:
    from casper.kb.store.model import Model

Remembered: TypeAlias = "MutableMapping[tuple[Indicator, Columns, Row], Relation]"
MOST_REMEMBERED = 1_000  # questions


def best_rows(atom: Compound, model: Model) -> Relation:
    """A relation with every row that an atom of a moded predicate can be: all rows, where it names none they rest on.

    Raises:
        BudgetExceeded: they improve without end.
    """
    indicator = atom.indicator
    columns = tuple(c for c in fixed_columns(model.program, indicator) if is_ground(atom.args[c]))
    if not columns or model.listed is not None:
        return model.relations[indicator]
    asked = indicator, columns, tuple([atom.args[c] for c in columns])
    found = model.best.get(asked)
    if found is None:
        facts = model.facts
        given = list(facts[facts_key(model.program, indicator)].matching(columns, asked[2]))
        found = asked_rows(model.program, indicator, facts, given, dict(zip(columns, asked[2])))
        charge(PARTS_A_STEP * len(found))
        if len(model.best) >= MOST_REMEMBERED:
            model.best.clear()
        model.best[asked] = found
    return found
