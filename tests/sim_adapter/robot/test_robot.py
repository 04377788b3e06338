import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("mujoco")

from simulated_kitchen import SCRIPTS, kitchen_scene, put, run_until_idle, use

from casper.kb.errors import DomainError
from casper.sim_adapter.physics.bodies.primitive import FORE, SHOULDER_X, SHOULDER_Z, TOOL, UPPER, arm_angles
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step


@pytest.fixture(scope="module")
def breakfast():
    """The human eats, leaves the dishes to the robot, and every half second is noted."""
    simulation = Simulation(kitchen_scene(), seed=3)
    steps = SCRIPTS["breakfast"]
    simulation.human.do(steps)
    simulation.advance(0.5)
    simulation.human.leave(steps[2:])
    while steps[1] not in simulation.human.done:
        simulation.advance(0.5)
    simulation.robot.do(steps[2:])
    truths = []
    run_until_idle(simulation, each=lambda now: truths.append((now.truth(), now.robot.current)))
    return simulation, truths


def test_the_robot_carries_the_plate_to_the_sink_and_washes_it(breakfast):
    simulation, _ = breakfast
    assert simulation.robot.done == SCRIPTS["breakfast"][2:] and simulation.robot.failed == []


def test_the_washed_plate_rests_in_the_basin(breakfast):
    simulation, _ = breakfast
    assert simulation.rests_in("plate", "sink")
    assert simulation.physics.position("plate")[2] < kitchen_scene().thing("sink").z


def test_the_plate_moves_only_while_somebody_holds_it(breakfast):
    _, truths = breakfast
    for (before, _), (after, _) in pairwise(truths):
        moved = math.dist(_spot(before, "plate"), _spot(after, "plate"))
        if before.agents["tiago"].holding is None and after.agents["tiago"].holding is None:
            assert moved < 0.02


def test_what_the_robot_holds_is_at_its_gripper(breakfast):
    simulation = Simulation(kitchen_scene(), seed=3, start=(1.0, 0.0))
    simulation.robot.do([put("bottle", "glass")])
    gaps = []

    def look(now):
        if now.robot.holding is not None:
            gaps.append(math.dist(now.physics.site("tiago:tool"), now.physics.position("bottle")))

    run_until_idle(simulation, each=look)
    assert simulation.rests_in("bottle", "glass")
    assert gaps and max(gaps) < 0.1


def test_washing_moves_the_plate_to_and_fro(breakfast):
    _, truths = breakfast
    washing = [_spot(world, "plate") for world, step in truths if step == use("plate", "sink")]
    assert max(x for x, *_ in washing) - min(x for x, *_ in washing) > 0.03


def test_the_robot_keeps_away_from_the_human(breakfast):
    _, truths = breakfast
    for world, _ in truths:
        human, robot = world.agents["human"], world.agents["tiago"]
        assert math.dist((human.x, human.y), (robot.x, robot.y)) > 0.45


def test_the_robot_keeps_to_the_floor(breakfast):
    simulation, truths = breakfast
    ways = simulation.robot.base.navigator
    for world, _ in truths:
        robot = world.agents["tiago"]
        assert ways.floor.clearance((robot.x, robot.y)) > ways.radius - 0.03


def test_the_gripper_gives_no_warning_of_the_solver(breakfast):
    simulation, _ = breakfast
    assert simulation.physics.warnings == 0


def test_what_is_already_at_its_place_is_done_at_once():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.human.do([put("glass", "sink")])
    run_until_idle(simulation)
    before = simulation.time
    simulation.robot.do([put("glass", "sink")])
    simulation.advance(0.1)
    assert simulation.robot.done == [put("glass", "sink")] and simulation.time - before < 0.2


def test_using_what_is_elsewhere_fails_and_takes_the_later_steps_with_it():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.robot.do([use("plate", "sink"), put("glass", "sink")])
    simulation.advance(0.5)
    assert [reason for _, reason in simulation.robot.failed] == [
        "plate is not at sink",
        "use(plate, sink) comes before it: plate is not at sink",
    ]
    assert simulation.robot.idle


def test_the_robot_waits_for_what_it_is_to_use_while_the_human_has_a_hand_on_it():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.physics.grasp("human", "plate")
    simulation.robot.do([use("plate", "sink")])
    simulation.advance(2.0)
    assert simulation.robot.failed == [] and simulation.robot.current == use("plate", "sink")
    simulation.physics.release("human")
    simulation.advance(0.1)
    assert simulation.robot.failed == [(use("plate", "sink"), "plate is not at sink")]


def test_something_the_human_keeps_in_the_hand_is_given_up_after_a_while():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.physics.grasp("human", "plate")
    simulation.robot.do([put("plate", "sink")])
    simulation.advance(kitchen_scene().robot_settings.patience + 1.0)
    assert simulation.robot.failed[0][1] == "human keeps holding plate"


@pytest.mark.parametrize("step", [Step("stand_aside"), put("sink", "plate"), put("plate", "meal")])
def test_what_the_robot_has_no_skill_for_is_refused(step):
    with pytest.raises(DomainError):
        Simulation(kitchen_scene(), seed=0).robot.do([step])


@given(st.floats(0.2, 0.7), st.floats(-0.4, 0.4), st.floats(0.6, 1.2), st.floats(0.0, 0.35))
def test_the_arms_angles_bring_the_fingertips_where_they_are_wanted(x, y, z, lift):
    angles = arm_angles((x, y, z), lift)
    if angles is None:
        return
    yaw, raised, bent, wrist, _ = angles
    assert math.isclose(raised + bent + wrist, math.pi / 2)
    out = UPPER * math.cos(raised) + FORE * math.cos(raised + bent)
    up = SHOULDER_Z + lift - UPPER * math.sin(raised) - FORE * math.sin(raised + bent)
    tip = (SHOULDER_X + out * math.cos(yaw), out * math.sin(yaw), up - TOOL)
    assert math.dist(tip, (x, y, z)) < 1e-9


def _spot(world, name):
    state = world.objects[name]
    return state.x, state.y, state.z
