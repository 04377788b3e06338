"""The paper's experiment (section V-E): fifteen seeded trials, watched and helped to the end."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest

pytest.importorskip("mujoco")

from casper import Domain
from casper.engine.events import TYPES
from casper.sim_adapter.trial import Trial, TrialSettings

GOALS = ("breakfast", "drink", "lunch")
SEEDS = range(5)
EXPERIMENT = [(goal, seed) for goal in GOALS for seed in SEEDS]


@cache
def summary(goal: str, seed: int, verification: bool = True) -> dict[str, Any]:
    *_, last = Trial(Domain.load("kitchen"), TrialSettings(goal, seed, verification)).events()
    assert last.type == "summary"
    return dict(last.data)


@pytest.mark.parametrize(("goal", "seed"), EXPERIMENT)
def test_the_goal_is_read_before_the_partners_last_action_and_the_robots_part_is_finished(goal: str, seed: int) -> None:
    told = summary(goal, seed)
    assert told["predicted"] == goal
    assert told["prediction_time"] < told["partner_finished"]
    assert told["robot"]["done"], told
    assert told["robot"]["actions"][-1].startswith("wash(")


@pytest.mark.parametrize("seed", [0, 5])
def test_nothing_that_stands_beside_what_the_robot_takes_is_knocked_over(seed: int) -> None:
    trial = Trial(Domain.load("kitchen"), TrialSettings("drink", seed))
    list(trial.events())
    standing = trial.simulation.physics.position("glass")[2]
    assert trial.simulation.physics.position("bottle")[2] > standing


@pytest.mark.parametrize("goal", GOALS)
def test_verification_makes_the_prediction_no_later_on_average(goal: str) -> None:
    verified = [summary(goal, seed)["prediction_time"] for seed in (0, 1)]
    unverified = [summary(goal, seed, False)["prediction_time"] for seed in (0, 1)]
    assert sum(verified) <= sum(unverified)


def test_the_same_seed_gives_the_same_events() -> None:
    settings = TrialSettings("breakfast", 7, robot=False)
    first, second = ([e.to_json() for e in Trial(Domain.load("kitchen"), settings).events()] for _ in range(2))
    assert first == second


def test_the_events_are_those_of_the_design_and_time_never_runs_backwards() -> None:
    events = list(Trial(Domain.load("kitchen"), TrialSettings("drink", 3, robot=False)).events())
    assert {event.type for event in events} <= set(TYPES)
    assert [event.type for event in events].count("summary") == 1
    times = [event.t for event in events]
    assert times == sorted(times)


def test_without_a_robot_the_partner_does_everything() -> None:
    trial = Trial(Domain.load("kitchen"), TrialSettings("breakfast", 1, robot=False))
    *_, last = trial.events()
    robot = last.data["robot"]
    assert robot["actions"] == robot["gave_up"] == [] and not robot["done"]
    assert last.data["planned"] == 0
    assert trial.simulation.rests_in("plate", "sink")
    assert len(trial.simulation.human.done) == len(trial.script)


def test_the_goal_is_drawn_from_the_seed_when_none_is_given() -> None:
    drawn = {Trial(Domain.load("kitchen"), TrialSettings(None, seed)).goal for seed in range(12)}
    assert drawn == set(GOALS)
