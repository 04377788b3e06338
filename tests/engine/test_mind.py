"""The mind on hand-made world states: what it tells, and what a bad world state does to it."""

from __future__ import annotations

import math

import pytest

from casper import Domain, Mind
from casper.engine.movements.movements import Movement
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.engine.verification.observation import Observation
from casper.kb.errors import CasperError, DomainError, WorldStateError

KITCHEN = Domain.load("kitchen")
PLACES = {"biscuits": (1.0, 0.0), "plate": (5.0, 0.0), "sink": (5.0, 5.0), "hobs": (0.0, 5.0)}


def world(t, x=0.5, y=0.0, heading=0.0, holding=None, **moved):
    objects = {name: ObjectState(*moved.get(name, at), 0.8) for name, at in PLACES.items()}
    return WorldState(t, {"human": AgentState(x, y, heading, holding)}, objects)


def breakfast_states(period=0.5):
    """A partner takes the biscuits to the plate and eats: standing, carrying along the x axis, three picks and places."""
    t, states = 0.0, []

    def then(steps, **now):
        nonlocal t
        for _ in range(steps):
            t += period
            states.append(world(t, **now))

    then(8)
    then(2, holding="biscuits", biscuits=(0.7, 0.0))
    x = 0.5
    while x < 4.5:
        x += 0.3
        then(1, x=x, holding="biscuits", biscuits=(x, 0.0))
    for _ in range(3):
        then(6, x=x, holding="biscuits", biscuits=(5.0, 0.0))
        then(6, x=x, biscuits=(5.0, 0.0))
    return states


def told(mind, states):
    return [event for state in states for event in mind.update(state)]


def test_a_breakfast_is_seen_verified_predicted_and_planned_for():
    events = told(Mind(KITCHEN), breakfast_states())
    verdicts = [e.data["statement"] for e in events if e.type == "verdict" and e.data["valid"]]
    assert verdicts[:2] == ["pick_and_place(human, biscuits, plate)", "eat(human, biscuits, plate)"]
    (prediction,) = [e for e in events if e.type == "prediction"]
    assert (prediction.data["goal"], prediction.data["observed"]) == ("breakfast", 1)
    plans = [e.data for e in events if e.type == "plan"]
    assert [plan["ready"] for plan in plans] == [False, True]
    assert plans[0]["waiting"] == ["eat(biscuits, plate)"]


def test_every_step_tells_focus_and_movement_first():
    for state in breakfast_states()[:5]:
        assert told(Mind(KITCHEN), [state])[0].type == "focus"


def test_without_verification_there_are_no_verdicts_and_names_only():
    events = told(Mind(KITCHEN, verification=False), breakfast_states())
    assert not [e for e in events if e.type == "verdict"]
    readings = [e.data["observations"] for e in events if e.type == "reading"]
    assert readings[0] == ["pick_and_place"]


def test_a_mind_that_does_not_help_plans_nothing():
    events = told(Mind(KITCHEN, helps=False), breakfast_states())
    assert [e for e in events if e.type == "prediction"]
    assert not [e for e in events if e.type == "plan"]


def test_a_refused_action_is_told_once_with_its_reason_and_explains_nothing():
    mind = Mind(KITCHEN)
    states = [s for s in breakfast_states()]
    wrong = [
        WorldState(s.t, s.agents, {**s.objects, "plate": ObjectState(9.0, 9.0, 0.8), "hobs": ObjectState(5.0, 0.0, 0.8)})
        for s in states
    ]
    events = told(mind, wrong)
    refused = [e.data for e in events if e.type == "verdict" and not e.data["valid"]]
    sentences = [d["reasons"] for d in refused if d["statement"] == "pick_and_place(human, biscuits, hobs)"]
    assert sentences == [["the biscuits go on the plate only"]]


def test_a_bad_world_state_is_refused_and_the_mind_goes_on_as_if_it_had_not_been():
    states = breakfast_states()
    undisturbed, disturbed = Mind(KITCHEN), Mind(KITCHEN)
    expected = [e.to_json() for e in told(undisturbed, states)]
    found = []
    for at, state in enumerate(states):
        if at % 7 == 3:
            with pytest.raises(WorldStateError):
                disturbed.update(WorldState(state.t, {"human": AgentState(math.nan, 0.0, 0.0)}, state.objects))
            with pytest.raises(WorldStateError):
                disturbed.update(states[at - 1])
        found += [e.to_json() for e in disturbed.update(state)]
    assert found == expected


def test_a_domain_without_movements_cannot_be_watched(tmp_path):
    (tmp_path / "plans.pl").write_text("tea --> boil.\n")
    with pytest.raises(DomainError):
        Mind(Domain.load(tmp_path))


def test_an_observation_that_fits_no_plan_is_reported_and_the_reading_goes_on_from_where_it_was():
    mind = Mind(KITCHEN)
    told(mind, breakfast_states())
    before = mind.reading.to_json()
    (warning,) = mind._read(Observation("cook", ("meal", "hobs")), 99.0)
    assert warning.type == "warning"
    assert "fits no plan" in warning.data["message"]
    assert mind.reading.to_json() == before


def test_a_mind_that_is_told_to_stop_refuses_an_observation_that_fits_no_plan():
    mind = Mind(KITCHEN, stops=True)
    told(mind, breakfast_states())
    before = mind.reading.to_json()
    with pytest.raises(CasperError, match=r"cook\(meal, hobs\) fits no plan any more"):
        list(mind._read(Observation("cook", ("meal", "hobs")), 99.0))
    assert mind.reading.to_json() == before


def test_a_mind_that_allows_needless_actions_goes_on_past_one():
    mind = Mind(KITCHEN, noise=0.1)
    told(mind, breakfast_states())
    event = next(mind._read(Observation("cook", ("meal", "hobs")), 99.0))
    assert event.type == "reading"
    assert event.data["best"][0]["needless"] == [len(event.data["observations"])]


def test_a_mind_like_another_has_its_options():
    mind = Mind(KITCHEN, noise=0.1, goals=2, stops=True).like(KITCHEN)
    assert mind.course.stops
    assert (mind.reading.options.noise, mind.reading.options.goals) == (0.1, 2)


def test_an_action_in_no_plan_is_reported():
    (warning,) = Mind(KITCHEN)._read(Observation("relocate", None), 1.0)
    assert "is in no plan" in warning.data["message"]


def test_movements_come_with_the_features_they_were_read_from():
    (event,) = [e for e in told(Mind(KITCHEN), breakfast_states()[:1]) if e.type == "movement"]
    assert set(event.data["features"]) == {"mos", "hold", "qdc", "qtc"}
    assert isinstance(Movement(0.0, "still", None).name, str)
