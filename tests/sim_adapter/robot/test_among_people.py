"""The robot among people: how near it comes, whom it waits for, what it does when the world changes, why it gives up."""

import math

import pytest

pytest.importorskip("mujoco")

from hypothesis import given
from hypothesis import strategies as st
from simulated_kitchen import kitchen_scene, put, use

from casper.sim_adapter.robot.space import Space
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step

SETTINGS = kitchen_scene().robot_settings


def advance_until(simulation, condition, longest=60.0):
    since = simulation.time
    while not condition():
        assert simulation.time - since < longest
        simulation.advance(0.1)


def move(simulation, thing, x, y, z):
    """As somebody might have done."""
    simulation.physics._move(thing, (x, y, z, 1.0, 0.0, 0.0, 0.0))


@pytest.fixture(scope="module")
def space():
    return Space(Simulation(kitchen_scene(), seed=0).physics)


@given(st.floats(-1.0, 3.0), st.floats(-1.0, 3.0))
def test_the_nearer_somebody_is_the_slower_and_within_the_limit_it_stands(space, one, other):
    near, far = sorted((one, other))
    assert space._pace(near) <= space._pace(far)
    assert (space._pace(near) == 0.0) == (near <= SETTINGS.stop_distance)
    assert space._pace(near) == 1.0 or near < SETTINGS.slow_distance


def test_a_robot_with_somebody_at_its_side_stands_until_they_have_gone():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    simulation.robot.do([put("plate", "sink")])
    simulation.advance(1.0)
    x, y, _ = simulation.robot.pose
    body = simulation.human.body
    body.x, body.y = x + 0.5, y
    body.show(at_once=True)
    simulation.human.queue.current = Step("still")  # busy, so that nobody is sent away
    simulation.human._skill = iter(lambda: None, 1)
    simulation.advance(1.0)
    stood = simulation.robot.pose
    simulation.advance(2.0)
    assert math.dist(stood[:2], simulation.robot.pose[:2]) < 0.01
    body.x = 1.0
    body.show(at_once=True)
    simulation.advance(2.0)
    assert math.dist(stood[:2], simulation.robot.pose[:2]) > 0.1


def test_what_was_moved_while_the_robot_drove_there_is_fetched_where_it_is():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    simulation.robot.do([put("plate", "sink")])
    simulation.advance(2.0)
    x, y, z = simulation.physics.position("plate")
    move(simulation, "plate", x + 0.25, y, z)
    advance_until(simulation, lambda: simulation.robot.holding == "plate")
    assert simulation.robot.failed == []


def test_what_somebody_has_brought_to_its_place_is_found_done():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    simulation.robot.do([put("glass", "sink")])
    simulation.advance(1.0)
    x, y, _ = simulation.physics.position("sink")
    move(simulation, "glass", x, y, 0.87 - 0.07 + 0.03)
    advance_until(simulation, lambda: simulation.robot.idle, 10.0)
    assert simulation.robot.done == [put("glass", "sink")] and simulation.robot.queue.found == {0}


def test_a_hand_at_what_it_needs_is_waited_for():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    skills = simulation.robot.skills
    assert skills._whose_hand_at("plate") is None
    simulation.physics.guided.aim("human:hand", simulation.physics.position("plate"), 0.0, at_once=True)
    simulation.physics.refresh()
    assert skills._whose_hand_at("plate") == "human"


def test_a_step_that_fails_says_why_and_so_does_every_one_after_it():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.robot.do([use("plate", "sink"), put("glass", "sink"), use("glass", "sink")])
    simulation.advance(0.5)
    reasons = [reason for _, reason in simulation.robot.failed]
    assert len(reasons) == 3 and all("plate is not at sink" in reason for reason in reasons)


def test_after_a_failure_what_it_holds_is_put_back_before_that_is_told():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    before = simulation.physics.position("plate")
    simulation.robot.do([put("plate", "sink")])
    advance_until(simulation, lambda: simulation.robot.holding == "plate")
    simulation.advance(2.0)
    simulation.robot._give_up("the sink is on fire")
    assert simulation.robot.failed == []
    advance_until(simulation, lambda: simulation.robot.failed, 90.0)
    assert simulation.robot.failed == [(put("plate", "sink"), "the sink is on fire")]
    assert simulation.robot.holding is None and math.dist(simulation.physics.position("plate"), before) < 0.1
