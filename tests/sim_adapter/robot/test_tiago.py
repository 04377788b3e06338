"""TIAGo++ itself does what the primitive body does."""

import math
from dataclasses import replace
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("mujoco")

from simulated_kitchen import kitchen_scene, put, run_until_idle, use

from casper import Domain
from casper.kb.errors import CasperError
from casper.sim_adapter.physics.bodies.package import model_file
from casper.sim_adapter.physics.bodies.tiago import TIAGO
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.trial import Trial, TrialSettings

try:
    MISSING = not model_file()
except CasperError as reason:
    MISSING, WHY = True, str(reason)
else:
    WHY = ""
pytestmark = pytest.mark.skipif(MISSING, reason=WHY)


@cache
def scene():
    return replace(kitchen_scene(), body="tiago")


def doing(*steps):
    """The robot alone in the kitchen, done with some steps."""
    simulation = Simulation(scene(), seed=3, start=(1.0, 0.0))
    simulation.robot.do(steps)
    return run_until_idle(simulation)


def test_it_carries_the_plate_to_the_sink_and_washes_it():
    steps = put("plate", "sink"), use("plate", "sink")
    simulation = doing(*steps)
    assert simulation.robot.done == [*steps] and simulation.rests_in("plate", "sink")
    assert simulation.physics.warnings == 0


@pytest.mark.parametrize(
    ("thing", "place"), [("bottle", "glass"), ("meal", "hobs"), ("biscuits", "plate"), ("glass", "sink")]
)
def test_it_brings_things_of_every_shape_to_their_places(thing, place):
    simulation = doing(put(thing, place))
    assert simulation.robot.failed == [] and simulation.rests_in(thing, place)


def test_what_it_holds_is_at_its_gripper():
    simulation, gaps = Simulation(scene(), seed=3, start=(1.0, 0.0)), []
    simulation.robot.do([put("bottle", "glass")])

    def look(now):
        if now.robot.holding is not None:
            gaps.append(math.dist(now.physics.site("tiago:tool"), now.physics.position("bottle")))

    run_until_idle(simulation, each=look)
    assert gaps and max(gaps) < 0.1


@pytest.mark.parametrize("goal", ["breakfast", "drink", "lunch"])
def test_its_trials_end_as_those_of_the_primitive_body(goal):
    kitchen = Domain.load("kitchen")
    ends = [
        list(Trial(kitchen, TrialSettings(goal=goal, seed=1, body=body)).events())[-1].data
        for body in ("primitive", "tiago")
    ]
    same = ("predicted", "correct", "prediction_time", "observed", "missed", "waiting", "planned")
    assert [ends[0][what] for what in same] == [ends[1][what] for what in same]
    assert all(end["robot"]["done"] for end in ends)


@settings(max_examples=20)
@given(st.floats(0.44, 0.66), st.floats(-0.1, 0.1), st.floats(0.66, 1.05), st.sampled_from([0.0, TIAGO.roll]))
def test_on_a_way_from_home_its_arm_gets_to_what_lies_before_it(x, y, z, roll):
    reach, home = TIAGO.reach(model(), "tiago"), TIAGO.home
    for step in range(41):
        share = step / 40
        at = tuple(a + share * (b - a) for a, b in zip(home, (x, y, z)))
        found = reach(at, TIAGO.best_lift(at[2]), min(1.0, 2 * share) * roll)
    assert found is not None


@cache
def model():
    return Physics(scene()).model
