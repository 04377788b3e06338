"""The simulation: physics, people, the robot and the robot's eye on one clock."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.engine.settings import check_seed
from casper.kb.errors import DomainError
from casper.sim_adapter.eye.attention import Attention
from casper.sim_adapter.eye.sensors import Sensor
from casper.sim_adapter.eye.vantage import vantage
from casper.sim_adapter.human.human import Human
from casper.sim_adapter.human.walk import HumanWalk
from casper.sim_adapter.physics.physics import STILL_SPEED, Physics
from casper.sim_adapter.robot.base import RobotBase
from casper.sim_adapter.robot.robot import Robot
from casper.sim_adapter.room.geometry import Disc, bearing, floor_of
from casper.sim_adapter.room.making_way import HELD_UP, spot_out_of_the_way
from casper.sim_adapter.room.navigation import Navigator
from casper.sim_adapter.room.placement import is_placed
from casper.sim_adapter.room.scene import Point, Scene

APART = 0.1  # metres kept between two agents beside their radii
HOME = 0.15  # metres from where it began within which an object is at its place
MOST_TRIED = 10_000  # random places to start at
GLANCE = 5  # control steps between two looks after the partner


class Simulation:
    """One run of a scene. The same seed gives the same run, state by state.

    Args:
        scene: what to build.
        seed: a whole number from 0, of the start, the human's pauses and the sensor (three independent streams), and of
            the starts and the pauses of more people.
        start: where the first human starts, x, y and perhaps heading (radians); random when None.

    Raises:
        DomainError: the start is not on the walkable floor, or the seed is none.
    """

    def __init__(self, scene: Scene, *, seed: int, start: tuple[float, ...] | None = None) -> None:
        check_seed(seed)
        self.scene = scene
        self.seed = seed
        self.physics = Physics(scene)
        floor = floor_of(scene)
        streams = [np.random.default_rng([seed, stream]) for stream in range(1 + 2 * len(scene.people))]
        human_ways = Navigator(floor, scene.human_settings.radius)
        robot_ways = Navigator(floor, scene.robot_settings.radius)
        self.sensor = Sensor(self.physics, streams[2])
        robot_start = scene.starts.get(scene.robot) or self._post(robot_ways)
        self.robot = Robot(self.physics, robot_ways, robot_start, lambda: self._discs(None))
        self.people: dict[str, Human] = {}
        for name, (whence, pauses) in zip(scene.people, ((0, 1), *((n, n + 1) for n in range(3, len(streams), 2)))):
            given = start if start is not None and not self.people else scene.starts.get(name)
            began = self._start(human_ways, robot_start[:2], streams[whence], given)
            about = partial(self._discs, name), streams[pauses], partial(self._vacant, name)
            self.people[name] = Human(self.physics, name, human_ways, began, *about)
        self.physics.refresh()
        self.robot.post = vantage(self.physics, self.sensor, robot_ways, robot_start[:2])
        self._attention = Attention(self.sensor, self.robot.head, self.people)
        self._ticks = 0
        self.each_glance: Callable[[], object] = bool  # called whenever the robot looks after the partner
        self._made_way: dict[str | None, float] = {}  # when somebody was let through last; None: the robot
        self._taken: dict[str, str] = {}  # which place somebody has gone to with something

    @property
    def human(self) -> Human:
        """The first of the people."""
        return self.people[self.scene.human]

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.physics.time

    def advance(self, seconds: float) -> None:
        """Let the world run on (in whole control steps)."""
        for _ in range(round(seconds / self.scene.sim.control)):
            if self._ticks % GLANCE == 0:
                self._attention.update()
                self._make_way()
                self.each_glance()
            for human in self.people.values():
                human.tick()
            self.robot.tick()
            self.physics.step()
            self._ticks += 1

    def observe(self) -> WorldState:
        """What the robot makes out at this moment (each call draws new noise)."""
        poses = {name: (human.x, human.y, human.heading) for name, human in self.people.items()}
        return self.sensor.observe(poses, self.robot.pose, self.robot.holding)

    def truth(self) -> WorldState:
        """Everything as it is, without noise, and nothing hidden."""
        people = self.people.values()
        agents = {human.name: AgentState(human.x, human.y, human.heading, human.holding) for human in people}
        agents[self.robot.name] = AgentState(*self.robot.pose, self.robot.holding)
        objects = {name: ObjectState(*spot) for name, spot in self.physics.positions().items()}
        return WorldState(self.physics.time, agents, objects)

    def rests_in(self, thing: str, place: str) -> bool:
        """Whether an object lies at a place (in it, on it, beside it), let go and at rest."""
        where = self.physics.positions()
        return (
            self.physics.holder(thing) is None
            and is_placed(self.scene, where, thing, place)
            and self.physics.speed(thing) < STILL_SPEED
        )

    def is_at(self, thing: str | None, place: str | None) -> bool:
        """Whether an object is at a place, in nobody's hand."""
        where = self.physics.positions()
        return self.physics.holder(str(thing)) is None and is_placed(self.scene, where, str(thing), str(place))

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

    def _vacant(self, name: str, thing: str, place: str) -> bool:
        """Whether somebody can bring a thing to a place: nobody else is at work there, and nothing else lies there.

        Who is told so has the place until they turn to another one.
        """
        if len(self.people) == 1:
            return True
        by, where = self._taken.get(place), self.physics.positions()
        if by not in (None, name) and self.people[str(by)].is_bound_for(place):
            return False
        if any(is_placed(self.scene, where, other, place) for other in self.scene.movables if other != thing):
            return False
        self._taken[place] = name
        return True

    def _make_way(self) -> None:
        """Those who can make way for one who has waited for a while; the robot does for people."""
        movers: dict[str | None, RobotBase | HumanWalk] = {name: human.walk for name, human in self.people.items()}
        for name, mover in {None: self.robot.base, **movers}.items():
            waits = mover.held_up >= HELD_UP and not (name is None and self.robot.idle)
            if not waits or self.time - self._made_way.get(name, -math.inf) < HELD_UP:
                continue
            self._made_way[name] = self.time
            for human in (h for h in self.people.values() if h.name != name and h.can_make_way):
                self._send_away(human, name, mover)
            if name is not None:
                self._let_through(name, mover)

    def _let_through(self, name: str, mover: RobotBase | HumanWalk) -> None:
        """The robot drives to a spot where somebody who is held up gets by, when it is the robot that is in the way."""
        base = self.robot.base
        spot = self._spot_aside(name, mover, base.place, self.scene.robot_settings.radius, base.navigator, None)
        if spot is not None:
            self.robot.give_way(spot)

    def _send_away(self, human: Human, name: str | None, mover: RobotBase | HumanWalk) -> None:
        robot_stands = name is None and self.robot.space.pace == 0.0
        if not mover.goals or robot_stands:  # somebody stands wherever one could stand, or too near for it to move
            human.make_way(None)
            return
        radius = self.scene.human_settings.radius
        spot = self._spot_aside(name, mover, human.place, radius, human.walk.navigator, human.name)
        if spot is not None:
            human.make_way(spot)

    def _spot_aside(
        self,
        name: str | None,
        mover: RobotBase | HumanWalk,
        here: Point,
        radius: float,
        ways: Navigator,
        who: str | None,
    ) -> Point | None:
        """Where ``who`` (None: the robot), who stands here, lets somebody through; None when that one has a way."""
        place = mover.place if isinstance(mover, RobotBase) else mover.body.place
        near = sorted(mover.goals, key=lambda goal: math.dist(goal, place))[:3]
        apart = self.scene.robot_settings.keep_distance if None in (who, name) else APART
        rest = [disc for disc in self._discs(name) if (disc.x, disc.y) != here]

        def through(spot: Point) -> bool:
            discs = [*rest, Disc(*spot, radius + mover.navigator.radius + apart)]
            return any(mover.navigator.path(place, goal, discs) is not None for goal in near)

        if not near or through(here):
            return None
        return spot_out_of_the_way(ways, here, self._discs(who), through)

    def _discs(self, name: str | None) -> list[Disc]:
        """What somebody keeps away from: the others. None is the robot."""
        human, robot = self.scene.human_settings.radius, self.scene.robot_settings
        people = [person for person in self.people.values() if person.name != name]
        if name is None:
            return [Disc(person.x, person.y, robot.radius + human + robot.keep_distance) for person in people]
        x, y, _ = self.robot.pose
        others = (Disc(person.x, person.y, 2 * human + APART) for person in people)
        return [Disc(x, y, human + robot.radius + APART), *others]

    @property
    def _apart(self) -> float:
        return self.scene.human_settings.radius + self.scene.robot_settings.radius + APART

    def _post(self, ways: Navigator) -> tuple[float, float, float]:
        """Where the robot begins when nobody says so: where it sees most, facing the middle of the room."""
        middle = self.scene.middle
        place = vantage(self.physics, self.sensor, ways, middle)
        return *place, bearing(place, middle)

    def _start(
        self, ways: Navigator, robot: Point, rng: np.random.Generator, given: tuple[float, ...] | None
    ) -> tuple[float, float, float]:
        """Where somebody begins: as asked, as the scene says, or anywhere on the floor away from the others."""
        if given is not None:
            if not ways.free((given[0], given[1])):
                raise DomainError(f"nobody can start at ({given[0]:g}, {given[1]:g}): it is not on the free floor")
            return given[0], given[1], given[2] if len(given) > 2 else float(rng.uniform(-math.pi, math.pi))
        xs, ys = zip(*self.scene.walkable)
        others = [human.place for human in self.people.values()]
        for _ in range(MOST_TRIED):
            x, y = float(rng.uniform(min(xs), max(xs))), float(rng.uniform(min(ys), max(ys)))
            if ways.free((x, y)) and all(math.dist((x, y), other) > 2 * self._apart for other in (robot, *others)):
                return x, y, float(rng.uniform(-math.pi, math.pi))
        raise DomainError("the floor has no room for everybody: make room_size(SizeX, SizeY) larger, or move furniture")
