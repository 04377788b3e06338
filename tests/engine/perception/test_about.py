"""What an action is about, where things stand close together."""

from casper.engine.perception.about import About, are_together, beside, is_in_reach
from casper.engine.perception.world import AgentState, ObjectState, WorldState

WORLD = WorldState(
    0.0,
    {"ann": AgentState(0.0, 0.0, 0.0)},
    {"sink": ObjectState(0.5, 0.0, 0.8), "glass": ObjectState(0.6, 0.0, 0.8), "plate": ObjectState(0.5, 0.1, 0.8), "hobs": ObjectState(2.0, 0.0, 0.8)},
)


def test_things_are_in_one_place_within_a_hands_breadth_or_two():
    assert are_together(WORLD, "sink", "glass") and not are_together(WORLD, "sink", "hobs")
    assert not are_together(WORLD, "sink", "nothing")


def test_what_lies_at_the_place_of_an_action_may_be_its_place_too_but_for_the_target():
    assert beside(WORLD, About("plate", ("glass",))) == ["sink"]
    assert beside(WORLD, About("plate", ("hobs",))) == [] == beside(WORLD, About("plate", (None,)))


def test_within_reach_is_what_is_an_arm_away_and_what_is_not_seen_may_be():
    assert is_in_reach(WORLD, "ann", "sink") and not is_in_reach(WORLD, "ann", "hobs")
    assert is_in_reach(WORLD, "ann", "cup") and is_in_reach(WORLD, "bob", "hobs")
