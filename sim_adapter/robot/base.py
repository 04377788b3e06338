"""The robot's base: drives along paths round furniture and people by moving what its servos aim at."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from itertools import pairwise

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import Disc, bearing, in_the_way, turn
from casper.sim_adapter.room.navigation import Navigator, length
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import StepFailed, Ticks

ACCELERATION = 0.8
LAG = 0.3  # metres the base may stay behind its servos before something is wrong


class RobotBase:
    """Pose and driving. ``others`` gives the discs to keep away from."""

    def __init__(
        self,
        physics: Physics,
        navigator: Navigator,
        start: tuple[float, float, float],
        others: Callable[[], Sequence[Disc]],
    ) -> None:
        self.physics = physics
        self.name = physics.scene.robot
        self.settings = physics.scene.robot_settings
        self.navigator = navigator
        self.aim_x, self.aim_y, self.aim_yaw = start
        self.speed = 0.0
        self._turning = 0.0
        self.held_up = 0.0  # seconds it has been waiting for a way
        self.goals: list[Point] = []  # where it wants to be
        self.others = others
        self._dt = physics.scene.sim.control
        self._joints = tuple(f"{self.name}:{joint}" for joint in ("x", "y", "yaw"))
        for joint, value in zip(self._joints, start):
            physics.set_joint(joint, value)

    @property
    def pose(self) -> tuple[float, float, float]:
        """Where it really is: x, y, heading within ±π."""
        x, y, yaw = map(self.physics.joint, self._joints)
        return x, y, turn(yaw)

    @property
    def place(self) -> Point:
        """Where it really stands."""
        x, y, _ = self.pose
        return x, y

    def update(self) -> None:
        """Aim the servos."""
        for joint, value in zip(self._joints, (self.aim_x, self.aim_y, self.aim_yaw)):
            self.physics.servo(joint, value)

    def local(self, point: tuple[float, float, float]) -> tuple[float, float, float]:
        """A point of the world in the base frame."""
        x, y, yaw = self.pose
        dx, dy = point[0] - x, point[1] - y
        return math.cos(yaw) * dx + math.sin(yaw) * dy, -math.sin(yaw) * dx + math.cos(yaw) * dy, point[2]

    def go(self, goals: Callable[[], list[Point]]) -> Ticks:
        """Drive to the nearest of the goals; waits and looks for another way while blocked.

        Raises:
            StepFailed: no way within the robot's patience, or the base is stuck.
        """
        self.held_up = 0.0
        while True:
            self.goals = goals()
            path = self._best_path(self.goals)
            if path is not None and (yield from self._follow(path)):
                break
            self.held_up += 0.5
            if self.held_up > self.settings.patience:
                raise StepFailed("there is no free way")
            yield from self.halt(0.5)
        self.held_up = 0.0
        yield from self.halt(0.3)

    def face(self, point: Point) -> Ticks:
        """Turn on the spot."""
        while abs(turn(bearing(self.place, point) - self.aim_yaw)) > 0.01:
            self.turn_to(bearing(self.place, point))
            yield
        self._turning = 0.0

    def turn_to(self, heading: float, share: float = 1.0) -> None:
        """One control step of turning towards a heading."""
        left = turn(heading - self.aim_yaw)
        fastest = min(self.settings.turn_rate * share, 2.0 * abs(left) + 0.05)
        wanted = math.copysign(min(fastest, abs(left) / self._dt), left)
        change = 3.0 * self._dt
        self._turning += max(-change, min(change, wanted - self._turning))
        self.aim_yaw += self._turning * self._dt

    def _best_path(self, goals: list[Point]) -> list[Point] | None:
        start, best = (self.aim_x, self.aim_y), None
        for goal in sorted(goals, key=lambda goal: math.dist(goal, start))[:6]:
            path = self.navigator.path(start, goal, self.others())
            if path is not None and (best is None or length(path) < length(best)):
                best = path
        return best

    def _follow(self, path: Sequence[Point]) -> Generator[None, None, bool]:
        """Along a path, looking where it goes; False when somebody is in the way."""
        left = length(path)
        for start, corner in pairwise(path):
            left -= math.dist(start, corner)
            while math.dist((self.aim_x, self.aim_y), corner) > 1e-3:
                if in_the_way((self.aim_x, self.aim_y), corner, self.others()):
                    self.speed = 0.0
                    return False
                self._roll(corner, left)
                yield
        self.speed = 0.0
        return True

    def _roll(self, corner: Point, beyond: float) -> None:
        """One control step towards a corner with ``beyond`` metres to go after it."""
        here = (self.aim_x, self.aim_y)
        if math.dist(here, self.place) > LAG:
            raise StepFailed("the base is stuck")
        gap = math.dist(here, corner)
        way = bearing(here, corner)
        if gap + beyond > 0.3:
            self.turn_to(way)
        off = abs(turn(way - self.aim_yaw))
        fast = min(self.settings.drive_speed * max(0.25, math.cos(off)), math.sqrt(2 * ACCELERATION * (gap + beyond)))
        change = ACCELERATION * self._dt
        self.speed = max(self.speed - 2 * change, min(self.speed + change, max(fast, 0.03)))
        step = min(self.speed * self._dt, gap)
        self.aim_x += step * math.cos(way)
        self.aim_y += step * math.sin(way)

    def halt(self, seconds: float) -> Ticks:
        """Stand for a while."""
        self.speed = 0.0
        self._turning = 0.0
        for _ in range(round(seconds / self._dt)):
            yield
