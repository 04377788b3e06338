import dataclasses
import math
import statistics

import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import kitchen_scene, put, run_until_idle

from casper.sim_adapter.eye.sensors import surface_distance
from casper.sim_adapter.simulation import Simulation


def kitchen(**sensor):
    """A simulation of the kitchen with some settings of the sensor changed."""
    scene = kitchen_scene()
    scene = dataclasses.replace(scene, sensor=dataclasses.replace(scene.sensor, **sensor))
    return Simulation(scene, seed=1, start=(0.6, -0.2, 0.0))


SHARP = {"noise": 0.0, "heading_noise": 0.0, "drop": 0.0, "hold_misread": 0.0}


@pytest.fixture(scope="module")
def watching():
    """The robot at its post, its eye on a human in the middle of the room, an exact sensor."""
    simulation = kitchen(**SHARP)
    simulation.advance(8.0)
    return simulation


def test_the_robot_has_found_the_human(watching):
    assert "human" in watching.observe().agents


def test_an_exact_sensor_shows_what_it_shows_as_it_is(watching):
    seen, true = watching.observe(), watching.truth()
    assert seen.objects
    assert all(seen.objects[name] == true.objects[name] for name in seen.objects)
    assert seen.agents == true.agents


def test_everything_in_the_field_of_view_is_within_half_of_it(watching):
    seen = watching.observe()
    robot = watching.robot
    looking = robot.pose[2] + watching.physics.joint("tiago:pan")
    for state in seen.objects.values():
        eye = watching.sensor.eye
        away = math.remainder(math.atan2(state.y - eye[1], state.x - eye[0]) - looking, 2 * math.pi)
        assert abs(away) <= math.radians(95 / 2) + 0.02


def test_what_is_behind_the_robot_is_absent(watching):
    assert "bottle" not in watching.observe().objects


def test_a_narrow_eye_sees_less():
    wide, narrow = kitchen(**SHARP), kitchen(**SHARP, field_of_view=20.0)
    wide.advance(8.0)
    narrow.advance(8.0)
    assert set(narrow.observe().objects) < set(wide.observe().objects)


def test_what_is_out_of_range_is_absent():
    simulation = kitchen(**SHARP, range=1.0)
    simulation.advance(8.0)
    assert simulation.observe().objects == {}


def test_the_meal_in_the_fridge_is_hidden_from_the_robots_start_by_the_corner():
    simulation = kitchen(**SHARP)
    eye = simulation.sensor.eye
    meal = simulation.physics.position("meal")
    assert not simulation.sensor.clear(eye, meal, None)


def test_the_robots_post_sees_the_meal_in_the_open_fridge(watching):
    assert watching.sensor.clear(watching.sensor.eye, watching.physics.position("meal"), None)


def test_a_plate_in_the_basin_is_not_hidden_by_the_sink_it_lies_in():
    simulation = kitchen(**SHARP)
    simulation.human.do([put("plate", "sink")])
    run_until_idle(simulation)
    simulation.advance(3.0)
    assert "plate" in simulation.observe().objects


def test_the_noise_has_the_spread_that_is_set(watching):
    simulation = kitchen(noise=0.01, drop=0.0)
    simulation.advance(8.0)
    true = simulation.truth()
    errors = []
    for _ in range(400):
        seen = simulation.observe()
        errors += [s.x - true.objects[n].x for n, s in seen.objects.items()]
        errors += [s.z - true.objects[n].z for n, s in seen.objects.items()]
    assert abs(statistics.fmean(errors)) < 0.001
    assert 0.009 < statistics.pstdev(errors) < 0.011


def test_the_heading_is_noisy_too():
    simulation = kitchen(heading_noise=2.0, drop=0.0)
    simulation.advance(8.0)
    true = simulation.human.heading
    errors = [math.degrees(simulation.observe().agents["human"].heading - true) for _ in range(400)]
    assert 1.7 < statistics.pstdev(errors) < 2.3


def test_detections_are_dropped_as_often_as_set():
    simulation = kitchen(drop=0.1)
    simulation.advance(8.0)
    visible = [name for name in simulation.physics.positions() if simulation.sensor.sees_thing(name)]
    worlds = [simulation.observe() for _ in range(600)]
    missing = sum(name not in world.objects for world in worlds for name in visible)
    assert 0.08 < missing / (600 * len(visible)) < 0.12


def test_the_robot_always_knows_itself():
    simulation = kitchen(drop=1.0)
    world = simulation.observe()
    assert set(world.agents) == {"tiago"} and world.objects == {}


def test_holding_is_seen_from_the_hand_at_the_object_and_free_from_a_hand_away_from_all():
    simulation = kitchen(noise=0.01, drop=0.0, hold_misread=0.0)
    simulation.human.do([put("biscuits", "plate")])
    read = {"walk": [], "transport": []}

    def look(now):
        world = now.observe()
        if now.human.movement in read and "human" in world.agents and "biscuits" in world.objects:
            read[now.human.movement].append(world.agents["human"].holding)

    run_until_idle(simulation, each=look)
    assert set(read["walk"]) == {None} and set(read["transport"]) == {"biscuits"}


def test_an_object_that_is_not_seen_is_not_seen_held():
    simulation = kitchen(drop=0.0, hold_misread=0.0)
    simulation.human.do([put("biscuits", "plate")])
    while simulation.human.holding is None:
        simulation.advance(0.1)
    simulation.sensor.sees_thing = lambda name: name != "biscuits"
    world = simulation.observe()
    assert "biscuits" not in world.objects
    assert "human" not in world.agents or world.agents["human"].holding is None


def test_holding_is_misread_as_often_as_set():
    simulation = kitchen(drop=0.0, hold_misread=0.2)
    simulation.advance(8.0)
    misread = sum(simulation.observe().agents["human"].holding is not None for _ in range(600))
    assert 0.16 < misread / 600 < 0.24


def test_the_distance_to_an_object_is_taken_from_its_surface():
    plate = kitchen_scene().thing("plate")
    spot = (0.0, 0.0, 0.0)
    assert surface_distance(plate, spot, (0.0, 0.0, 0.0)) == 0.0
    assert math.isclose(surface_distance(plate, spot, (plate.radius + 0.03, 0.0, 0.0)), 0.03)
    assert math.isclose(surface_distance(plate, spot, (0.0, 0.0, plate.height / 2 + 0.04)), 0.04)


def test_the_head_follows_the_human_within_its_limits():
    simulation = kitchen(**SHARP)
    simulation.human.do([put("meal", "hobs")])
    pans, seen = [], []

    def look(now):
        pans.append(now.physics.joint("tiago:pan"))
        seen.append("human" in now.observe().agents)

    run_until_idle(simulation, each=look)
    assert max(map(abs, pans)) <= math.radians(75.0) + 0.05
    assert sum(seen) / len(seen) > 0.9
