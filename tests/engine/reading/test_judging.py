"""What a prediction amounts to: an observation where it is valid, a refusal that is told once where it is not."""

from casper import Domain
from casper.engine.actions.prediction import Prediction
from casper.engine.mind import Mind
from casper.engine.perception.about import About
from casper.engine.perception.world import AgentState, ObjectState, WorldState

KITCHEN = Domain.load("kitchen")
WORLD = WorldState(1.0, {"human": AgentState(0.0, 0.0, 0.0)}, {name: ObjectState(x, y, z) for name, x, y, z in KITCHEN.kb.rows("position", 4)})


def judged(judging, target, place, t=1.0):
    """The types of the events, and the observation."""
    steps = judging.of(Prediction(t, "pick_and_place", 0.9, {}, ()), About(target, (place,)), WORLD, list)
    types = []
    while True:
        try:
            types.append(next(steps).type)
        except StopIteration as end:
            return types, end.value


def test_a_valid_action_is_an_observation_as_certain_as_its_prediction():
    types, seen = judged(Mind(KITCHEN)._judging, "biscuits", "plate")
    assert types == ["action", "verdict"]
    assert (str(seen), seen.certainty) == ("pick_and_place(biscuits, plate)", 0.9)


def test_a_refusal_is_told_once_and_again_only_after_something_else_was_accepted():
    judging = Mind(KITCHEN)._judging
    assert judged(judging, "biscuits", "hobs") == (["action", "verdict"], None)
    assert judged(judging, "biscuits", "hobs", 2.0) == ([], None)
    judged(judging, "biscuits", "plate", 3.0)
    assert judged(judging, "biscuits", "hobs", 4.0) == (["action", "verdict"], None)


def test_what_nobody_saw_brought_may_have_been_brought_where_it_may_go():
    judging = Mind(KITCHEN)._judging
    assert [str(each) for each in judging.brought("biscuits", "plate", 1.0)] == ["pick_and_place(biscuits, plate)"]
    assert list(judging.brought("biscuits", "hobs", 1.0)) == []
