"""Live minds take needless and misread actions at their price where the sensor is poor, and only there."""

import pytest

from casper import Domain
from casper.engine.domain.altering import altered
from casper.engine.mind import Mind
from casper.engine.perception.world import AgentState, Doubt, ObjectState, WorldState
from casper.engine.verification.observation import Observation
from casper.kb.errors import DomainError

KITCHEN = Domain.load("kitchen")
SPOTS = {name: ObjectState(x, y, z) for name, x, y, z in KITCHEN.kb.rows("position", 4)}
MEAL_TO_HOBS, COOK = Observation("pick_and_place", ("meal", "hobs")), Observation("cook", ("meal", "hobs"))
GLASS_AWAY = Observation("pick_and_place", ("glass", "plate"))


def watched(mind, doubt, steps=4):
    for step in range(steps):
        mind.notice(WorldState(1.0 + 0.5 * step, {"human": AgentState(0.0, 0.0, 0.0, doubt=doubt)}, SPOTS))
    return mind


def unsure(mind):
    return watched(mind, Doubt(grasp=0.1, moves=0.1, spread=0.1))


def price(mind):
    return mind.reading.options.noise


def test_who_sees_well_takes_no_action_for_needless():
    assert price(watched(Mind(KITCHEN), None)) is None


@pytest.mark.parametrize(
    "mind, expected",
    [
        (Mind(KITCHEN), 0.01),
        (Mind(altered(KITCHEN, {"plans.needless": 0.2})), 0.2),
        (Mind(KITCHEN, noise=0.3), 0.3),
        (Mind(KITCHEN, stops=True), None),
    ],
    ids=["the default", "as the domain says", "as it was told", "one that stops there"],
)
def test_from_a_doubt_on_needless_actions_have_the_price_of_the_domain(mind, expected):
    assert price(unsure(mind)) == expected


def test_what_was_observed_before_the_doubt_is_read_anew():
    mind = Mind(KITCHEN)
    list(mind.course.read(MEAL_TO_HOBS, 0.5))
    unsure(mind)
    assert list(mind.reading.observations) == [MEAL_TO_HOBS] and price(mind) == 0.01
    assert mind.supervisor.reading is mind.reading and mind.reading.posterior["lunch"] == 1.0


def test_an_action_that_fits_no_plan_is_weighed_where_the_sensor_is_poor_and_left_out_elsewhere():
    seeing, poor = Mind(KITCHEN), unsure(Mind(KITCHEN))
    day = (MEAL_TO_HOBS, GLASS_AWAY, COOK)
    left_out, weighed = (
        [event for seen in day for event in mind.course.read(seen, 5.0) if event.type == "warning"]
        for mind in (seeing, poor)
    )
    assert len(left_out) == 1 and len(seeing.reading.observations) == 2
    assert not weighed and list(poor.reading.first.needless) == [1]
    assert poor.supervisor.commitment.goal == seeing.supervisor.commitment.goal == "lunch"


def test_a_first_action_that_was_misread_is_outweighed_by_those_that_follow():
    mind = unsure(Mind(KITCHEN))
    for seen in (Observation("pick_and_place", ("plate", "sink")), MEAL_TO_HOBS, COOK):
        list(mind.course.read(seen, 5.0))
    assert mind.supervisor.commitment.goal == "lunch"


def test_a_price_that_is_none_is_refused_before_anything_is_watched():
    with pytest.raises(DomainError, match="a price is a number above 0 and below 1"):
        Mind(altered(KITCHEN, {"plans.needless": 2.0}))


@pytest.mark.parametrize("more", ["more --> close.", "more --> put, more. more --> close."], ids=["listed", "endless"])
def test_a_reading_that_is_read_anew_has_what_was_observed_and_the_price(more):
    plans = f"goal(tidy). goal(cook). tidy --> put, more. {more} cook --> stir, serve."
    reading = Domain.from_text(plans=plans).reading()
    reading.observe("put")
    again = reading.reread(0.1)
    assert again.observations == reading.observations and again.posterior == reading.posterior
    again.observe("stir")
    reading.observe("stir")
    assert again.posterior == {"tidy": 0.5, "cook": 0.5} and not any(reading.posterior.values())
