"""Readings with a clock and without one: what rules make of how long ago something was."""

from typing import Any

import pytest

from casper.engine.domain.domain import Domain
from casper.kb.terms.terms import Compound

ONTOLOGY = """human(ann). robot(rob). medicine(pills).
eat(A) :- human(A).
take(A, M) :- human(A), medicine(M).
drink(A) :- human(A).
offer(A) :- robot(A), did(take(_, _), T), did(drink(_), T2), T2 - T >= 60.
never("pills need a minute after the meal") :- claim(take(_, _)), did(eat(_), T), \\+ (did(drink(_), T2), T2 - T >= 60)."""
LISTED = "goal(care). goal(treat). care --> eat, drink, take(pills), optional(by(robot, offer)). treat --> eat, drink, drink."
GROWN = "goal(care). goal(treat). care --> eat, more, take(pills). treat --> eat, more. more --> drink. more --> drink, more."


def readings(plans: str) -> Any:
    return Domain.from_text(ontology=ONTOLOGY, plans=plans).reading()


@pytest.fixture(params=[LISTED, GROWN], ids=["listed", "grown"])
def reading(request: pytest.FixtureRequest) -> Any:
    return readings(request.param)


def observe(reading: Any, *observed: tuple[str, float | None]) -> Any:
    for action, t in observed:
        reading.observe(action, t)
    return reading


def test_without_a_clock_time_rules_nothing_out(reading: Any) -> None:
    assert observe(reading, ("eat", None), ("drink", None), ("take(pills)", None)).posterior["care"] == 1.0


def test_with_a_clock_time_does(reading: Any) -> None:
    assert observe(reading, ("eat", 0.0), ("drink", 30.0), ("take(pills)", 31.0)).posterior["care"] == 0.0
    assert "pills need a minute after the meal" in reading.rejected["care"][0]


def test_time_that_has_passed_is_enough(reading: Any) -> None:
    assert observe(reading, ("eat", 0.0), ("drink", 60.0), ("take(pills)", 61.0)).posterior["care"] == 1.0


def test_what_was_done_earlier_comes_with_its_time() -> None:
    domain = Domain.from_text(ontology=ONTOLOGY, plans="goal(care). care --> take(pills).")
    eaten, drunk = Compound(("eat", "ann")), Compound(("drink", "ann"))
    assert observe(domain.reading(earlier=[(eaten, 0.0), (drunk, 30.0)]), ("take(pills)", 99.0)).count == 0
    assert observe(domain.reading(earlier=[(eaten, 0.0), (drunk, 99.0)]), ("take(pills)", 99.5)).count == 1
    assert observe(domain.reading(earlier=[eaten, drunk]), ("take(pills)", 99.0)).count == 1


def test_a_time_after_moments_is_one(reading: Any) -> None:
    assert observe(reading, ("eat", None), ("drink", 30.0), ("take(pills)", 31.0)).posterior["care"] == 1.0


def test_a_day_knows_its_times() -> None:
    domain = Domain.from_text(ontology=ONTOLOGY, plans=LISTED)
    late, early, unknown = domain.day(), domain.day(), domain.day()
    for number, action in enumerate(("eat", "drink", "take(pills)")):
        late.observe(action, 60.0 * number)
        early.observe(action, 1.0 * number)
        unknown.observe(action)
    assert late.current["care"] == unknown.current["care"] > 0.99
    assert early.current["care"] == 0.0


def test_the_robot_does_nothing_of_which_that_is_not_known() -> None:
    reading = observe(readings(LISTED), ("eat", 0.0), ("drink", 60.0), ("take(pills)", 61.0))
    assert reading.plan_for("rob").actions == ()


def test_a_robot_in_unlisted_plans_waits_too() -> None:
    plans = "goal(care). care --> eat, more, take(pills), by(robot, offer). more --> drink. more --> drink, more."
    known, unknown = (Domain.from_text(ontology=ONTOLOGY, plans=plans).day() for _ in range(2))
    for t, action in enumerate(("eat", "drink", "take(pills)")):
        unknown.observe(action)
        known.observe(action, 60.0 * t)
    assert unknown.plan_for("rob").actions == ()


def test_times_come_along_to_other_processes(reading: Any) -> None:
    import pickle

    observe(reading, ("eat", 0.0), ("drink", 30.0))
    again = pickle.loads(pickle.dumps(reading))
    again.observe("take(pills)", 31.0)
    assert again.posterior["care"] == 0.0
