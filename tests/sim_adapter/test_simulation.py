import dataclasses

import pytest

pytest.importorskip("mujoco")

import mujoco
from simulated_kitchen import SCRIPTS, kitchen_scene, put, run_until_idle

from casper.engine.perception.world import world_state_from_json, world_state_to_json
from casper.kb.errors import DomainError
from casper.sim_adapter.physics.model import build_model, build_spec
from casper.sim_adapter.physics.stability import PhysicsFailed
from casper.sim_adapter.simulation import Simulation


def states(seed, seconds=15.0):
    simulation = Simulation(kitchen_scene(), seed=seed)
    simulation.human.do(SCRIPTS["lunch"])
    simulation.robot.do([put("glass", "sink")])
    seen = []
    while simulation.time < seconds:
        simulation.advance(0.5)
        seen.append((simulation.observe(), simulation.truth(), simulation.human.movement))
    return seen


def test_the_scene_compiles_from_primitives_only():
    model = build_model(kitchen_scene())
    assert model.nmesh == 0 and model.nhfield == 0 and model.nskin == 0


def test_the_specification_can_be_edited_before_it_is_compiled():
    spec = build_spec(kitchen_scene())
    spec.worldbody.add_body(name="vase").add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0])
    assert spec.compile().body("vase").id > 0


def test_left_alone_everything_stays_where_it_was_put():
    simulation = Simulation(kitchen_scene(), seed=0)
    before = simulation.truth().objects
    simulation.advance(5.0)
    for name, state in simulation.truth().objects.items():
        assert abs(state.x - before[name].x) + abs(state.y - before[name].y) < 0.002
        assert abs(state.z - before[name].z) < 0.002


def test_the_same_seed_gives_the_same_states():
    assert states(4) == states(4)


def test_another_seed_gives_other_states():
    assert states(4, seconds=2.0) != states(5, seconds=2.0)


def test_time_advances_by_what_was_asked_for():
    simulation = Simulation(kitchen_scene(), seed=0)
    for _ in range(3):
        simulation.advance(0.5)
    assert simulation.observe().t == 1.5


def test_a_world_state_survives_its_json():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.advance(3.0)
    world = simulation.observe()
    assert world_state_from_json(world_state_to_json(world)) == world


def test_what_was_removed_is_absent_from_then_on():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.remove("meal")
    simulation.advance(1.0)
    assert "meal" not in simulation.truth().objects
    assert "meal" not in simulation.observe().objects
    assert not simulation.rests_in("meal", "plate")


def test_what_is_fixed_cannot_be_removed():
    with pytest.raises(DomainError, match="fixed"):
        Simulation(kitchen_scene(), seed=0).remove("sink")


def test_something_eaten_up_frees_the_hand_that_held_it():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.physics.grasp("human", "biscuits")
    simulation.remove("biscuits")
    assert simulation.human.holding is None


def test_food_left_on_the_plate_goes_with_it_into_the_sink():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.human.do([put("meal", "plate"), put("plate", "sink")])
    run_until_idle(simulation)
    assert simulation.rests_in("plate", "sink")
    assert simulation.rests_in("meal", "plate")


def test_a_vessel_in_somebodys_hand_does_not_rest():
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.human.do([put("plate", "sink")])
    run_until_idle(simulation)
    assert simulation.rests_in("plate", "sink")
    simulation.physics.grasp("human", "plate")
    assert not simulation.rests_in("plate", "sink")


def test_human_and_robot_work_side_by_side_without_blocking_each_other():
    simulation = Simulation(kitchen_scene(), seed=7)
    simulation.human.do([put("biscuits", "plate"), put("bottle", "glass")])
    simulation.robot.do([put("meal", "hobs"), put("meal", "plate")])
    run_until_idle(simulation)
    assert simulation.robot.failed == [] and simulation.human.failed == []
    assert simulation.rests_in("bottle", "glass") and simulation.rests_in("meal", "plate")


def test_a_finer_timestep_is_stable_too():
    scene = kitchen_scene()
    fine = dataclasses.replace(scene, sim=dataclasses.replace(scene.sim, timestep=0.005))
    simulation = Simulation(fine, seed=1)
    simulation.human.do(SCRIPTS["breakfast"])
    run_until_idle(simulation)
    assert simulation.rests_in("plate", "sink") and simulation.physics.warnings == 0


# --- physics that runs away ---------------------------------------------------------------------------------------------


def test_two_hands_never_hold_the_same_thing():
    physics = Simulation(kitchen_scene(), seed=0).physics
    assert physics.grasp("human", "plate")
    assert not physics.grasp("tiago", "plate")
    assert physics.holder("plate") == "human"


def test_who_takes_the_food_from_a_carried_plate_has_it_alone():
    physics = Simulation(kitchen_scene(), seed=0).physics
    x, y, z = physics.position("plate")
    physics._move("meal", (x, y, z + 0.03, 1.0, 0.0, 0.0, 0.0))
    assert physics.contents("plate") == ["meal"]
    physics.grasp("human", "plate")
    physics.grasp("tiago", "meal")
    assert [physics.model.equality(i).name for i in physics.data.eq_active.nonzero()[0]] == ["human:hold:plate", "tiago:hold:meal"]


def test_food_that_is_eaten_up_while_its_plate_is_carried_does_not_tear_the_physics_apart():
    simulation = Simulation(kitchen_scene(), seed=0)
    physics = simulation.physics
    x, y, z = physics.position("plate")
    physics._move("meal", (x, y, z + 0.03, 1.0, 0.0, 0.0, 0.0))
    physics.grasp("human", "plate")
    simulation.remove("meal")
    assert [physics.model.equality(i).name for i in physics.data.eq_active.nonzero()[0]] == ["human:hold:plate"]
    simulation.advance(0.5)
    assert physics.warnings == 0


def test_a_plate_is_taken_without_the_food_that_another_hand_holds():
    physics = Simulation(kitchen_scene(), seed=0).physics
    x, y, z = physics.position("plate")
    physics._move("meal", (x, y, z + 0.03, 1.0, 0.0, 0.0, 0.0))
    physics.grasp("human", "meal")
    physics.grasp("tiago", "plate")
    assert [physics.model.equality(i).name for i in physics.data.eq_active.nonzero()[0]] == ["human:hold:meal", "tiago:hold:plate"]


@pytest.mark.parametrize("speed", [float("nan"), 1e12, 500.0])
def test_numbers_that_run_away_end_the_simulation_with_a_sentence_and_no_file(speed, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    simulation = Simulation(kitchen_scene(), seed=0)
    simulation.advance(0.5)
    physics = simulation.physics
    physics.data.qvel[physics._dof["plate"]] = speed
    with pytest.raises(PhysicsFailed, match=r"the simulated physics became unstable after 0.5 s at plate, .*timestep"):
        simulation.advance(0.1)
    assert list(tmp_path.iterdir()) == []


def test_a_handler_of_mujocos_warnings_that_somebody_has_set_stays():
    before, told = mujoco.get_mju_user_warning(), []
    try:
        mujoco.set_mju_user_warning(told.append)
        Simulation(kitchen_scene(), seed=0)
        assert mujoco.get_mju_user_warning() == told.append
    finally:
        mujoco.set_mju_user_warning(before)
