"""The smallest domain that runs, and what somebody else does in a plan."""

from pathlib import Path

import pytest

pytest.importorskip("mujoco")

from casper import Domain
from casper.engine.domain.domain import SHIPPED
from casper.sim_adapter.partners.partner import Partner
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.trial import Trial, TrialSettings


def lines(folder: Path):
    files = [file for file in folder.glob("*.pl") if file.name != "tests.pl"]
    return [line for file in files for line in file.read_text().splitlines() if line.strip()]


def test_the_minimal_domain_with_a_room_has_at_most_25_lines():
    assert len(lines(SHIPPED / "minimal")) <= 25


def test_and_it_runs():
    *_, last = Trial(Domain.load("minimal"), TrialSettings("tea", 1)).events()
    robot = last.data["robot"]
    assert last.data["correct"] and robot["actions"] == ["pick_and_place(cup, shelf)"] and robot["done"]


def test_somebody_else_is_asked_for_their_step_when_its_time_has_come(tmp_path):
    for file in ("actions.pl", "scene.pl"):
        (tmp_path / file).write_text((SHIPPED / "minimal" / file).read_text())
    (tmp_path / "ontology.pl").write_text((SHIPPED / "minimal" / "ontology.pl").read_text() + "human(bob).")
    (tmp_path / "plans.pl").write_text("tidy --> pick_and_place(book, shelf), by(bob, pick_and_place(cup, tray)).")
    domain = Domain.load(tmp_path)
    simulation = Simulation(scene_of(domain), seed=0)
    partner = Partner(domain, simulation, ["tidy"])
    partner.begin()
    bob = simulation.people["bob"]
    while not partner.finished or partner._rest:
        assert simulation.time < 60
        simulation.advance(0.5)
        partner.notice(simulation.time)
        assert bob.idle or [step.target for step in partner.human.done if step.target] == ["book"]
    assert [step.target for step in bob.done] == ["cup"] and simulation.rests_in("cup", "tray")


def test_a_step_that_only_the_robot_does_is_waited_for_and_the_plan_goes_on(tmp_path):
    for file in ("ontology.pl", "actions.pl", "scene.pl"):
        (tmp_path / file).write_text((SHIPPED / "minimal" / file).read_text())
    robots = "by(robot, pick_and_place(book, shelf))"
    (tmp_path / "plans.pl").write_text(
        f"tea --> pick_and_place(cup, tray), {robots}, drink(cup, tray), pick_and_place(cup, shelf)."
    )
    events = list(Trial(Domain.load(tmp_path), TrialSettings("tea", 1)).events())
    plans = [(event.data["waiting"], event.data["actions"]) for event in events if event.type == "plan"]
    assert plans[:2] == [([], ["pick_and_place(book, shelf)"]), (["drink(cup, tray)"], ["pick_and_place(cup, shelf)"])]
    assert events[-1].data["correct"] and events[-1].data["robot"]["done"]
    assert [event.data["outcome"] for event in events if event.type == "episode"] == ["finished"]
