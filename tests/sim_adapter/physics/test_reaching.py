"""Inverse kinematics of any arm: it ends where the primitive arm's plain geometry does, and turns the hand as asked."""

import math
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("mujoco")

import mujoco
import numpy as np
from simulated_kitchen import kitchen_scene

from casper.sim_adapter.physics.bodies.primitive import ARM, HOME, PRIMITIVE, arm_angles, best_lift
from casper.sim_adapter.physics.bodies.reaching import Reaching, attitude, rotation_between
from casper.sim_adapter.physics.model import build_model

angles = st.floats(-math.pi, math.pi)


@cache
def model():
    return build_model(kitchen_scene())


def reaching():
    return Reaching(model(), "tiago", ARM, arm_angles(HOME, best_lift(HOME[2])), tilt=0.0)


def fingertips(found, lift):
    """Where they are with these angles, the robot at the origin."""
    data = mujoco.MjData(model())
    data.joint("tiago:lift").qpos = lift
    for name, angle in zip(ARM, found):
        data.joint(f"tiago:{name}").qpos = angle
    mujoco.mj_kinematics(model(), data)
    return data.site("tiago:tool").xpos


@given(st.floats(0.42, 0.62), st.floats(0.75, 1.1))
def test_the_fingertips_come_where_the_plain_geometry_brings_them(x, z):
    lift = best_lift(z)
    if arm_angles((x, 0.0, z), lift) is None:
        return
    found = reaching()((x, 0.0, z), lift, 0.0)
    assert found is not None and math.dist(fingertips(found, lift), (x, 0.0, z)) < 0.002


def test_what_is_out_of_reach_is_not_found_and_leaves_the_arm_where_it_was():
    arm = reaching()
    before = arm.angles.copy()
    assert arm((3.0, 0.0, 1.0), 0.3, 0.0) is None
    assert (arm.angles == before).all()


def test_the_same_asked_again_is_where_the_arm_is_already():
    arm = reaching()
    assert arm(HOME, 0.35, 0.0) == arm(HOME, 0.35, 0.0)


def test_no_joint_leaves_its_limits():
    low, high = np.array([model().joint(f"tiago:{name}").range for name in ARM]).T
    for x in (0.3, 0.5, 0.9):
        arm = reaching()
        arm((x, 0.0, 0.9), 0.2, 0.0)
        assert (arm.angles >= low).all() and (arm.angles <= high).all()


@given(angles, st.floats(0.0, 1.2), angles)
def test_a_hands_axes_are_at_right_angles_and_its_fingers_tilted_as_asked(ahead, tilt, roll):
    axes = attitude(ahead, tilt, roll)
    assert np.allclose(axes.T @ axes, np.eye(3)) and np.isclose(np.linalg.det(axes), 1.0)
    assert math.isclose(axes[2, 0], -math.cos(tilt), abs_tol=1e-9)


@given(angles, angles, st.floats(0.0, 1.2))
def test_a_rotation_takes_one_attitude_to_the_other(ahead, roll, tilt):
    one, other = attitude(ahead, tilt, roll), attitude(0.0, 0.0, 0.0)
    turn = rotation_between(one, other)
    quat, matrix = np.empty(4), np.empty(9)
    mujoco.mju_axisAngle2Quat(quat, turn / (np.linalg.norm(turn) or 1.0), float(np.linalg.norm(turn)))
    mujoco.mju_quat2Mat(matrix, quat)
    assert np.allclose(matrix.reshape(3, 3) @ one, other, atol=1e-6)


def test_the_primitive_arm_reaches_by_plain_geometry():
    assert PRIMITIVE.reach(model(), "tiago") is arm_angles
