"""Lines of JSON read by msgspec hold what they hold when Python's own reader reads them; what is odd is left to that."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("msgspec", reason="lines are read by msgspec where it is installed: pip install 'casper-hri[fast]'")

from casper.engine.live.decoding import plain_world_state
from casper.engine.perception.world import world_state_from_json
from casper.kb.errors import WorldStateError

NUMBERS = st.one_of(st.floats(allow_nan=False, allow_infinity=False), st.integers(-(10**20), 10**20), st.just(-0.0))
NAMES = st.one_of(st.sampled_from(["cup", "human", "sink", "a:b", 'quote"d']), st.text(max_size=8))
AGENTS = st.fixed_dictionaries(
    {"x": NUMBERS, "y": NUMBERS, "heading": NUMBERS, "holding": st.one_of(st.none(), NAMES)}
)
OBJECTS = st.fixed_dictionaries({"x": NUMBERS, "y": NUMBERS, "z": st.one_of(NUMBERS, NUMBERS, st.none())})
STATES = st.fixed_dictionaries(
    {"t": NUMBERS, "agents": st.dictionaries(NAMES, AGENTS, max_size=3), "objects": st.dictionaries(NAMES, OBJECTS)}
)


def exact(world):
    """A world state with its numbers as they are, to the sign of zero."""
    numbers = [world.t, *(n for a in world.agents.values() for n in (a.x, a.y, a.heading))]
    numbers += [n for o in world.objects.values() for n in (o.x, o.y, o.z)]
    return [(n, None if n is None else math.copysign(1, n)) for n in numbers], world, list(world.objects)


def by_python(text):
    """What Python's reader says: a world state, or that there is none."""
    try:
        return exact(world_state_from_json(text))
    except WorldStateError:
        return None


@given(STATES, st.booleans())
def test_what_is_read_is_what_pythons_reader_reads(state, in_ascii):
    text = json.dumps(state, ensure_ascii=in_ascii)
    for line in (text, text.encode("utf-8", "surrogatepass")):
        found = plain_world_state(line)
        assert found is None or exact(found) == by_python(line)


PLAIN = '{"t": 1.5, "agents": {"human": {"x": 1, "y": 2.0, "heading": 0.5, "holding": null}}, "objects": {"cup": {"x": 1.0, "y": 2.0, "z": 0.9}}}'


def test_a_usual_line_needs_no_other_reader():
    found = plain_world_state(PLAIN)
    assert found is not None and exact(found) == by_python(PLAIN)


@given(st.lists(st.tuples(st.integers(0, len(PLAIN) - 1), st.sampled_from('{}[]",:0.-eE nNtu\\')), max_size=3))
def test_a_spoilt_line_is_never_read_otherwise_than_by_pythons_reader(changes):
    text = PLAIN
    for at, sign in changes:
        text = text[:at] + sign + text[at + 1 :]
    found = plain_world_state(text)
    assert found is None or exact(found) == by_python(text)


@pytest.mark.parametrize(
    "spoil",
    [
        ('"t": 1.5', '"t": 1.5, "t": 2.0'),  # twice
        ('"z": 0.9', '"z": 0.9, "x": 3.0'),
        ('"objects": {', '"objects": {"cup": {"x": 0.0, "y": 0.0, "z": 0.0}, '),
        ('"holding": null', '"holding": "a:b"'),  # a colon too many is nobody's loss: the other reader knows
        (', "z": 0.9', ""),
        (', "holding": null', ""),
        ('"t": 1.5', '"type": "robot", "t": 1.5'),
        ('"t": 1.5', '"t": NaN'),
        ('"t": 1.5', '"t": 1e999'),
        ('"t": 1.5', '"t": true'),
    ],
)
def test_what_is_odd_is_left_to_the_other_reader(spoil):
    assert spoil[0] in PLAIN
    assert plain_world_state(PLAIN.replace(*spoil)) is None
