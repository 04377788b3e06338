import math
import random

import pytest
from low_level_kitchen import kitchen_rows, rows_of

from casper.engine.perception.tracking import Tracker, TrackerSettings, tracker_settings
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.errors import DomainError, WorldStateError


def world(t, objects=None, holding=None, at=(0.0, 0.0), agent=True):
    agents = {"human": AgentState(*at, 0.0, holding)} if agent else {}
    return WorldState(t, agents, {name: ObjectState(*place) for name, place in (objects or {}).items()})


def tracked(*worlds, **settings):
    tracker = Tracker(TrackerSettings(**settings))
    return [tracker.update(w) for w in worlds]


def test_an_object_out_of_sight_is_where_it_was_last_known_to_be():
    assert tracked(world(0, {"cup": (1, 2, 0.8)}), world(1), world(2))[-1].objects == {"cup": ObjectState(1, 2, 0.8)}


def test_an_unseen_object_in_the_hand_goes_where_the_hand_goes_and_stays_where_it_was_put():
    steps = tracked(
        world(0, {"cup": (1, 0, 0.8)}),
        world(1, holding="cup", at=(1, 0)),
        world(2, holding="cup", at=(3, 4)),
        world(3, at=(3, 4)),
        world(4, at=(6, 6)),
        hold_bridge=0,
    )
    assert [s.objects["cup"] for s in steps[1:]] == [ObjectState(1, 0, 0.8)] + [ObjectState(3, 4, 0.8)] * 3


def test_an_object_never_seen_but_held_is_known_to_be_at_the_hand():
    assert tracked(world(0, holding="cup", at=(2, 3)))[0].objects == {"cup": ObjectState(2, 3)}


def test_noise_on_a_resting_object_is_averaged_away():
    source = random.Random(3)
    steps = tracked(*(world(t, {"cup": (1 + source.gauss(0, 0.03), source.gauss(0, 0.03))}) for t in range(60)))
    error = [math.dist((1, 0), (s.objects["cup"].x, s.objects["cup"].y)) for s in steps]
    assert max(error[30:]) < 0.02 < max(error[:3])


def test_one_outlier_is_ignored_and_two_in_a_row_mean_that_it_moved():
    at = [(0, 0), (3, 0), (0, 0), (3, 0), (3.1, 0)]
    steps = tracked(*(world(t, {"cup": place}) for t, place in enumerate(at)))
    assert [s.objects["cup"].x for s in steps] == [0, 0, 0, 0, 3.1]


def test_an_object_put_down_is_taken_as_seen_at_once():
    steps = tracked(
        world(0, {"cup": (0, 0)}), world(1, {"cup": (2, 0)}, holding="cup"), world(2, {"cup": (4, 0)}), hold_bridge=0
    )
    assert [s.objects["cup"].x for s in steps] == [0, 2, 4]


def test_a_hand_that_seems_empty_for_one_step_still_holds():
    holding = ["cup", None, "cup", None, None, None]
    steps = tracked(*(world(t, holding=h) for t, h in enumerate(holding)), hold_bridge=1)
    assert [s.agents["human"].holding for s in steps] == ["cup", "cup", "cup", "cup", None, None]


def test_a_hold_seen_once_does_not_count_when_two_are_asked_for():
    holding = ["cup", None, "cup", "cup"]
    steps = tracked(*(world(t, holding=h) for t, h in enumerate(holding)), hold_confirm=2)
    assert [s.agents["human"].holding for s in steps] == [None, None, None, "cup"]


def test_an_agent_out_of_sight_goes_on_as_it_went_for_so_long_and_is_then_absent():
    gaps = [world(t, agent=False) for t in (2, 3, 4)]
    steps = tracked(world(0, at=(0, 0)), world(1, at=(0.5, 0)), *gaps, agent_bridge=2.0)
    assert [s.agents["human"].x if s.agents else None for s in steps] == [0, 0.5, 1.0, 1.5, None]


def test_an_agent_out_of_sight_goes_on_for_two_seconds_and_is_absent_then():
    gone = [world(t, agent=False) for t in (1, 2, 3)]
    assert [set(state.agents) for state in tracked(world(0), *gone)] == [{"human"}, {"human"}, {"human"}, set()]
    assert tracked(world(0), *gone, agent_bridge=0.0)[1].agents == {}


def test_a_standing_agents_noise_is_averaged_and_a_step_is_taken_at_once():
    at = [(0, 0), (0.1, 0), (-0.1, 0), (0.8, 0), (1.6, 0)]
    steps = tracked(*(world(t, at=place) for t, place in enumerate(at)), agent_gate=0.16)
    assert [s.agents["human"].x for s in steps] == pytest.approx([0, 0.05, 0, 0.8, 1.6])


def test_switched_off_it_passes_the_world_through():
    only = world(1, holding="cup")
    assert tracked(world(0, {"cup": (1, 2)}), only, enabled=False)[1] is only


def test_time_running_backwards_is_an_error():
    with pytest.raises(WorldStateError, match="t=1 came after t=2"):
        tracked(world(2), world(1))


@pytest.mark.parametrize("bad", [world(0, {"cup": (math.nan, 0)}), world(0, at=(math.inf, 0))])
def test_a_coordinate_that_is_not_finite_is_an_error(bad):
    with pytest.raises(WorldStateError, match="not finite at t=0"):
        tracked(bad)


def test_a_refused_world_state_leaves_no_trace():
    tracker = Tracker(TrackerSettings())
    tracker.update(world(0, {"cup": (0, 0)}))
    with pytest.raises(WorldStateError):
        tracker.update(world(1, {"cup": (9, 9), "jug": (1, 1), "pan": (math.nan, 0)}))
    assert tracker.update(world(1)).objects == {"cup": ObjectState(0, 0)}


def test_after_a_reset_nothing_is_remembered():
    tracker = Tracker(TrackerSettings())
    tracker.update(world(0, {"cup": (1, 2)}))
    tracker.reset()
    assert tracker.update(world(0)).objects == {}


def test_the_kitchen_bridges_an_agent_for_two_seconds():
    assert tracker_settings(kitchen_rows()).agent_bridge == 2.0


def test_a_negative_gate_is_refused():
    with pytest.raises(DomainError, match="gate of the tracker must not be negative"):
        tracker_settings(rows_of({("setting", 3): [("tracking", "gate", -1)]}))
