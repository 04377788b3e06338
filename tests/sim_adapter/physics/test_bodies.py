"""The robot's bodies: each has what the rest of the robot asks for, and one that is missing is told of in a sentence."""

import math
from dataclasses import replace

import pytest

pytest.importorskip("mujoco")

from simulated_kitchen import kitchen_scene

from casper.kb.errors import CasperError, DomainError
from casper.sim_adapter.physics.bodies import package
from casper.sim_adapter.physics.bodies.table import BODIES, body_of
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.robot.arm import RobotArm
from casper.sim_adapter.trial import TrialSettings


def is_missing(name):
    try:
        body_of(name)
    except CasperError:
        return True
    return False


NAMES = [
    pytest.param(name, marks=pytest.mark.skipif(is_missing(name), reason=f"the model of {name} is not installed"))
    for name in BODIES
]


@pytest.fixture(scope="module", params=NAMES)
def standing(request):
    """A body in the kitchen, its arm at rest."""
    physics = Physics(replace(kitchen_scene(), body=request.param))
    RobotArm(physics, "tiago").settle()
    physics.refresh()
    return physics


def test_the_robot_is_made_of_primitives_unless_another_body_is_asked_for():
    assert kitchen_scene().body == TrialSettings().body == "primitive"


def test_a_body_that_there_is_not_is_refused_with_those_there_are():
    with pytest.raises(DomainError, match="no body pr2; there are primitive, tiago"):
        body_of("pr2")


def test_a_model_that_is_not_installed_is_told_of_with_what_to_type(monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda name: None)
    with pytest.raises(CasperError, match="robosuite, which is not installed: pip install --no-deps 'robosuite"):
        body_of("tiago")


def test_a_package_without_the_model_is_told_of_with_its_folder(monkeypatch, tmp_path):
    found = type("Found", (), {"submodule_search_locations": [str(tmp_path)]})
    monkeypatch.setattr(package, "find_spec", lambda name: found)
    with pytest.raises(CasperError, match=f"no TIAGo in {tmp_path}"):
        body_of("tiago")


def test_a_body_has_the_joints_and_servos_that_the_robot_moves(standing):
    names = ("x", "y", "yaw", "lift", "pan", "tilt", "inner_finger", "outer_finger", *standing.body.arm)
    for name in names:
        standing.servo(f"tiago:{name}", standing.joint(f"tiago:{name}"))


def test_at_rest_the_fingertips_are_at_home(standing):
    assert math.dist(standing.site("tiago:tool"), standing.body.home) < 0.002


def test_the_eye_is_as_high_as_the_body_says_and_looks_ahead(standing):
    assert math.isclose(standing.site("tiago:eye")[2], standing.body.eye_height, abs_tol=0.002)
    assert abs(standing.looking("tiago:eye")) < 1e-6


def test_positive_tilt_looks_down(standing):
    before = standing.data.site("tiago:eye").xmat.reshape(3, 3)[2, 0]
    standing.set_joint("tiago:tilt", 0.5)
    standing.refresh()
    assert standing.data.site("tiago:eye").xmat.reshape(3, 3)[2, 0] < before - 0.3
    standing.set_joint("tiago:tilt", 0.0)


def test_closed_fingers_meet_and_open_ones_are_apart_by_the_opening(standing):
    def gap():
        standing.refresh()
        inner, outer = (standing.data.geom_xpos[_tip(standing, side)] for side in ("inner", "outer"))
        thick = standing.model.geom_size[_tip(standing, "inner")][2]
        return math.dist(inner, outer) - 2 * thick

    assert math.isclose(gap(), 2 * standing.body.opening, abs_tol=1e-6)
    for side in ("inner", "outer"):
        standing.set_joint(f"tiago:{side}_finger", standing.body.opening)
    assert abs(gap()) < 1e-6
    for side in ("inner", "outer"):
        standing.set_joint(f"tiago:{side}_finger", 0.0)


def _tip(physics, side):
    """The finger's geom that touches."""
    of = physics.body_id(f"tiago:{side}_finger")
    return next(g for g in range(physics.model.ngeom) if physics.model.geom_bodyid[g] == of and physics.model.geom_contype[g])
