"""What the robot does with arm and gripper while its base stands: grasp, raise, put, scrub, let go."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress

from casper.sim_adapter.physics.grip import grip_of, touching
from casper.sim_adapter.physics.physics import STILL_SPEED, Physics
from casper.sim_adapter.robot.arm import RobotArm
from casper.sim_adapter.robot.base import RobotBase
from casper.sim_adapter.robot.space import Space
from casper.sim_adapter.room.geometry import bearing, turn
from casper.sim_adapter.room.placement import Spot, is_placed, place_spot
from casper.sim_adapter.steps import Missed, OutOfReach, StepFailed, Ticks

HOVER, TOUCH = 0.12, 0.004  # metres above its place at which an object is brought there, and let down to
SCRUBS, SWING, RISE = 3, 0.03, 0.02  # how often, how far and how much lifted a used object moves to and fro


class RobotHand:
    """Skills of the arm; every one takes its time and raises StepFailed when it does not work.

    ``space`` says how fast the arm may be among people.
    """

    def __init__(self, physics: Physics, base: RobotBase, arm: RobotArm, space: Space) -> None:
        self.physics = physics
        self.space = space
        self.scene = physics.scene
        self.name = self.scene.robot
        self.settings = self.scene.robot_settings
        self.base = base
        self.arm = arm
        self.body = physics.body
        self._stood = 0.0  # seconds that the arm has stood because somebody was too near
        self._dt = self.scene.sim.control

    def home(self) -> Ticks:
        """Fold the empty arm."""
        yield from self._glide(lambda: self.body.home)
        self.arm.aim_lift(self.body.home[2])

    def grasp(self, target: str) -> Ticks:
        """Fingers round the object from above; it holds only when they are really there and closed on it."""
        grip = grip_of(self.scene.thing(target))

        def goal() -> Spot:
            return grip.point(self.physics, target, self.base.place)

        self.arm.open_for(grip.width)
        self.arm.roll = 0.0 if grip.is_rim else self.body.roll
        self.arm.aim_lift(self.physics.position(target)[2])
        yield from self._tool_to(lambda: _above(goal(), HOVER))
        yield from self._wait(lambda: self.arm.lifted, 5.0)
        yield from self._tool_to(goal)
        yield from self._wait(lambda: math.dist(self._tool(), goal()) < 0.01, 1.0)
        self.arm.close()
        yield from self._pause(0.3)
        yield from self._wait(lambda: self.arm.fingers_still, 2.0)
        self._check_grasp(target, math.dist(self._tool(), goal()))
        if not self.physics.grasp(self.name, target):
            raise Missed(f"{self.physics.holder(target)} holds {target}")

    def take_up(self, target: str) -> Ticks:
        """Lift, and draw back to where it is carried, unless it is there already."""
        (x, y, z), (out, aside, least) = self.arm.tool, self.body.home
        below = self._tool()[2] - self.physics.position(target)[2] + self.scene.thing(target).height / 2
        height = max(self.body.carry_clear + below, least)
        if math.hypot(x - out, y - aside) < 0.01 and z > height - 0.02:
            return
        height = max(z + 0.1, height)
        yield from self._glide(lambda: (x, y, height))
        self.arm.aim_lift(height)
        yield from self._glide(lambda: (out, aside, height))

    def put(self, target: str, destination: str) -> Ticks:
        """Bring what is held to its place, and see that it stays there."""
        spot = place_spot(self.scene, self.physics.positions(), target, destination, self.base.place)
        yield from self.lay(target, spot)
        if not is_placed(self.scene, self.physics.positions(), target, destination):
            raise Missed(f"{target} did not come to rest at {destination}")

    def lay(self, target: str, spot: Spot) -> Ticks:
        """Bring what is held to a spot, and let go."""
        yield from self._tool_to(lambda: self._tool_for(target, _above(spot, HOVER)))
        self.arm.aim_lift(spot[2])
        yield from self._wait(lambda: self.arm.lifted, 5.0)
        yield from self._tool_to(lambda: self._tool_for(target, _above(spot, TOUCH)))
        yield from self.release(target)

    def lower(self, target: str, spot: Spot) -> Ticks:
        """Let what is held down at a spot right below it, and let go."""
        yield from self._tool_to(lambda: self._tool_for(target, _above(spot, TOUCH)))
        yield from self.release(target)

    def back_off(self, target: str) -> Ticks:
        """Open the fingers round what is not held, and fold the arm."""
        self.arm.open_for(grip_of(self.scene.thing(target)).width)
        yield from self._pause(0.4)
        x, y, z = self.arm.tool
        with suppress(OutOfReach):  # stretched out it cannot rise
            yield from self._glide(lambda: (x, y, max(z, min(z + 0.15, self.body.home[2]))))
        yield from self.home()

    def release(self, target: str) -> Ticks:
        """Let go when the object rests, open, draw up and back."""
        yield from self._wait(lambda: self.physics.speed(target) < STILL_SPEED, 2.0)
        self.physics.release(self.name)
        self.arm.open_for(grip_of(self.scene.thing(target)).width)
        yield from self._pause(0.4)
        x, y, z = self.arm.tool
        yield from self._glide(lambda: (x, y, z + 0.15))
        yield from self._glide(lambda: self.body.home)

    def scrub(self, target: str) -> Ticks:
        """Move what is held to and fro where it is, a little lifted, then back to where it was."""
        start = self.physics.position(target)
        side = bearing(self.base.place, start[:2]) + math.pi / 2
        ticks = round(self.settings.use_time / self._dt)
        tick = 0.0
        while tick < ticks:
            share = tick / ticks
            tick += self._pace()
            swing = SWING * math.sin(2 * math.pi * SCRUBS * share)
            rise = RISE * min(1.0, 8 * share, 8 * (1 - share))
            spot = (start[0] + swing * math.cos(side), start[1] + swing * math.sin(side), start[2] + rise)
            self.arm.tool = self.base.local(self._tool_for(target, spot))
            self._check_reach()
            yield
        yield from self._tool_to(lambda: self._tool_for(target, _above(start, TOUCH)))

    def _pace(self) -> float:
        """The share of its speed that the arm has at this control step, 0 while somebody is too near.

        Raises:
            StepFailed: they stay for longer than the robot's patience.
        """
        self._stood = self._stood + self._dt if self.space.pace == 0.0 else 0.0
        self.base.held_up = self._stood
        if self._stood > self.settings.patience:
            self._stood = self.base.held_up = 0.0
            raise StepFailed(f"somebody stays within {self.settings.stop_distance:g} m")
        return self.space.pace

    def _check_grasp(self, target: str, off: float) -> None:
        if off > self.settings.grasp_distance:
            raise Missed(f"the gripper is {off * 100:.0f} cm away from {target}")
        if not touching(self.physics, self.name, target):
            raise Missed(f"the fingers closed beside {target}")

    def _check_reach(self) -> None:
        """What was out of reach is not aimed at any longer: the arm goes on from where it really is."""
        if not self.arm.reachable:
            self.arm.tool = self.base.local(self._tool())
            raise OutOfReach("the arm does not reach there")

    def _tool(self) -> Spot:
        x, y, z = self.physics.site(f"{self.name}:tool")
        return float(x), float(y), float(z)

    def _tool_for(self, target: str, spot: Spot) -> Spot:
        """Where the fingertips must be for the held object's middle to be at a spot.

        The hand turns with the arm, and what it holds with the hand: a few rounds settle the two.
        """
        tool, held, robot = self._tool(), self.physics.position(target), self.base.place
        here = bearing(robot, tool[:2])
        dx, dy, up = held[0] - tool[0], held[1] - tool[1], tool[2] - held[2]
        goal: Spot = (spot[0] - dx, spot[1] - dy, spot[2] + up)
        for _ in range(3):
            turned = turn(bearing(robot, goal[:2]) - here)
            c, s = math.cos(turned), math.sin(turned)
            goal = (spot[0] - c * dx + s * dy, spot[1] - s * dx - c * dy, goal[2])
        return goal

    def _tool_to(self, goal: Callable[[], Spot]) -> Ticks:
        """Fingertips to a point of the world."""
        yield from self._glide(lambda: self.base.local(goal()))

    def _glide(self, goal: Callable[[], Spot]) -> Ticks:
        """Fingertips to a point of the base frame, smoothly (least jerk) and in a straight line.

        Slower among people; while one is too near they stand, and when that one stays the skill fails.
        """
        start, end = self.arm.tool, goal()
        ticks = max(10, round(1.9 * math.dist(start, end) / self.settings.reach_speed / self._dt))
        tick = 0.0
        while tick < ticks:
            tick = min(ticks, tick + self._pace())
            t = tick / ticks
            share = t * t * t * (10 - 15 * t + 6 * t * t)
            x, y, z = (a + share * (b - a) for a, b in zip(start, end))
            self.arm.tool = (x, y, z)
            yield
        yield from self._wait(lambda: not self.arm.waits_for_lift, 5.0)
        self._check_reach()

    def _wait(self, until: Callable[[], bool], seconds: float) -> Ticks:
        for _ in range(round(seconds / self._dt)):
            if until():
                return
            yield

    def _pause(self, seconds: float) -> Ticks:
        yield from self._wait(lambda: False, seconds)


def _above(spot: Spot, rise: float) -> Spot:
    return spot[0], spot[1], spot[2] + rise
