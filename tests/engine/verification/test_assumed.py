"""A thing that was taken to be brought somewhere was put there, or elsewhere, once it lies in no hand."""

from types import SimpleNamespace

from casper.engine.perception.world import ObjectState, WorldState
from casper.engine.verification.assumed import Assumed, assumed


def judged(*moments, place=(0.0, 0.0)):
    """What is said at each moment: (x, y) of the bottle, and whether it is in the hand."""
    made = Assumed("bottle", "glass")
    glass = ObjectState(*place, 0.8)
    return [
        made.update(SimpleNamespace(holding="bottle" if held else None), WorldState(t, {}, {"glass": glass, "bottle": ObjectState(*at, 0.8)}))
        for t, (at, held) in enumerate(moments)
    ]


def test_nothing_is_said_while_it_is_carried():
    assert judged(*[((x, 0.0), True) for x in range(6)]) == [None] * 6


def test_it_was_put_there_when_it_lies_near_and_elsewhere_when_it_lies_far_away():
    assert judged(*[((0.2, 0.0), False)] * 4)[-1] is True
    assert judged(*[((2.0, 0.0), False)] * 4)[-1] is False


def test_a_hand_that_seems_empty_while_the_thing_moves_on_says_nothing():
    assert judged(*[((2.0 - 0.3 * step, 0.0), False) for step in range(5)]) == [None] * 5


def test_only_what_the_rules_filled_in_is_assumed():
    assert assumed(None, ("bottle", "glass")) == Assumed("bottle", "glass")
    assert assumed("glass", ("bottle", "glass")) is None
    assert assumed(None, ("bottle", object())) is None
