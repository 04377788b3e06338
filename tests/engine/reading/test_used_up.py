"""Of a poor sensor: what was handled last and is gone was used up, whatever steps before that went unseen."""

import pytest

from casper import Domain
from casper.engine.mind import Mind
from casper.engine.perception.focus import Focus
from casper.engine.perception.world import AgentState, Doubt, ObjectState, WorldState
from casper.engine.reading.observing.doubting import Doubting, keeps_goal
from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound

KITCHEN = Domain.load("kitchen")
SPOTS = {name: ObjectState(x, y, z) for name, x, y, z in KITCHEN.kb.rows("position", 4)}
LUNCH = ("pick_and_place(meal, hobs)", "cook(meal, hobs)")
BESIDE = AgentState(-0.66, -0.75, -1.6)


def term(action, *args):
    return Compound((action, *args))


def used_up(where, frontiers):
    """What is concluded when the meal, which was handled last and lay at a place, is gone."""
    mind = Mind(KITCHEN)
    doubting = Doubting(mind._stating, mind._skills, KITCHEN.kb.rows("consumes", 1))
    objects = {**SPOTS, "meal": SPOTS[where]}
    lay = WorldState(1.0, {"human": BESIDE if where == "plate" else AgentState(1.2, 1.0, 0.0)}, objects)
    doubt = Doubt(grasp=0.1, moves=0.0, spread=0.05)
    doubting.note({"use": 0.1}, Focus(1.0, {}, "meal", where), "meal", lay, doubt)
    gone = WorldState(9.0, lay.agents, {name: at for name, at in objects.items() if name != "meal"})
    assert not doubting.is_gone(lay) and doubting.is_gone(gone)
    return doubting.used_up(gone, frontiers)


def test_what_is_gone_was_used_up_though_the_step_before_went_unseen():
    reading = KITCHEN.reading()
    for action in LUNCH:
        reading.observe(action)
    assert list(reading.next_actions) == ["pick_and_place(meal, plate)"]
    found = used_up("plate", reading.frontiers)
    assert found is not None and str(found.seen) == "eat(meal, plate)"
    reading.observe(found.seen)
    assert reading.plan_for("tiago").waiting == ()


def test_what_nothing_is_yet_to_be_done_with_says_nothing_when_it_is_gone():
    assert used_up("plate", {(term("wash", "plate", "sink"),): 1.0}) is None
    assert used_up("plate", {(term("eat", "biscuits", "plate"),): 1.0}) is None


def test_where_it_could_not_be_used_up_it_was_not():
    assert used_up("hobs", {(term("eat", "meal", "plate"),): 1.0}) is None


@pytest.mark.parametrize("share, concluded", [(1.0, True), (0.3, True), (0.1, False)])
def test_nothing_is_concluded_where_it_is_sure_that_it_was_seen_already(share, concluded):
    rest = (term("wash", "plate", "sink"),)
    frontiers = {(term("eat", "meal", "plate"), *rest): share, rest: 1.0 - share}
    assert (used_up("plate", frontiers) is not None) == concluded


def test_what_was_used_up_does_not_change_the_goal():
    reading = KITCHEN.reading()
    reading.observe({"pick_and_place(biscuits, plate)": 0.7, "pick_and_place(meal, plate)": 0.3})
    assert keeps_goal(reading, Observation("eat", ("biscuits", "plate")))
    assert not keeps_goal(reading, Observation("eat", ("meal", "plate")))
    assert len(reading.observations) == 1
