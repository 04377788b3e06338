"""What the simulated partner does for a goal: the first plan that can be acted out."""

import pytest

from casper.engine.domain.domain import Domain
from casper.kb.errors import DomainError, PlanError
from casper.sim_adapter.script import script_for

ONTOLOGY = """human(ann). cup(glass). cup(mug). clean(mug). spot(sink). spot(table).
put(A, C, S) :- human(A), cup(C), spot(S).
wash(A, C, S) :- human(A), cup(C), S = sink.
fill(A, C, S) :- human(A), cup(C), clean(C), spot(S)."""


def done(plans: str, goal: str = "g") -> list[str]:
    return [str(each.action) for each in script_for(Domain.from_text(ontology=ONTOLOGY, plans=plans), goal)]


def test_what_one_step_settles_the_others_share() -> None:
    assert done("goal(g). g --> fill(C, table), put(C, S), wash(C, S).") == [
        "fill(mug, table)",
        "put(mug, sink)",
        "wash(mug, sink)",
    ]


def test_plans_that_are_not_listed_are_acted_out_the_shortest_way() -> None:
    plans = "goal(g). g --> put(C, table), more(C). more(C) --> wash(C, sink). more(C) --> put(C, sink), more(C)."
    assert done(plans) == ["put(glass, table)", "wash(glass, sink)"]


def test_a_step_is_chosen_from_which_the_goal_is_still_reached() -> None:
    plans = "goal(g). g --> put(C, table), more(C). more(C) --> fill(C, table). more(C) --> put(C, sink), more(C)."
    assert done(plans) == ["put(mug, table)", "fill(mug, table)"]


def test_conditions_are_kept() -> None:
    plans = "goal(g). g --> {clean(C)}, more(C). more(C) --> wash(C, sink). more(C) --> put(C, sink), more(C)."
    assert done(plans) == ["wash(mug, sink)"]


def test_what_nobody_can_do_is_told() -> None:
    plans = "goal(g). g --> put(C, table), more(C). more(C) --> fill(glass, table). more(C) --> put(mug, sink), more(glass)."
    with pytest.raises(PlanError, match="no way to do g was found"):
        done(plans)


def test_a_goal_that_is_none_is_told_with_those_there_are() -> None:
    with pytest.raises(DomainError, match="there is no goal 'h': choose g"):
        done(
            "goal(g). g --> put(C, table), more(C). more(C) --> wash(C, sink). more(C) --> put(C, sink), more(C).", "h"
        )
