"""The robot's head: pans and tilts after the partner it last saw, at a limited rate and within the neck's limits."""

from __future__ import annotations

import math

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import bearing, turn
from casper.sim_adapter.room.scene import Point

EYE_LEVEL = 1.1  # metres: it looks at the partner's hands rather than at the face
LOST = 1.5  # seconds without sight after which it looks round
SWEEP = 0.9  # radians it turns on at a time when looking round
SEARCH = 2.0  # radians/s of the neck's swing then


class RobotHead:
    """``notice`` tells it where the partner was just seen; without that it looks round."""

    def __init__(self, physics: Physics, name: str) -> None:
        self.physics = physics
        self.name = name
        self.seen: Point | None = None
        self.seen_at = -math.inf
        self.pan = 0.0
        self.tilt = 0.2
        self._limit = math.radians(physics.scene.sensor.pan_limit)
        self._rate = math.radians(physics.scene.sensor.pan_rate)
        self._dt = physics.scene.sim.control

    @property
    def lost(self) -> bool:
        """Whether the partner has been out of sight for a while."""
        return self.physics.time - self.seen_at > LOST

    def notice(self, place: Point) -> None:
        """The partner was seen here just now."""
        self.seen, self.seen_at = place, self.physics.time

    def bearing(self, pose: tuple[float, float, float], otherwise: float) -> float:
        """Direction to the partner in the world, while it is known."""
        if self.seen is None or self.lost:
            return otherwise
        return bearing(pose[:2], self.seen)

    def wants_turn(self, pose: tuple[float, float, float]) -> float | None:
        """The heading the base should turn to: the neck is near its limit, or the partner is lost."""
        if self.lost:
            return turn(pose[2] + SWEEP)
        away = turn(self.bearing(pose, pose[2]) - pose[2])
        return turn(pose[2] + away) if abs(away) > 0.6 * self._limit else None

    def update(self, pose: tuple[float, float, float]) -> None:
        """One control step of the neck."""
        if self.seen is None or self.lost:
            wanted_pan, wanted_tilt = self._limit * math.sin(SEARCH * self.physics.time), 0.25
        else:
            wanted_pan = turn(bearing(pose[:2], self.seen) - pose[2])
            eye = float(self.physics.site(f"{self.name}:eye")[2])
            wanted_tilt = math.atan2(eye - EYE_LEVEL, max(0.3, math.dist(pose[:2], self.seen)))
        wanted_pan = max(-self._limit, min(self._limit, wanted_pan))
        most = self._rate * self._dt
        self.pan += max(-most, min(most, wanted_pan - self.pan))
        self.tilt += max(-most, min(most, wanted_tilt - self.tilt))
        self.physics.servo(f"{self.name}:pan", self.pan)
        self.physics.servo(f"{self.name}:tilt", self.tilt)
