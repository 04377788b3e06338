"""The robot's arm: the servos of its joints, the torso's lift, and the fingers."""

from __future__ import annotations

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.placement import Spot

LIFT_SPEED = 0.15
ROOM = 0.016  # metres on either side of something that the fingers are opened for


class RobotArm:
    """Keeps the fingertips at ``tool`` (base frame), the lift and the fingers where they are wanted."""

    def __init__(self, physics: Physics, name: str) -> None:
        self.physics = physics
        self.name = name
        self.body = physics.body
        self._angles = self.body.reach(physics.model, name)
        self.tool: Spot = self.body.home
        self.roll = 0.0
        self.lift = self.body.best_lift(self.tool[2])
        self.finger = 0.0
        self.reachable = True
        self._now = physics.joint(f"{name}:lift")
        self._dt = physics.scene.sim.control

    def settle(self) -> None:
        """Put every joint where it is wanted at once (only for the start)."""
        self._now = self.lift
        self.physics.set_joint(f"{self.name}:lift", self.lift)
        for joint, angle in zip(self.body.arm, self._angles(self.tool, self.lift, self.roll) or ()):
            self.physics.set_joint(f"{self.name}:{joint}", angle)

    def update(self, pace: float = 1.0) -> None:
        """Aim all servos; ``pace`` is the share of its speed at which the lift may move."""
        if self.body.lift_follows:
            self.aim_lift(self.tool[2])
        most = LIFT_SPEED * self._dt * pace
        self._now += max(-most, min(most, self.lift - self._now))
        self._servo("lift", self._now)
        angles = self._angles(self.tool, self.physics.joint(f"{self.name}:lift"), self.roll)
        self.reachable = angles is not None
        for joint, angle in zip(self.body.arm, angles or ()):
            self._servo(joint, angle)
        for side in ("inner", "outer"):
            self._servo(f"{side}_finger", self.finger)

    def aim_lift(self, height: float) -> None:
        """Bring the shoulder to a good height for work with the fingertips at ``height``."""
        self.lift = self.body.best_lift(height)

    @property
    def lifted(self) -> bool:
        """Whether the lift is where it is wanted."""
        return abs(self.physics.joint(f"{self.name}:lift") - self.lift) < 0.01

    @property
    def waits_for_lift(self) -> bool:
        """Whether the fingertips are out of reach for as long as the lift is on its way."""
        return self.body.lift_follows and not self.reachable and not self.lifted

    @property
    def fingers_still(self) -> bool:
        """Whether the fingers have stopped."""
        speeds = (self.physics.joint_speed(f"{self.name}:{side}_finger") for side in ("inner", "outer"))
        return all(abs(speed) < 0.004 for speed in speeds)

    def open_for(self, width: float) -> None:
        """Open the fingers for something this wide, with room on either side."""
        self.finger = max(0.0, self.body.opening - width / 2 - ROOM)

    def close(self) -> None:
        """Close the fingers with their limited force."""
        self.finger = self.body.opening

    def _servo(self, joint: str, value: float) -> None:
        self.physics.servo(f"{self.name}:{joint}", value)

