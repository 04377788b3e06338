"""The contract of domains, recognisers and planners: ours keep it, and others are found out."""

from collections.abc import Iterator

import pytest
from hypothesis import settings

from casper.engine.domain.domain import Domain
from casper.testing.contract import DomainContract, PlannerContract, RecogniserContract

KITCHEN = Domain.load("kitchen")


@pytest.fixture(autouse=True)
def _fewer_examples() -> Iterator[None]:
    """Each example is a whole course of changes or observations; few of them say much."""
    name = settings.get_current_profile_name()
    fewer = settings.get_profile(name).max_examples // 5
    settings.register_profile("contract", settings.get_profile(name), max_examples=fewer)
    settings.load_profile("contract")
    yield
    settings.load_profile(name)


class TestTheKitchen(DomainContract):
    domain = KITCHEN


class TestOurOwnRecogniser(RecogniserContract):
    domain = KITCHEN

    def recogniser(self):
        return self.domain.reading()


class TestOurOwnPlanner(PlannerContract):
    domain = KITCHEN

    def plan(self, reading):
        plan = reading.plan_for("tiago")
        return () if plan is None else plan.actions


class Stubborn:
    """A recogniser that always says the same, and not even that it is sure."""

    @property
    def posterior(self) -> dict[str, float]:
        return {"lunch": 0.5, "dinner": 0.25}

    def observe(self, action: str) -> None:
        pass


def test_a_recogniser_that_breaks_the_laws_is_found_out() -> None:
    class Mine(RecogniserContract):
        domain = KITCHEN

        def recogniser(self):
            return Stubborn()

    for law, words in (
        (Mine().test_shares_sum_to_one, "sum to 0.75"),
        (Mine().test_goals_are_those_of_the_library, "no goals dinner"),
        (Mine().test_a_goal_leads_when_it_was_pursued, "breakfast its share is 0.0"),
    ):
        with pytest.raises(AssertionError, match=words):
            law()


def test_a_planner_that_gives_the_robot_what_it_cannot_do_is_found_out() -> None:
    class Mine(PlannerContract):
        domain = KITCHEN

        def plan(self, reading):
            return ["eat(meal, plate)"]

    with pytest.raises(AssertionError, match="tiago is not a human"):
        Mine().test_every_step_is_valid_for_the_robot()
