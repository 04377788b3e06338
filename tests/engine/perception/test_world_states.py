"""World states as JSON: what is read, what is written, and what is refused in one sentence."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.perception.world import (
    AgentState,
    ObjectState,
    WorldState,
    world_state_from_json,
    world_state_to_json,
)
from casper.kb.errors import WorldStateError

metres = st.floats(-1e6, 1e6)
names = st.sampled_from(["human", "plate", "glass 2"])
states = st.builds(
    WorldState,
    st.floats(0, 1e6),
    st.dictionaries(names, st.builds(AgentState, metres, metres, metres, st.none() | names), max_size=2),
    st.dictionaries(names, st.builds(ObjectState, metres, metres, st.none() | metres), max_size=2),
)


@given(states)
def test_a_world_state_is_read_as_it_was_written(world):
    data = world_state_to_json(world)
    assert world_state_from_json(data) == world
    assert world_state_from_json(json.dumps(data)) == world
    assert world_state_from_json(json.dumps(data).encode()) == world


def sound():
    return {"t": 2, "agents": {"ann": {"x": 0, "y": 1, "heading": 0.5}}, "objects": {"plate": {"x": 1, "y": 2}}}


def test_hand_and_height_may_be_missing():
    world = world_state_from_json(sound())
    assert world.agents["ann"] == AgentState(0.0, 1.0, 0.5, None)
    assert world.objects["plate"] == ObjectState(1.0, 2.0, None)
    assert isinstance(world.t, float)


def changed(*path, value):
    data = sound()
    *above, last = path
    place = data
    for key in above:
        place = place[key]
    place[last] = value
    return data


@pytest.mark.parametrize(
    ("data", "sentence"),
    [
        ("{", "this is not a line of JSON"),
        ("[" * 100_000, "this is not a line of JSON"),
        ([1], 'a world state is an object with "t", "agents" and "objects", not [1]'),
        ("3", "a world state is an object"),
        (changed("t", value=None), 'the world state has no number under "t"'),
        (changed("t", value=True), 'the world state has no number under "t"'),
        (changed("t", value=float("nan")), 'the world state has nan under "t"'),
        (changed("agents", value=[]), 'the world state at t=2 has no object under "agents"'),
        (changed("objects", "plate", value=3), '"plate" under "objects" at t=2 must be an object with its coordinates'),
        (changed("agents", "ann", "x", value="1"), 'agent ann at t=2 has no number under "x"'),
        (changed("agents", "ann", "y", value=float("inf")), 'agent ann at t=2 has inf under "y"'),
        (changed("agents", "ann", "heading", value=None), 'agent ann at t=2 has no number under "heading"'),
        (changed("agents", "ann", "holding", value=3), 'agent ann at t=2 has 3 under "holding"'),
        (changed("objects", "plate", "z", value="high"), 'object plate at t=2 has no number under "z"'),
        (changed("objects", "plate", "y", value=[]), 'object plate at t=2 has no number under "y"'),
    ],
)
def test_what_is_no_world_state_is_refused_by_name_and_time(data, sentence):
    with pytest.raises(WorldStateError) as told:
        world_state_from_json(data)
    assert sentence in str(told.value)


NUMBERS = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(10**9), 10**9)


@given(NUMBERS, NUMBERS, NUMBERS | st.none(), NUMBERS)
def test_whatever_numbers_a_line_has_they_are_read_as_they_are(x, y, z, heading):
    agents = {"human": {"x": x, "y": y, "heading": heading, "holding": None if z is None else "cup"}}
    line = json.dumps({"t": 1, "agents": agents, "objects": {"cup": {"x": x, "y": y, "z": z}, "pan": {"x": x, "y": y}}})
    world = world_state_from_json(line)
    assert world.objects == {"cup": ObjectState(x, y, z), "pan": ObjectState(x, y)}
    assert world.agents == {"human": AgentState(x, y, heading, None if z is None else "cup")}


@pytest.mark.parametrize("entry", [None, 3, "cup", [1.0, 2.0]])
def test_an_entry_that_is_no_object_is_named(entry):
    with pytest.raises(WorldStateError, match='"cup" under "objects" at t=1 must be an object'):
        world_state_from_json({"t": 1.0, "agents": {}, "objects": {"cup": entry}})
