"""A simulated partner's whole day: goal after goal, a change of mind, and a robot that keeps what it said."""

from __future__ import annotations

import math
import sys
from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import SCRIPTS, kitchen_scene, put, run_until_idle, use

from casper import Domain
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound
from casper.sim_adapter.helping import Helper
from casper.sim_adapter.partners.goals import goals_of_a_day
from casper.sim_adapter.partners.partner import Partner
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.trial import Trial, TrialSettings

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks" / "day"))

from room import broken_by, helped_of, read_of

KITCHEN = Domain.load("kitchen")
CLEARED = (Compound(("pick_and_place", "plate", "sink")), Compound(("wash", "plate", "sink")))


@cache
def day(goals: str, seed: int, changes_mind: bool = False, verification: bool = True):
    """The events of a day."""
    return tuple(Trial(KITCHEN, TrialSettings(goals, seed, verification, changes_mind=changes_mind)).events())


def of(events, kind):
    return [event.data for event in events if event.type == kind]


def test_breakfast_a_drink_and_lunch_in_a_row_are_read_and_helped_with():
    events = day("breakfast,drink,lunch", 1)
    assert tuple(read_of(events)) == tuple(helped_of(events)) == ("breakfast", "drink", "lunch")
    summary = events[-1].data
    assert summary["goals"] == ["breakfast", "drink", "lunch"]
    assert summary["correct"] and summary["robot"]["done"]
    assert [row["outcome"] for row in summary["episodes"]] == ["finished"] * 3
    assert not list(broken_by(events))


def test_a_change_from_lunch_to_breakfast_is_read_and_what_was_announced_is_withdrawn_and_not_done():
    events = day("lunch,breakfast", 1, True)
    assert [row["goal"] for row in of(events, "withdrawn")] == ["lunch"]
    assert [(row["goal"], row["outcome"]) for row in of(events, "episode")] == [("lunch", "abandoned"), ("breakfast", "finished")]
    assert tuple(helped_of(events)) == ("breakfast",)
    assert not list(broken_by(events))
    at = {e.data["goal"]: e.t for e in events if e.type == "prediction"}
    withdrawn = next(e.t for e in events if e.type == "withdrawn")
    assert at["lunch"] < withdrawn < at["breakfast"]  # by the second action that only the new goal explains


def test_time_never_runs_backwards_and_every_event_names_somebody():
    for events in (day("breakfast,drink,lunch", 1), day("lunch,breakfast", 1, True)):
        assert [e.t for e in events] == sorted(e.t for e in events)
        assert all(e.data["agent"] in ("human", "tiago") for e in events)


# --- what a day consists of --------------------------------------------------------------------------------------------


def test_goals_that_are_not_named_are_drawn_from_the_seed():
    rows = {tuple(goals_of_a_day(KITCHEN, ["drink"], 3, False, seed)) for seed in range(30)}
    assert len(rows) > 3
    assert all(row[0] == "drink" and len(row) == 3 for row in rows)
    assert goals_of_a_day(KITCHEN, [], None, False, 5) == [Trial(KITCHEN, TrialSettings(None, 5)).goal]


def test_a_change_of_mind_is_to_another_goal():
    for seed in range(20):
        first, second = goals_of_a_day(KITCHEN, [], None, True, seed)
        assert first != second


@pytest.mark.parametrize(
    ("wanted", "count", "changes", "said"),
    [
        (["tea"], None, False, "there is no goal 'tea': choose breakfast, drink, lunch"),
        ([], 0, False, "0 goals in a row are too few: it takes 1 or more"),
        ([], 1, True, "1 goals in a row are too few: it takes 2 or more"),
        (["drink", "lunch"], 1, False, "2 goals are asked for, so it takes as many in a row, not 1"),
        (["drink", "drink"], None, True, "a change of mind needs another goal: it is drink before and after"),
    ],
)
def test_a_day_that_makes_no_sense_is_refused(wanted, count, changes, said):
    with pytest.raises(DomainError) as mistake:
        goals_of_a_day(KITCHEN, wanted, count, changes, 0)
    assert mistake.value.sentence == said


def test_before_a_goal_what_it_is_about_is_put_back():
    simulation = Simulation(kitchen_scene(), seed=0)
    partner = Partner(KITCHEN, simulation, ["breakfast", "breakfast"])
    partner.begin()
    while not partner.waits:
        simulation.advance(0.5)
        partner.notice(simulation.time)
    assert "biscuits" not in simulation.truth().objects
    assert simulation.rests_in("plate", "sink")
    partner.begin()
    simulation.advance(0.5)
    now, first = simulation.truth().objects, kitchen_scene().things
    for thing in ("biscuits", "plate"):
        assert math.dist((now[thing].x, now[thing].y), (first[thing].x, first[thing].y)) < 0.01


def test_what_somebody_holds_is_not_put_back():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.human.do([put("plate", "sink")])
    while simulation.human.holding is None or simulation.rests_in("plate", "sink"):
        simulation.advance(0.5)
    simulation.advance(3.0)
    assert not simulation.put_back("plate")
    assert simulation.human.holding == "plate"


def test_a_partner_takes_back_what_the_robot_will_not_do_after_all():
    simulation = Simulation(kitchen_scene(), seed=0)
    partner = Partner(KITCHEN, simulation, ["breakfast"])
    partner.begin()
    simulation.advance(0.5)
    partner.heed(CLEARED)
    assert len(partner.now.left) == 2
    partner.take_back(())
    run_until_idle(simulation, each=lambda now: partner.notice(now.time))
    assert [step.skill for step in simulation.human.done if step.skill != "stand_aside"] == [s.step.skill for s in partner.now.script]
    assert simulation.rests_in("plate", "sink")


def test_somebody_without_a_body_in_the_scene_is_refused_with_the_line(tmp_path):
    for file in KITCHEN.folder.iterdir():
        (tmp_path / file.name).write_text(file.read_text())
    (tmp_path / "ontology.pl").open("a").write("human(ann).\nsetting(agents, partner, ann).\n")
    with pytest.raises(DomainError) as mistake:
        Trial(Domain.load(tmp_path), TrialSettings("drink"))
    assert "the partner ann has no body in the scene: state body(ann, person) instead of" in mistake.value.sentence
    assert "scene.pl:5" in str(mistake.value)


# --- a robot that is called back ---------------------------------------------------------------------------------------


def called_back(when, steps):
    """A robot that is called back from its steps at the first moment for which ``when`` holds."""
    simulation = Simulation(kitchen_scene(), seed=3)
    simulation.robot.do(steps)
    while not when(simulation):
        simulation.advance(0.1)
        assert simulation.time < 120
    simulation.robot.leave(steps)
    run_until_idle(simulation)
    return simulation


@pytest.mark.parametrize(
    "when",
    [
        lambda now: True,
        lambda now: now.time > 2.0,
        lambda now: now.robot.holding == "plate",
        lambda now: now.robot.holding == "plate" and math.dist(now.physics.position("plate")[:2], (-0.66, -1.15)) > 1.0,
    ],
    ids=["before it begins", "on the way", "when it has it", "when it carries it"],
)
def test_what_it_carries_is_brought_back_and_nothing_else_is_done(when):
    simulation = called_back(when, [put("plate", "sink"), use("plate", "sink")])
    first = kitchen_scene().thing("plate")
    x, y, z = simulation.physics.position("plate")
    assert math.dist((x, y), (first.x, first.y)) < 0.05 and abs(z - first.z) < 0.05
    assert simulation.robot.holding is None
    assert simulation.robot.done == [] and simulation.robot.failed == []


def test_what_it_washes_is_let_down_where_it_was():
    steps = [put("plate", "sink"), use("plate", "sink")]
    is_lifted = lambda now: now.robot.current == steps[1] and now.robot.holding and now.physics.speed("plate") > 0.03  # noqa: E731
    simulation = called_back(is_lifted, steps)
    assert simulation.robot.holding is None
    assert (simulation.robot.done, simulation.robot.failed, simulation.robot.queue.ended) == (steps[:1], [], steps[1:])
    assert simulation.rests_in("plate", "sink")


def test_after_it_was_called_back_it_can_be_asked_again():
    steps = [put("plate", "sink")]
    simulation = called_back(lambda now: now.robot.holding == "plate", steps)
    simulation.robot.do(steps)
    run_until_idle(simulation)
    assert simulation.robot.done == steps and simulation.rests_in("plate", "sink")


def test_what_is_withdrawn_while_the_robot_does_it_is_ended_and_told():
    trial = Trial(KITCHEN, TrialSettings("breakfast", 3))
    events, stopped = trial.events(), []
    for event in events:
        if event.type == "robot" and event.data["status"] == "asked":
            break
    while trial.simulation.robot.holding is None:
        trial.simulation.advance(0.5)
    list(trial.mind.supervisor.withdraw(trial.simulation.time, "a test"))
    stopped = [e.data for e in Helper.update(trial.helper, [trial.mind], trial.simulation.time)]
    assert [(row["action"], row["status"]) for row in stopped] == [("pick_and_place(plate, sink)", "stopped")]
    run_until_idle(trial.simulation)
    assert trial.simulation.robot.done == []
    assert not trial.simulation.rests_in("plate", "sink")
    assert trial.helper.asked == []


def test_scripts_are_those_of_the_plans():
    partner = Partner(KITCHEN, Simulation(kitchen_scene(), seed=0), ["lunch"])
    assert [s.step for s in partner.now.script] == SCRIPTS["lunch"]
