"""What the stages from tracking to actions must not depend on: names, where the room is, how it lies, how fast it goes."""

import math
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import kitchen_rows
from walking_person import OBJECTS, Person

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.prediction import action_settings
from casper.engine.movements.movements import movement_classifier
from casper.engine.perception.focus import FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, perception_settings
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.perception.world import AgentState, ObjectState, WorldState

ROWS = kitchen_rows()
NAMES = sorted(OBJECTS)
MOVED = ("biscuits", "meal", "plate", "bottle")


@st.composite
def days(draw):
    """Somebody who brings one thing after the other to a place, and uses it there; seen with noise and gaps."""
    noise, dropout, hidden = (draw(st.sampled_from(each)) for each in ((0.0, 0.01, 0.03), (0.0, 0.1, 0.4), (0.0, 0.1)))
    person = Person(noise, dropout, draw(st.sampled_from((0.25, 0.5, 1.0))), draw(st.integers(0, 10_000)), hidden)
    for _ in range(draw(st.integers(1, 2))):
        thing, place = draw(st.permutations(MOVED))[0], draw(st.sampled_from(("sink", "hobs", "glass")))
        person.pick_and_place(thing, place)
        if draw(st.booleans()):
            person.use(thing)
    return person.states


def told(states, slower=1.0):
    """Of each step the movement, what is attended to, and the chances of the actions; ``slower`` scales all speeds."""
    speeds, tracks, acts = perception_settings(ROWS), tracker_settings(ROWS), action_settings(ROWS)
    speeds = replace(speeds, moving_speed=speeds.moving_speed / slower, qtc_speed=speeds.qtc_speed / slower)
    tracker = Tracker(replace(tracks, agent_bridge=tracks.agent_bridge * slower))
    perception, focus = Perception(speeds, "human"), FocusEstimator(focus_settings(ROWS))
    classifier = movement_classifier(ROWS)
    recogniser = action_recogniser(ROWS, replace(acts, lasts=acts.lasts * slower))
    found = []
    for world in states:
        relations = perception.update(tracker.update(world))
        if relations is None:
            found.append(None)
            continue
        attention = focus.update(relations)
        movement = classifier.update(relations, attention)
        prediction = recogniser.update(movement)
        if prediction is not None:
            recogniser.accept()
        action = None if prediction is None else (prediction.action, prediction.score)
        found.append((movement.name, attention.target, attention.destination, action))
    return found


def changed(states, place, turn, name=str):
    """The same with other places, headings and names."""

    def thing(at):
        return ObjectState(*place(at.x, at.y), at.z)

    def agent(one):
        holding = None if one.holding is None else name(one.holding)
        return AgentState(*place(one.x, one.y), turn(one.heading), holding)

    return [
        WorldState(
            world.t,
            {who: agent(one) for who, one in world.agents.items()},
            {name(other): thing(at) for other, at in world.objects.items()},
        )
        for world in states
    ]


@settings(max_examples=20)
@given(days(), st.permutations(NAMES))
def test_things_may_have_any_names(states, others):
    called = dict(zip(NAMES, others, strict=True))
    renamed = changed(states, lambda x, y: (x, y), float, called.__getitem__)
    expected = [step and (step[0], called.get(step[1]), called.get(step[2]), step[3]) for step in told(states)]
    assert told(renamed) == expected


@settings(max_examples=20)
@given(days())
def test_in_a_mirror_the_same_is_done(states):
    assert told(changed(states, lambda x, y: (x, -y), lambda heading: -heading)) == told(states)


@settings(max_examples=20)
@given(days(), st.floats(-math.pi, math.pi), st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
def test_where_a_room_is_and_how_it_lies_does_not_matter(states, turn, east, north):
    c, s = math.cos(turn), math.sin(turn)
    moved = changed(states, lambda x, y: (c * x - s * y + east, s * x + c * y + north), lambda heading: heading + turn)
    here, there = told(states), told(moved)
    assert [step and step[:3] for step in there] == [step and step[:3] for step in here]
    assert [step and step[3] and step[3][0] for step in there] == [step and step[3] and step[3][0] for step in here]


@settings(max_examples=20)
@given(days(), st.sampled_from((0.25, 0.5, 2.0, 8.0)))
def test_who_does_everything_slower_does_the_same_where_speeds_are_slower_as_much(states, slower):
    slow = [WorldState(world.t * slower, world.agents, world.objects) for world in states]
    assert told(slow, slower) == told(states)


@settings(max_examples=20)
@given(days())
def test_such_days_have_actions(states):
    assert any(step and step[3] for step in told(states)) or len(states) < 40
