"""The human's limbs: a gait that goes with the distance walked, and the arm that brings the wrist to the hand."""

from __future__ import annotations

import math

from casper.sim_adapter.physics.human import FOREARM, HIP, SHOULDER_SIDE, SHOULDER_UP, UPPER_ARM
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.placement import Spot

STRIDE = 4.2  # radians of the gait's cycle for a metre walked
REST: Spot = (0.03, -0.25, 0.83)  # the hand hanging down, in the body's frame
CARRY: Spot = (0.25, -0.08, 1.12)  # the hand holding something in front
WRIST = 0.05  # the wrist stays this far behind and above the middle of the hand
LEAN_STEP, LEAN_LIMIT = 0.025, 1.0


class HumanPose:
    """Aims the servos of the limbs; ``lean`` is how far the trunk bends forward, radians."""

    def __init__(self, physics: Physics, name: str) -> None:
        self.physics = physics
        self.name = name
        self.phase = 0.0
        self.lean = 0.0
        self._shown: tuple[float, Spot] | None = None  # lean and hand of one who stood still when the servos were aimed

    def update(self, speed: float, full_speed: float, hand: Spot, dt: float) -> None:
        """Set every limb for the present speed (m/s) and hand position (body frame)."""
        self._bend(hand)
        now = None if speed else (self.lean, hand)
        if now is not None and now == self._shown:
            return
        self._shown = now
        self.phase += STRIDE * speed * dt
        swing = 0.5 * min(1.0, speed / full_speed)
        for side, shift in (("left", 0.0), ("right", math.pi)):
            wave = math.sin(self.phase + shift)
            self._aim(f"{side}_hip", -swing * wave)
            self._aim(f"{side}_knee", swing * max(0.0, math.cos(self.phase + shift)))
        self._aim("left_shoulder", swing * math.sin(self.phase) * 0.8)
        self._aim("waist", self.lean)
        for joint, angle in zip(("right_out", "right_swing", "right_elbow"), arm_angles(hand, self.lean)):
            self._aim(joint, angle)

    def _bend(self, hand: Spot) -> None:
        """Lean until the arm is long enough, straighten again when it is."""
        gap = math.dist(_in_trunk(_wrist(hand), self.lean), (0.0, -SHOULDER_SIDE, SHOULDER_UP))
        reach = UPPER_ARM + FOREARM
        if gap > 0.97 * reach:
            self.lean = min(LEAN_LIMIT, self.lean + LEAN_STEP)
        elif gap < 0.9 * reach:
            self.lean = max(0.0, self.lean - LEAN_STEP)

    def _aim(self, joint: str, angle: float) -> None:
        self.physics.servo(f"{self.name}:{joint}", angle)


def arm_angles(hand: Spot, lean: float) -> tuple[float, float, float]:
    """Shoulder out, shoulder swing and elbow for a hand in the body's frame; stretched where it is too far."""
    x, y, z = _in_trunk(_wrist(hand), lean)
    dx, dy, dz = x, y + SHOULDER_SIDE, z - SHOULDER_UP
    gap = max(0.1, min(UPPER_ARM + FOREARM - 1e-3, math.hypot(dx, dy, dz)))
    inner = (UPPER_ARM**2 + FOREARM**2 - gap**2) / (2 * UPPER_ARM * FOREARM)
    bend = math.pi - math.acos(max(-1.0, min(1.0, inner)))
    # With the elbow bent the wrist lies this far before and below the hanging shoulder.
    fore, down = FOREARM * math.sin(bend), UPPER_ARM + FOREARM * math.cos(bend)
    side = math.hypot(dy, dz) if dz < 0 else -math.hypot(dy, dz)
    out = math.atan2(dy, -dz) if dz < 0 else math.atan2(-dy, dz)
    swing = math.atan2(fore, down) - math.atan2(dx, side)
    return out, swing, -bend


def _wrist(hand: Spot) -> Spot:
    return hand[0] - WRIST, hand[1], hand[2] + WRIST / 2


def _in_trunk(point: Spot, lean: float) -> Spot:
    """A point of the body's frame in the frame of the leaning trunk (origin at the hip)."""
    x, z = point[0], point[2] - HIP
    return x * math.cos(lean) - z * math.sin(lean), point[1], x * math.sin(lean) + z * math.cos(lean)
