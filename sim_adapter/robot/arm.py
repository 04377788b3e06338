"""The robot's arm: inverse kinematics with the gripper pointing down, the torso's lift, and the fingers."""

from __future__ import annotations

import math

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.physics.robot import ARM, FORE, LIFT_RANGE, OPEN, SHOULDER_X, SHOULDER_Z, TOOL, UPPER
from casper.sim_adapter.room.placement import Spot

HOME: Spot = (0.42, 0.0, 1.18)  # the fingertips while nothing is to be done, base frame
LIFT_SPEED = 0.15
ABOVE = 0.17  # the shoulder works best this far above the wrist


def arm_angles(tool: Spot, lift: float, roll: float = 0.0) -> tuple[float, float, float, float, float] | None:
    """Joint angles that bring the fingertips, pointing down, to a point of the base frame; None: out of reach.

    Two links in the vertical plane of the arm, elbow up, the wrist making the hand vertical.
    """
    dx, dy, rise = tool[0] - SHOULDER_X, tool[1], tool[2] + TOOL - SHOULDER_Z - lift
    out = math.hypot(dx, dy)
    far = math.hypot(out, rise)
    if not abs(UPPER - FORE) + 0.08 < far < UPPER + FORE - 0.003:
        return None
    at_shoulder = math.acos((UPPER**2 + far**2 - FORE**2) / (2 * UPPER * far))
    at_elbow = math.acos((UPPER**2 + FORE**2 - far**2) / (2 * UPPER * FORE))
    raised = -(math.atan2(rise, out) + at_shoulder)
    bent = math.pi - at_elbow
    return math.atan2(dy, dx), raised, bent, math.pi / 2 - raised - bent, roll


class RobotArm:
    """Keeps the fingertips at ``tool`` (base frame), the lift and the fingers where they are wanted."""

    def __init__(self, physics: Physics, name: str) -> None:
        self.physics = physics
        self.name = name
        self.tool: Spot = HOME
        self.roll = 0.0
        self.lift = best_lift(HOME[2])
        self.finger = 0.0
        self.reachable = True
        self._now = physics.joint(f"{name}:lift")
        self._dt = physics.scene.sim.control

    def settle(self) -> None:
        """Put every joint where it is wanted at once (only for the start)."""
        self._now = self.lift
        self.physics.set_joint(f"{self.name}:lift", self.lift)
        for joint, angle in zip(ARM, arm_angles(self.tool, self.lift) or ()):
            self.physics.set_joint(f"{self.name}:{joint}", angle)

    def update(self, pace: float = 1.0) -> None:
        """Aim all servos; ``pace`` is the share of its speed at which the lift may move."""
        most = LIFT_SPEED * self._dt * pace
        self._now += max(-most, min(most, self.lift - self._now))
        self._servo("lift", self._now)
        angles = arm_angles(self.tool, self.physics.joint(f"{self.name}:lift"), self.roll)
        self.reachable = angles is not None
        for joint, angle in zip(ARM, angles or ()):
            self._servo(joint, angle)
        for side in ("inner", "outer"):
            self._servo(f"{side}_finger", self.finger)

    def aim_lift(self, height: float) -> None:
        """Bring the shoulder to a good height for work with the fingertips at ``height``."""
        self.lift = best_lift(height)

    @property
    def lifted(self) -> bool:
        """Whether the lift is where it is wanted."""
        return abs(self.physics.joint(f"{self.name}:lift") - self.lift) < 0.01

    @property
    def fingers_still(self) -> bool:
        """Whether the fingers have stopped."""
        speeds = (self.physics.joint_speed(f"{self.name}:{side}_finger") for side in ("inner", "outer"))
        return all(abs(speed) < 0.004 for speed in speeds)

    def open_for(self, width: float) -> None:
        """Open the fingers for something this wide, with room on either side."""
        self.finger = max(0.0, OPEN - width / 2 - 0.016)

    def close(self) -> None:
        """Close the fingers with their limited force."""
        self.finger = OPEN

    def _servo(self, joint: str, value: float) -> None:
        self.physics.servo(f"{self.name}:{joint}", value)


def best_lift(height: float) -> float:
    """The lift at which the arm works best with the fingertips at a height."""
    return max(LIFT_RANGE[0], min(LIFT_RANGE[1], height + TOOL + ABOVE - SHOULDER_Z))
