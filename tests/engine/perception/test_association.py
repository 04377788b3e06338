"""Detections whose numbers say nothing are of what lay nearest; by default things are what they are called."""

import json
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper import Domain
from casper.engine.domain.altering import altered
from casper.engine.live import Partners
from casper.engine.perception.filters.association import Associator, kind_of, matched
from casper.engine.perception.tracking import Tracker, TrackerSettings
from casper.engine.perception.world import AgentState, ObjectState, WorldState, world_state_to_json
from casper.kb.errors import DomainError
from casper.streams.watching import watched

NEAREST = TrackerSettings(association="nearest")


def nobody_named(name):
    return False


def world(t, agents=None, **objects):
    return WorldState(t, agents or {}, {name: ObjectState(*place, 0.9) for name, place in objects.items()})


def tracker(is_named=nobody_named):
    return Tracker(NEAREST, associator=Associator(is_named))


def places(state):
    return {name: (round(thing.x, 1), round(thing.y, 1)) for name, thing in state.objects.items()}


@pytest.mark.parametrize(("name", "kind"), [("cup_2", "cup"), ("cup7", "cup"), ("cup#7", "cup"), ("cup", "cup"), ("7", "7")])
def test_a_kind_is_the_name_without_its_number(name, kind):
    assert kind_of(name) == kind


def test_numbers_that_are_swapped_from_state_to_state_swap_nothing():
    tracks = tracker()
    for n in range(10):
        one, other = ("cup_1", "cup_2") if n % 2 == 0 else ("cup_2", "cup_1")
        (state,) = tracks.steps(world(n / 2, **{one: (0.0, 0.0), other: (0.6, 0.0)}))
        assert places(state) == {"cup_1": (0.0, 0.0), "cup_2": (0.6, 0.0)}


def test_by_default_a_thing_is_what_it_is_called():
    tracks = Tracker(TrackerSettings(memory=1, outliers=1))
    tracks.steps(world(0.0, cup_1=(0.0, 0.0), cup_2=(0.6, 0.0)))
    (state,) = tracks.steps(world(0.5, cup_2=(0.0, 0.0), cup_1=(0.6, 0.0)))
    assert places(state) == {"cup_1": (0.6, 0.0), "cup_2": (0.0, 0.0)}


def test_what_was_lost_for_a_moment_and_has_another_number_is_what_it_was():
    tracks = tracker()
    tracks.steps(world(0.0, cup_1=(0.0, 0.0), cup_2=(0.6, 0.0)))
    tracks.steps(world(0.5, cup_1=(0.0, 0.0)))
    (state,) = tracks.steps(world(1.0, cup_1=(0.0, 0.0), cup_9=(0.6, 0.0)))
    assert places(state) == {"cup_1": (0.0, 0.0), "cup_2": (0.6, 0.0)}


def test_one_more_of_a_kind_is_new_though_its_number_was_used_before():
    tracks = tracker()
    tracks.steps(world(0.0, cup_1=(0.0, 0.0), cup_2=(0.6, 0.0)))
    (state,) = tracks.steps(world(0.5, cup_2=(0.0, 0.0), cup_1=(3.0, 0.0), cup_3=(0.6, 0.0)))
    assert places(state) == {"cup_1": (0.0, 0.0), "cup_2": (0.6, 0.0), "cup_3": (3.0, 0.0)}


def test_other_kinds_are_never_taken_for_one_another():
    tracks = tracker()
    tracks.steps(world(0.0, cup_1=(0.0, 0.0), plate_1=(2.0, 0.0)))
    (state,) = tracks.steps(world(0.5, plate_4=(0.0, 0.0), cup_3=(0.1, 0.0)))
    assert set(state.objects) == {"cup_1", "plate_1", "plate_4"}


def test_what_has_no_number_is_what_it_is_called_wherever_it_is():
    tracks = tracker()
    tracks.steps(world(0.0, {"human": AgentState(0.0, 0.0, 0.0)}, sink=(1.0, 1.0)))
    (state,) = tracks.steps(world(0.5, {"human": AgentState(9.0, 9.0, 0.0)}, sink=(8.0, 8.0)))
    assert set(state.agents) == {"human"} and set(state.objects) == {"sink"}


def test_what_is_held_is_called_as_it_was_known():
    tracks = tracker()
    tracks.steps(world(0.0, cup_1=(0.0, 0.0), cup_2=(0.6, 0.0)))
    held = {"human": AgentState(0.0, 0.0, 0.0, "cup_2")}
    (state,) = tracks.steps(world(0.5, held, cup_2=(0.0, 0.0), cup_1=(0.6, 0.0)))
    assert state.agents["human"].holding == "cup_1"


def test_what_is_held_out_of_view_is_what_its_number_meant_last():
    tracks = tracker()
    tracks.steps(world(0.0, cup_1=(0.0, 0.0)))
    tracks.steps(world(0.5, cup_7=(0.0, 0.0)))
    (state,) = tracks.steps(world(1.0, {"human": AgentState(0.0, 0.0, 0.0, "cup_7")}))
    assert state.agents["human"].holding == "cup_1"


def test_people_whose_numbers_change_stay_who_they_are():
    tracks = tracker()
    for n in range(6):
        one, other = ("person_1", "person_2") if n % 2 == 0 else (f"person_{10 + n}", "person_1")
        people = {one: AgentState(0.2 * n, 0.0, 0.0), other: AgentState(5.0, 0.0, 0.0)}
        (state,) = tracks.steps(world(n / 2, people))
        assert state.agents["person_2"].x == 5.0 and set(state.agents) == {"person_1", "person_2"}


@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=5, unique=True), st.randoms())
def test_names_mixed_at_will_leave_every_thing_where_it_is(spots, mixing):
    """Things at rest, 40 cm apart or more, seen with 5 cm of noise under numbers that are drawn anew each time."""
    names, source = [f"cup_{n}" for n in range(len(spots))], random.Random(1)
    named = Associator(nobody_named)
    for n in range(8):
        drawn = names if n == 0 else mixing.sample(names, len(names))
        seen = {d: (0.4 * x + source.uniform(-0.05, 0.05), 0.4 * y) for d, (x, y) in zip(drawn, spots)}
        state = named.update(world(n / 2, **seen))
        assert {name: (round(o.x / 0.4), round(o.y / 0.4)) for name, o in state.objects.items()} == dict(zip(names, spots))


@given(st.dictionaries(st.tuples(st.sampled_from("abc"), st.sampled_from("xyz")), st.integers(0, 9), min_size=1))
def test_pairs_are_as_many_as_can_be_and_of_the_least_cost(costs):
    from itertools import permutations

    names = sorted({name for name, _ in costs})
    found = matched(costs)
    ways = [
        {n: k for n, k in zip(names, chosen) if (n, k) in costs} for chosen in permutations([*"xyz", 1, 2, 3], len(names))
    ]
    best = min(ways, key=lambda way: (-len(way), sum(costs[pair] for pair in way.items())))
    assert len(set(found.values())) == len(found) == len(best)
    assert sum(costs[pair] for pair in found.items()) == sum(costs[pair] for pair in best.items())


def numbered(state, source):
    """A world state as a detector has it that gives each thing a number of its own each time."""
    names = {name: f"{name}_{source.randrange(10**6)}" for name in state.objects}
    agents = {n: AgentState(a.x, a.y, a.heading, names.get(a.holding)) for n, a in state.agents.items()}
    return WorldState(state.t, agents, {names[name]: thing for name, thing in state.objects.items()})


def test_a_detector_that_numbers_at_random_is_read_as_one_that_knows_each_thing():
    pytest.importorskip("mujoco", reason="a simulated lunch is what is seen")
    from casper.sim_adapter.trial import Trial, TrialSettings

    domain, states, source = Domain.load("kitchen"), [], random.Random(5)
    trial = Trial(domain, TrialSettings("lunch", seed=3, robot=False))
    trial.sensed = states.append
    for _ in trial.events():
        pass
    nearest = altered(domain, {"tracking.association": "nearest"})
    minds, other = Partners(domain), Partners(nearest)
    for state in states:
        told = [event.to_json() for event in minds.update(state)]
        assert [event.to_json() for event in other.update(numbered(state, source))] == told
    assert minds.summary()["predicted"] == "lunch"


def test_a_stream_of_numbers_without_end_goes_on():
    domain = altered(Domain.load("kitchen"), {"tracking.association": "nearest"})
    lines = (
        json.dumps(world_state_to_json(world(n / 2, **{f"glass_{2 * n}": (0.0, 0.0), f"mug_{2 * n + 1}": (1.0, 0.0)})))
        for n in range(1500)
    )
    told = [event.data["message"] for event in watched(Partners(domain), lines) if event.type == "warning"]
    assert told == ["line 1: mug_1 is in view and nothing the domain knows; what is done with it is not valid"]


def test_an_association_that_is_none_is_refused():
    with pytest.raises(DomainError, match="association is name or nearest, not best"):
        TrackerSettings(association="best")
