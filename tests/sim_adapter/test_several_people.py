"""Two people and a robot at shared machines: whose goals, whose steps, and one whole trial."""

from functools import cache

import pytest

pytest.importorskip("mujoco")

from casper import Domain
from casper.kb.errors import DomainError
from casper.kb.terms.syntax import term_text
from casper.sim_adapter.partners.goals import goals_of_partners
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.script import script_for
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.trial import Trial, TrialSettings

WORKSHOP = Domain.load("workshop")
SCENE = scene_of(WORKSHOP)


@cache
def trial():
    made = Trial(WORKSHOP, TrialSettings("stool,lamp", 1))
    return made, tuple(made.events())


def of(kind, partner):
    return [e.data for e in trial()[1] if e.type == kind and partner in (e.data.get("partner"), e.data.get("agent"))]


def goals(wanted=(), seed=0, in_a_row=None):
    return goals_of_partners(WORKSHOP, SCENE, list(wanted), in_a_row, False, seed)


# --- whose goals ------------------------------------------------------------------------------------------------------


def test_goals_that_are_named_are_dealt_out_in_turn():
    assert goals(["stool", "lamp"]) == {"ida": ["stool"], "otto": ["lamp"]}


def test_the_others_are_drawn_and_nobody_moves_what_somebody_else_does():
    drawn = {tuple(goal for theirs in goals(seed=seed).values() for goal in theirs) for seed in range(40)}
    assert len(drawn) > 8 and all(one != other for one, other in drawn)
    assert all(goals(["toy"], seed)["otto"] != ["toy"] for seed in range(10))


def test_two_who_would_move_the_same_thing_are_refused():
    with pytest.raises(DomainError, match="stool can be pursued by ida beside stool: two people cannot both move"):
        goals(["stool", "stool"])


def test_of_one_partner_it_is_as_before():
    kitchen = Domain.load("kitchen")
    assert goals_of_partners(kitchen, scene_of(kitchen), ["lunch", "drink"], None, False, 0) == {
        "human": ["lunch", "drink"]
    }


# --- whose steps --------------------------------------------------------------------------------------------------------


def test_seeds_take_all_ways_that_the_plans_allow():
    machines = {script_for(WORKSHOP, "stool", seed)[2].step.destination for seed in range(10)}
    assert machines == {"press", "gluing"}
    assert {len(script_for(WORKSHOP, "toy", seed)) for seed in range(10)} == {7, 9}  # boring the block is optional


def test_a_step_of_the_robot_is_the_robots_and_a_variable_is_whoever_pursues_the_goal():
    script = script_for(WORKSHOP, "lamp", 0)
    assert [s.by for s in script] == [None] * 4 + ["rover"] * 2 + [None]
    assert term_text(script[4].action) == "pick_and_place(plate, oven)"


# --- one trial ----------------------------------------------------------------------------------------------------------


def test_both_goals_are_read_and_the_robot_does_its_part_in_both():
    summary = trial()[1][-1].data
    assert [(row["agent"], row["goal"], row["correct"]) for row in summary["partners"]] == [
        ("ida", "stool", True),
        ("otto", "lamp", True),
    ]
    assert summary["correct"] and summary["robot"]["done"]
    assert len(summary["robot"]["actions"]) == 6


def test_every_event_names_whom_it_is_about():
    assert [row["goal"] for row in of("prediction", "ida")] == ["stool"]
    assert [row["goal"] for row in of("prediction", "otto")] == ["lamp"]
    assert not [e for e in trial()[1] if e.type == "withdrawn"]


def test_nobody_but_the_robot_goes_to_the_oven():
    simulation = trial()[0].simulation
    done = [step.destination for human in simulation.people.values() for step in human.done]
    assert "oven" not in done and "store" not in done
    assert simulation.rests_in("seat", "store") and simulation.rests_in("plate", "store")


def test_people_and_robot_start_apart_and_each_is_seen():
    simulation = Simulation(SCENE, seed=3)
    assert set(simulation.truth().agents) == {"ida", "otto", "rover"}
    seen = set().union(*(simulation.observe().agents for _ in range(5)))  # the eye overlooks somebody now and then
    assert seen == {"ida", "otto", "rover"}


def test_a_person_is_told_what_became_of_each():
    ida, otto, *_ = str(trial()[1][-1]).splitlines()
    assert "ida wanted stool; predicted stool" in ida and ida.endswith("right")
    assert "otto wanted lamp; predicted lamp" in otto and otto.endswith("right")
