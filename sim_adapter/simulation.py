"""The simulation: physics, human, robot and the robot's eye on one clock."""

from __future__ import annotations

import math

import numpy as np

from casper.engine.perception.world import WorldState
from casper.engine.settings import check_seed
from casper.kb.errors import DomainError
from casper.sim_adapter.adapter import truth
from casper.sim_adapter.eye.sensors import Sensor
from casper.sim_adapter.eye.vantage import vantage
from casper.sim_adapter.human.human import Human
from casper.sim_adapter.physics.physics import STILL_SPEED, Physics
from casper.sim_adapter.robot.robot import Robot
from casper.sim_adapter.room.geometry import Disc, floor_of
from casper.sim_adapter.room.navigation import Navigator
from casper.sim_adapter.room.placement import is_placed
from casper.sim_adapter.room.scene import Point, Scene

APART = 0.1  # metres kept between two agents beside their radii
HOME = 0.15  # metres from where it began within which an object is at its place
GLANCE = 5  # control steps between two looks after the partner


class Simulation:
    """One run of a scene. The same seed gives the same run, state by state.

    Args:
        scene: what to build.
        seed: a whole number from 0, of the start, the human's pauses and the sensor (three independent streams).
        start: where the human starts, x, y and perhaps heading (radians); random when None.

    Raises:
        DomainError: the start is not on the walkable floor, or the seed is none.
    """

    def __init__(self, scene: Scene, *, seed: int, start: tuple[float, ...] | None = None) -> None:
        check_seed(seed)
        self.scene = scene
        self.seed = seed
        self.physics = Physics(scene)
        floor = floor_of(scene)
        streams = [np.random.default_rng([seed, stream]) for stream in range(3)]
        human_ways = Navigator(floor, scene.human_settings.radius)
        robot_ways = Navigator(floor, scene.robot_settings.radius)
        robot_start = scene.starts[scene.robot]
        began = self._start(human_ways, robot_start[:2], streams[0], start)
        self.robot = Robot(self.physics, robot_ways, robot_start, self._human_discs)
        self.human = Human(self.physics, human_ways, began, self._robot_discs, streams[1])
        self.sensor = Sensor(self.physics, streams[2])
        self.physics.refresh()
        self.robot.post = vantage(self.physics, self.sensor, robot_ways, robot_start[:2])
        self._ticks = 0

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.physics.time

    def advance(self, seconds: float) -> None:
        """Let the world run on (in whole control steps)."""
        for _ in range(round(seconds / self.scene.sim.control)):
            if self._ticks % GLANCE == 0 and self.sensor.sees_person(self.human.place):
                self.robot.head.notice(self.human.place)
            self.human.tick()
            self.robot.tick()
            self.physics.step()
            self._ticks += 1

    def observe(self) -> WorldState:
        """What the robot makes out at this moment (each call draws new noise)."""
        pose = (self.human.x, self.human.y, self.human.heading)
        return self.sensor.observe(pose, self.robot.pose, self.robot.holding)

    def truth(self) -> WorldState:
        """Everything as it is."""
        return truth(self.physics, self.human, self.robot)

    def rests_in(self, thing: str, place: str) -> bool:
        """Whether an object lies at a place (in it, on it, beside it), let go and at rest."""
        where = self.physics.positions()
        return (
            self.physics.holder(thing) is None
            and is_placed(self.scene, where, thing, place)
            and self.physics.speed(thing) < STILL_SPEED
        )

    def remove(self, thing: str) -> None:
        """Take a movable object out of the world (eaten up, say): no world state has it until it is put back."""
        self.physics.remove(thing)

    def put_back(self, thing: str) -> bool:
        """Put a movable object where it was at the start, unless somebody holds it or its place is taken.

        Returns whether it is there now. What was removed is there anew; what stands in a dish stays behind.
        """
        first, where = self.scene.thing(thing), self.physics.positions()
        at = where.get(thing)
        if at is not None and math.dist(at, (first.x, first.y, at[2])) < HOME:
            return True
        taken = any(
            math.dist(spot[:2], (first.x, first.y)) < first.radius + self.scene.thing(other).radius
            for other, spot in where.items()
            if other != thing and self.scene.thing(other).movable
        )
        if taken or self.physics.holder(thing) is not None:
            return False
        self.physics.put_back(thing)
        return True

    def _robot_discs(self) -> list[Disc]:
        x, y, _ = self.robot.pose
        return [Disc(x, y, self._apart)]

    def _human_discs(self) -> list[Disc]:
        return [Disc(self.human.x, self.human.y, self._apart)]

    @property
    def _apart(self) -> float:
        return self.scene.human_settings.radius + self.scene.robot_settings.radius + APART

    def _start(
        self, ways: Navigator, robot: Point, rng: np.random.Generator, start: tuple[float, ...] | None
    ) -> tuple[float, float, float]:
        """Where the human begins: as asked, as the scene says, or anywhere on the floor away from the robot."""
        given = start if start is not None else self.scene.starts.get(self.scene.human)
        if given is not None:
            if not ways.free((given[0], given[1])):
                raise DomainError(f"nobody can start at ({given[0]:g}, {given[1]:g}): it is not on the free floor")
            return given[0], given[1], given[2] if len(given) > 2 else float(rng.uniform(-math.pi, math.pi))
        xs, ys = zip(*self.scene.walkable)
        while True:
            x, y = float(rng.uniform(min(xs), max(xs))), float(rng.uniform(min(ys), max(ys)))
            if ways.free((x, y)) and math.dist((x, y), robot) > 2 * self._apart:
                return x, y, float(rng.uniform(-math.pi, math.pi))
