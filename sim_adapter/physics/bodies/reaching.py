"""Inverse kinematics of any arm: damped least squares on MuJoCo's Jacobian, from where the arm was last.

What is asked for changes little from one control step to the next, so a few rounds do, and the arm never jumps from one
posture to another. What freedom is left draws it to a posture of rest.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from casper.sim_adapter.room.placement import Spot

Vector = NDArray[np.float64]
ROUNDS = 25
NEAR, TURNED = 1e-3, 0.01  # metres and radians within which the fingertips are where they are wanted
TURNING = 0.3  # metres that a radian counts as
DAMPING = 1e-4
TO_REST = 0.05  # share of the way to the posture of rest, a round
FASTEST = 0.3  # radians of a joint, a round


class Reaching:
    """Called as `sim_adapter.physics.bodies.body.Reach` says.

    Args:
        model: compiled MuJoCo model, with the names that `body` lists.
        robot: whose arm.
        arm: its joints, without the robot's name.
        rest: the posture of rest, radians, in which it begins.
        tilt: radians between the way the fingers point and straight down, outwards.
    """

    def __init__(self, model: Any, robot: str, arm: Sequence[str], rest: Sequence[float], tilt: float):
        self.model, self.tilt = model, tilt
        self.data = mujoco.MjData(model)  # of its own: the robot stands at the origin of it
        joints = [model.joint(f"{robot}:{name}") for name in arm]
        self._at = np.array([int(joint.qposadr[0]) for joint in joints])
        self._dof = np.array([int(joint.dofadr[0]) for joint in joints])
        self._least, self._most = np.array([joint.range for joint in joints]).T
        self._lift = int(model.joint(f"{robot}:lift").qposadr[0])
        self._tool = int(model.site(f"{robot}:tool").id)
        self._jacobian = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        self.rest = np.array(rest)
        self._pull = np.array([*[TO_REST] * (len(rest) - 1), 0.0])  # the last joint is as the hand is rolled
        self.angles = self.rest.copy()

    def __call__(self, tool: Spot, lift: float, roll: float) -> list[float] | None:
        """Angles, radians; None, and the arm stays where it was, where they are not found."""
        wanted = attitude(math.atan2(tool[1], tool[0]), self.tilt, roll)
        self.data.qpos[self._lift] = lift
        angles = self.angles
        for _ in range(ROUNDS):
            off, turned = self._error(angles, np.array(tool), wanted)
            if np.linalg.norm(off) < NEAR and np.linalg.norm(turned) < TURNED:
                self.angles = angles
                return [float(angle) for angle in angles]
            angles = self._nearer(angles, np.concatenate([off, TURNING * turned]))
        return None

    def _error(self, angles: Vector, tool: Vector, wanted: Vector) -> tuple[Vector, Vector]:
        """How far the fingertips are from where they are wanted, and how they must be turned, as a vector."""
        self.data.qpos[self._at] = angles
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        now = self.data.site_xmat[self._tool].reshape(3, 3)
        return tool - self.data.site_xpos[self._tool], rotation_between(now, wanted)

    def _nearer(self, angles: Vector, error: Vector) -> Vector:
        """One round: all joints at once, within their limits."""
        mujoco.mj_jacSite(self.model, self.data, *self._jacobian, self._tool)
        way, turn = self._jacobian
        jacobian = np.vstack([way[:, self._dof], TURNING * turn[:, self._dof]])
        inverse = jacobian.T @ np.linalg.inv(jacobian @ jacobian.T + DAMPING * np.eye(6))
        free = np.eye(len(angles)) - inverse @ jacobian
        change = inverse @ error + free @ (self._pull * (self.rest - angles))
        nearer: Vector = np.clip(angles + np.clip(change, -FASTEST, FASTEST), self._least, self._most)
        return nearer


def attitude(ahead: float, tilt: float, roll: float) -> Vector:
    """The hand's axes as columns: x the way the fingers point, z the way in which they open.

    Args:
        ahead: the direction in which the arm stretches, radians on the floor plan.
        tilt: of the fingers from straight down, outwards.
        roll: about the fingers; at 0 they open in the vertical plane of the arm.
    """
    out = np.array([math.cos(ahead), math.sin(ahead), 0.0])
    up = np.array([0.0, 0.0, 1.0])
    points = math.sin(tilt) * out - math.cos(tilt) * up
    opens = math.cos(tilt) * out + math.sin(tilt) * up
    opens = math.cos(roll) * opens + math.sin(roll) * np.cross(points, opens)
    return np.stack([points, np.cross(opens, points), opens], axis=1)


def rotation_between(now: Vector, wanted: Vector) -> Vector:
    """The rotation that takes one orientation to another: its axis, as long as its angle in radians."""
    turn, quat = np.empty(3), np.empty(4)
    mujoco.mju_mat2Quat(quat, (wanted @ now.T).ravel())
    mujoco.mju_quat2Vel(turn, quat, 1.0)
    return turn
