"""The robot's base: drives along paths round furniture and people by moving what its servos aim at."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from itertools import pairwise

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.robot.space import Space
from casper.sim_adapter.room.geometry import Disc, bearing, in_the_way, turn
from casper.sim_adapter.room.navigation import Navigator, length
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import Missed, StepFailed, Ticks

ACCELERATION = 0.8
LAG = 0.3  # metres the base may stay behind its servos before something is wrong
RESTS = 0.06  # m/s, and rad/s, below which it has come to rest
ASIDE = 3.0  # seconds it stays where it went to let somebody through


def never() -> bool:
    """Nothing happens that would change the way."""
    return False


class RobotBase:
    """Pose and driving. ``others`` gives the discs to keep away from, ``space`` how fast it may be among people."""

    def __init__(
        self,
        physics: Physics,
        navigator: Navigator,
        start: tuple[float, float, float],
        others: Callable[[], Sequence[Disc]],
        space: Space,
    ) -> None:
        self.physics = physics
        self.space = space
        self.name = physics.scene.robot
        self.settings = physics.scene.robot_settings
        self.navigator = navigator
        self.aim_x, self.aim_y, self.aim_yaw = start
        self.speed = 0.0
        self._turning = 0.0
        self._brakes = False
        self.held_up = 0.0  # seconds it has been waiting for a way
        self.goals: list[Point] = []  # where it wants to be, whoever stands there
        self.waits = False  # for a way, or for a hand to let go
        self.aside: Point | None = None  # where it shall go first, to let somebody through
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
        """Aim the servos; who brakes stays where it comes to rest, and does not swing back."""
        if self._brakes and all(abs(self.physics.joint_speed(joint)) < RESTS for joint in self._joints):
            self._brakes = False
            self._aim_here()
        for joint, value in zip(self._joints, (self.aim_x, self.aim_y, self.aim_yaw)):
            self.physics.servo(joint, value)

    def local(self, point: tuple[float, float, float]) -> tuple[float, float, float]:
        """A point of the world in the base frame."""
        x, y, yaw = self.pose
        dx, dy = point[0] - x, point[1] - y
        return math.cos(yaw) * dx + math.sin(yaw) * dy, -math.sin(yaw) * dx + math.cos(yaw) * dy, point[2]

    def go(
        self,
        goals: Callable[[Sequence[Disc]], list[Point]],
        stale: Callable[[], bool] = never,
    ) -> Generator[None, None, bool]:
        """Drive to the nearest of the goals; waits and looks for another way while blocked.

        ``goals`` gives those that are free of some discs. Returns whether it is there: not when ``stale`` says that
        there is nothing to go there for any more.

        Raises:
            StepFailed: no way within the robot's patience. Missed: the base is stuck.
        """
        self.held_up, self.aside = 0.0, None
        while not stale():
            free = goals(self.others())
            self.goals = free or goals(())
            path = self._best_path(free)
            if path is not None and (yield from self._follow(path, stale)):
                self.held_up = 0.0
                yield from self.halt(0.3)
                return True
            if stale():
                break
            self.held_up += 0.5
            if self.held_up > self.settings.patience:
                self.held_up = 0.0
                raise StepFailed(self._why_not(path))
            yield from self.stop()
            self.waits = True
            yield from self.halt(0.5)
            self.waits = False
            yield from self.step_aside()
        self.held_up = 0.0
        yield from self.stop()
        return False

    def _why_not(self, path: Sequence[Point] | None) -> str:
        """Why it does not get on."""
        if self.space.pace == 0.0:
            return f"somebody stands within {self.settings.stop_distance:g} m"
        return "there is no free way" if path is None else "somebody is in the way"

    def step_aside(self) -> Ticks:
        """Where it was asked to let somebody through, drive out of their way and stay there for a moment."""
        spot, self.aside = self.aside, None
        path = None if spot is None else self.navigator.path((self.aim_x, self.aim_y), spot, self.others())
        if path is not None:
            yield from self._follow(path, never)
            yield from self.stop()
            yield from self.halt(ASIDE)

    def face(self, point: Point) -> Ticks:
        """Turn on the spot."""
        stood = 0.0
        while abs(turn(bearing(self.place, point) - self.aim_yaw)) > 0.01:
            self.turn_to(bearing(self.place, point))
            self.held_up = stood = stood + self._dt if self.space.pace == 0.0 else 0.0
            if stood > self.settings.patience:
                self.held_up = 0.0
                raise StepFailed(self._why_not(None))
            yield
        self._turning = 0.0

    def turn_to(self, heading: float, share: float = 1.0) -> None:
        """One control step of turning towards a heading, slower among people: the arm turns with the base."""
        if self.space.pace == 0.0:
            self._stand()
            return
        left, self._brakes = turn(heading - self.aim_yaw), False
        fastest = min(self.settings.turn_rate * share * self.space.pace, 2.0 * abs(left) + 0.05)
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

    def _follow(self, path: Sequence[Point], stale: Callable[[], bool]) -> Generator[None, None, bool]:
        """Along a path, looking where it goes; False when somebody is in the way, or the way has become stale."""
        left = length(path)
        for start, corner in pairwise(path):
            left -= math.dist(start, corner)
            while math.dist((self.aim_x, self.aim_y), corner) > 1e-3:
                here = (self.aim_x, self.aim_y)
                if self.space.pace == 0.0 or stale() or in_the_way(here, corner, self.others()):
                    return False
                self._roll(corner, left)
                yield
        self.speed = 0.0
        return True

    def _roll(self, corner: Point, beyond: float) -> None:
        """One control step towards a corner with ``beyond`` metres to go after it."""
        here = (self.aim_x, self.aim_y)
        if math.dist(here, self.place) > LAG:
            raise Missed("the base is stuck")
        gap, self._brakes = math.dist(here, corner), False
        way = bearing(here, corner)
        if gap + beyond > 0.3:
            self.turn_to(way)
        off = abs(turn(way - self.aim_yaw))
        fast = self.settings.drive_speed * self.space.pace * max(0.25, math.cos(off))
        fast = min(fast, math.sqrt(2 * ACCELERATION * (gap + beyond)))
        change = ACCELERATION * self._dt
        self.speed = max(self.speed - 2 * change, min(self.speed + change, max(fast, 0.03)))
        step = min(self.speed * self._dt, gap)
        self.aim_x += step * math.cos(way)
        self.aim_y += step * math.sin(way)

    def stop(self) -> Ticks:
        """Stand where it really is."""
        self._stand()
        yield

    def _stand(self) -> None:
        """The servos aim at where the base really is, but for what it rolls on while they take hold."""
        if self.speed or self._turning:
            self._brakes = True
            self._aim_here()
        self.speed = self._turning = 0.0

    def _aim_here(self) -> None:
        x, y, yaw = self.pose
        self.aim_x, self.aim_y = x, y
        self.aim_yaw += turn(yaw - self.aim_yaw)

    def halt(self, seconds: float) -> Ticks:
        """Stand for a while."""
        self.speed = 0.0
        self._turning = 0.0
        for _ in range(round(seconds / self._dt)):
            yield
