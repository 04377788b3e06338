"""The robot acts on what is sure enough: one rule, one knob."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.collaboration.acting import (
    CHANGED,
    DOUBTFUL,
    NEEDLESS,
    UNSEEN,
    ActingSettings,
    acting_settings,
    sureness,
)
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.altering import altered
from casper.engine.domain.domain import Domain
from casper.engine.mind import Mind
from casper.engine.verification.observation import Observation, Uncertain, certainty_of
from casper.kb.errors import DomainError

KITCHEN = Domain.load("kitchen")
P = st.floats(0, 1)


@given(P, st.lists(P, max_size=5), P)
def test_one_more_action_that_speaks_for_it_never_makes_a_goal_less_sure(posterior, seen, more):
    assert 0 <= sureness(posterior, seen) <= sureness(posterior, [*seen, more]) + 1e-12 <= posterior + 1e-12


@given(P, st.lists(P, max_size=5))
def test_the_order_of_the_actions_is_nothing_to_it(posterior, seen):
    assert sureness(posterior, seen) == pytest.approx(sureness(posterior, seen[::-1]))


@given(P, st.lists(P, max_size=5), st.integers(0, 4))
def test_the_more_must_have_gone_unseen_the_less_sure_is_a_goal(posterior, seen, unseen):
    assert sureness(posterior, seen, unseen + 1) <= sureness(posterior, seen, unseen) <= posterior
    assert sureness(posterior, seen, unseen, instead=True) <= sureness(posterior, seen, unseen)


def test_one_action_is_weighed_against_what_it_asks_one_to_believe():
    assert sureness(1.0, [1.0], 1) == pytest.approx(0.9 * UNSEEN / (0.9 * UNSEEN + NEEDLESS))
    assert sureness(1.0, [1.0], instead=True) == pytest.approx(0.9 * CHANGED / (0.9 * CHANGED + NEEDLESS))
    assert sureness(1.0, [1.0], 2) < 0.5 < sureness(1.0, [1.0], 1)
    assert sureness(1.0, [1.0], instead=True) < 0.5 < sureness(1.0, [1.0, 1.0], instead=True)


def test_one_clear_action_is_as_sure_as_actions_are_ever_for_something():
    assert sureness(1.0, [1.0]) == pytest.approx(1 - NEEDLESS)
    assert sureness(1.0, [1.0, 1.0]) == pytest.approx(1 - NEEDLESS**2)
    assert sureness(1.0, []) == 0.0


def announced(certainty: float, actions: list[str]) -> list[str]:
    """What is announced after each action; an action with a number behind it was recognised with that probability."""
    supervisor = Supervisor(KITCHEN.reading(), "tiago", ActingSettings(certainty))
    told = []
    for t, action in enumerate(actions):
        supervisor.reading.observe(action)
        told += [f"{event.type} {event.data['goal']}" for event in supervisor.update(float(t))]
    return told


LUNCH = ["pick_and_place(meal, hobs)", "cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"]


def test_at_0_the_robot_announces_whatever_the_policy_commits_to():
    assert announced(0.0, LUNCH[:1]) == ["prediction lunch", "plan lunch"]


@pytest.mark.parametrize(("certainty", "actions"), [(0.9, 1), (0.91, 2), (0.99, 2), (0.995, 3), (0.9995, 4)])
def test_the_surer_a_goal_must_be_the_more_actions_it_takes(certainty, actions):
    assert announced(certainty, LUNCH[: actions - 1]) == []
    assert announced(certainty, LUNCH[:actions])[0] == "prediction lunch"


def test_at_1_nothing_is_ever_announced():
    assert announced(1.0, LUNCH) == []


def test_what_was_hardly_recognised_says_less():
    supervisor = Supervisor(KITCHEN.reading(), "tiago", ActingSettings(0.8))
    supervisor.reading.observe(Observation(LUNCH[0][:14], ("meal", "hobs"), certainty=0.6))
    assert supervisor.sureness_of("lunch") == pytest.approx(0.54) and not list(supervisor.update(1.0))
    supervisor.reading.observe(Observation("cook", certainty=0.9))
    assert supervisor.sureness_of("lunch") == pytest.approx(1 - 0.46 * 0.19) and list(supervisor.update(2.0))


def test_a_goal_that_nothing_speaks_for_is_not_sure_at_all():
    assert Supervisor(KITCHEN.reading(), "tiago").sureness_of("lunch") == 0.0


def test_another_goal_that_is_not_sure_yet_is_not_announced_in_place_of_one_that_is():
    reading = KITCHEN.reading(noise=0.2)
    supervisor = Supervisor(reading, "tiago", ActingSettings(0.95))
    told = []
    for t, action in enumerate(["pick_and_place(bottle, glass)", *LUNCH[:2]]):
        reading.observe(action)
        told += [event.data["goal"] for event in supervisor.update(float(t)) if event.type == "prediction"]
    assert "drink" not in told


def test_an_uncertain_action_is_as_certain_as_its_likeliest_reading():
    eat, sip = Observation("eat"), Observation("sip")
    assert certainty_of(Uncertain(((eat, 0.7), (sip, 0.2)))) == 0.7 and certainty_of(eat) == 1.0


def test_a_domain_states_the_knob_and_a_mind_may_be_given_another():
    strict = altered(KITCHEN, {"collaboration.certainty": 0.95})
    assert Mind(strict).supervisor.acting.certainty == 0.95
    assert Mind(strict, certainty=0.6).supervisor.acting.certainty == 0.6
    assert Mind(KITCHEN).supervisor.acting.certainty == 0.5


@pytest.mark.parametrize("value", [-0.1, 1.1, float("nan")])
def test_a_certainty_that_is_none_is_told(value):
    with pytest.raises(DomainError, match="lies between 0 and 1"):
        acting_settings(KITCHEN.kb.rows, value)


def test_a_misspelt_knob_is_told_with_the_nearest():
    with pytest.raises(DomainError, match="did you mean certainty"):
        Mind(altered(KITCHEN, {"collaboration.certanty": 0.9}))


def test_the_robot_waits_while_it_is_not_sure_that_its_turn_has_come():
    supervisor = Supervisor(KITCHEN.reading(), "tiago")
    supervisor.doubts = True
    carried, eaten = "pick_and_place(biscuits, plate)", "eat(biscuits, plate)"
    for t, seen in enumerate([{carried: 0.6, eaten: 0.4}, {carried: 0.5, eaten: 0.5}]):
        supervisor.reading.observe(seen)
        list(supervisor.update(float(t)))
        assert supervisor.commitment is not None and supervisor.commitment.goal == "breakfast"
        if t == 0:
            assert not supervisor.ready
    assert supervisor.ready


@pytest.mark.parametrize(
    ("certainty", "share", "told"),
    [(0.5, 0.95, ["breakfast"]), (0.5, 0.6, []), (0.0, 0.6, []), (0.75, 0.95, ["breakfast"]), (0.9, 0.85, [])],
)
def test_of_a_poor_sensor_a_goal_is_announced_from_the_knobs_share_on_and_four_of_five_at_least(certainty, share, told):
    supervisor = Supervisor(KITCHEN.reading(), "tiago", ActingSettings(certainty))
    supervisor.doubts = True
    supervisor.reading.observe({"pick_and_place(biscuits, plate)": share, "pick_and_place(bottle, glass)": 1 - share})
    events = list(supervisor.update(0.0))
    assert [event.data["goal"] for event in events if event.type == "prediction"] == told


@given(P)
def test_the_robots_turn_is_asked_to_be_as_sure_as_a_goal(certainty):
    assert ActingSettings(certainty).share == max(certainty, DOUBTFUL)
