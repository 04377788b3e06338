"""The robot that is held up: whom it keeps in view, who lets it through, how it stops, what it makes of a miss."""

import math

import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import kitchen_scene, put, use

from casper.sim_adapter.physics.bodies.primitive import HOME
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step

AT_THE_SINK = (-1.0, 0.76)


def held_up(start, *, busy):
    """A plate to be washed, and somebody who stands where one washes it."""
    simulation = Simulation(kitchen_scene(), seed=0, start=start)
    x, y, _ = simulation.physics.position("sink")
    simulation.physics._move("plate", (x, y, 0.83, 1.0, 0.0, 0.0, 0.0))
    simulation.advance(0.5)
    if busy:
        simulation.human.queue.current = Step("still")
        simulation.human._skill = iter(lambda: None, 1)
    simulation.robot.do([use("plate", "sink")])
    return simulation


def test_who_stands_aside_where_the_robot_must_stand_goes_further_away():
    simulation = held_up((-1.0, 0.22), busy=False)
    simulation.advance(50.0)
    assert simulation.robot.done == [use("plate", "sink")]


def test_while_it_waits_for_a_way_it_keeps_its_partner_in_view():
    simulation = held_up(AT_THE_SINK, busy=True)
    simulation.advance(0.1)
    base, seen = simulation.robot.base, 0
    base.aim_yaw = base.pose[2] + math.pi
    simulation.physics.set_joint("tiago:yaw", base.aim_yaw)
    for _ in range(30):
        simulation.advance(1.0)
        seen += simulation.sensor.sees_person(simulation.human.place)
    assert simulation.robot.current is not None and seen >= 25


def test_a_base_that_stops_stays_where_it_comes_to_rest_and_does_not_swing_back():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    base, wanted = simulation.robot.base, simulation.robot.base.aim_yaw + 3.0

    def turned():
        base.update()
        simulation.physics.step()
        return simulation.physics.joint("tiago:yaw")

    for _ in range(60):
        base.turn_to(wanted)
        turned()
    list(base.stop())
    headings = [turned() for _ in range(100)]
    assert max(headings) - headings[-1] < 0.002


def test_an_arm_that_was_sent_out_of_reach_is_folded_all_the_same():
    simulation = Simulation(kitchen_scene(), seed=0, start=(1.0, 0.0))
    robot = simulation.robot
    robot.arm.tool = (0.75, 0.5, 1.18)
    simulation.advance(0.5)
    assert not robot.arm.reachable
    robot.queue.current, robot._skill = put("glass", "sink"), robot.hand.back_off("glass")
    simulation.advance(8.0)
    assert robot.failed == [] and math.dist(robot.arm.tool, HOME) < 0.01
