"""What was brought somewhere while the partner was out of sight is known from where it lies."""

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.engine.verification.unwatched import Unwatched

TABLE, SINK = (0.0, 0.0), (2.0, 2.0)


def state(t, plate, *, human=True, holds=None, robot_holds=None):
    """The room with a plate somewhere (None: not in it), perhaps with somebody in view."""
    agents = {"tiago": AgentState(0.0, -3.0, 0.0, robot_holds)}
    if human:
        agents["ann"] = AgentState(1.0, 1.0, 0.0, holds)
    things = {"sink": SINK, **({} if plate is None else {"plate": plate})}
    return WorldState(t, agents, {name: ObjectState(*at) for name, at in things.items()})


def found(*states):
    unwatched = Unwatched("ann")
    return [pair for world in states for pair in unwatched.update(world)]


def test_what_lies_elsewhere_when_the_partner_is_seen_again_was_brought_there():
    assert found(state(0, TABLE), state(1, TABLE, human=False), state(2, SINK)) == [("plate", "sink")]


def test_it_is_told_once():
    away = state(0, TABLE), state(1, TABLE, human=False)
    assert found(*away, state(2, SINK), state(3, SINK), state(4, SINK, human=False)) == [("plate", "sink")]


def test_what_is_first_seen_in_the_partners_hand_is_told_when_it_is_put_down():
    away = state(0, TABLE), state(1, TABLE, human=False)
    assert found(*away, state(2, SINK, holds="plate"), state(3, SINK)) == [("plate", "sink")]


def test_what_was_carried_in_view_is_left_to_those_who_watch():
    assert found(state(0, TABLE), state(1, TABLE, holds="plate"), state(2, SINK, holds="plate"), state(3, SINK)) == []


def test_what_the_robot_brought_is_not_the_partners_doing():
    carried = state(1, TABLE, human=False, robot_holds="plate"), state(2, SINK, human=False, robot_holds="plate")
    assert found(state(0, TABLE), *carried, state(3, SINK)) == []


@given(st.lists(st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.booleans()), max_size=20))
def test_what_stays_where_it_is_was_brought_nowhere(steps):
    assert found(*(state(t, (x, y), human=human) for t, (x, y, human) in enumerate(steps))) == []
