"""How the simulated human walks: to objects, round furniture and round the robot, turning smoothly."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from itertools import pairwise

from casper.sim_adapter.human.body import HumanBody
from casper.sim_adapter.room.geometry import Disc, bearing, in_the_way, turn
from casper.sim_adapter.room.navigation import CELL, Navigator, is_square, length, square_on
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import Ticks

RINGS = (0.5, 0.45, 0.4, 0.35, 0.3, 0.25, 0.56, 0.57, 0.58)
REACHABLE = 0.6  # 2-D distance at which an object can still be handled: the touch band
ACCELERATION = 2.0
TURNING_SHARE = 0.5  # share of the walking speed kept while turning
TRIED = 6  # goals for which a way is sought


class HumanWalk:
    """Walks a body over the floor. ``others`` gives the discs of those to keep away from."""

    def __init__(self, body: HumanBody, navigator: Navigator, others: Callable[[], Sequence[Disc]]) -> None:
        self.body = body
        self.navigator = navigator
        self.others = others
        self.held_up = 0.0  # seconds they have been waiting for a way
        self.goals: list[Point] = []  # where they want to be, whoever stands there

    def go_to(self, name: str) -> Ticks:
        """Walk to where an object can be reached, unless it is within reach already, and face it."""
        yield from self._go_near(lambda: self.body.at(name))

    def go_near(self, point: Point) -> Ticks:
        """As `go_to`, to a point on the furniture."""
        yield from self._go_near(lambda: point)

    def _go_near(self, at: Callable[[], Point]) -> Ticks:
        body = self.body
        rings = (body.settings.stand_distance, *RINGS)
        well = is_square(body.physics.scene, at(), body.place)
        if not well or math.dist(body.place, at()) > REACHABLE:
            yield from self._travel(lambda others: self._standing(at(), rings, others))
        yield from self._face(at())

    def _standing(self, at: Point, rings: Sequence[float], others: Sequence[Disc]) -> list[Point]:
        points = self.navigator.standing_points(at, rings, others)
        return square_on(self.body.physics.scene, at, points)

    def step_back(self) -> Ticks:
        """Half a metre or more away from what it faces, as far as there is room."""
        body = self.body
        for away in (0.8, 0.7, 0.6, 0.5):
            for side in (0.0, 0.5, -0.5, 1.0, -1.0):
                angle = body.heading + math.pi + side
                goal = (body.x + away * math.cos(angle), body.y + away * math.sin(angle))
                if self.navigator.straight(body.place, goal, self.others()):
                    yield from self._walk([body.place, goal])
                    return

    def stand_aside(self) -> Ticks:
        """Go to the nearest free spot away from every object and from the others; stay where none is free."""
        things = [at[:2] for at in self.body.physics.positions().values()]
        others = [Disc(disc.x, disc.y, disc.radius + 0.5) for disc in self.others()]
        spots = [(CELL * column, CELL * row) for column, row in self.navigator.graph]
        spots.sort(key=lambda spot: math.dist(spot, self.body.place))
        for apart in (1.1, 0.9, 0.7):
            for spot in spots:
                if all(math.dist(spot, thing) >= apart for thing in things) and self._can_reach(spot, others):
                    yield from self._travel(lambda others: [spot])  # noqa: B023 - left right after
                    return

    def make_way(self, spot: Point) -> Ticks:
        """Go to a spot where somebody else has a way."""
        yield from self._travel(lambda others: [spot])

    def _can_reach(self, spot: Point, others: Sequence[Disc]) -> bool:
        free = self.navigator.free(spot, others)
        return free and self.navigator.path(self.body.place, spot, self.others()) is not None

    def _travel(self, goals: Callable[[Sequence[Disc]], list[Point]]) -> Ticks:
        """Walk to the nearest of the goals, those free of some discs; wait and look again while the way is blocked."""
        self.held_up = 0.0
        while True:
            free = goals(self.others())
            self.goals = free or goals(())
            path = self._best_path(free)
            if path is not None and (yield from self._walk(path)):
                self.held_up = 0.0
                return
            self.held_up += 0.5
            for _ in range(self.body.ticks(0.5)):
                self.body.stand("still" if self.body.holding is None else "place")
                yield

    def _best_path(self, goals: list[Point]) -> list[Point] | None:
        near = sorted(goals, key=lambda goal: math.dist(self.body.place, goal))[:TRIED]
        paths = (self.navigator.path(self.body.place, goal, self.others()) for goal in near)
        return min((path for path in paths if path is not None), key=length, default=None)

    def _walk(self, path: Sequence[Point]) -> Generator[None, None, bool]:
        """Follow a path; False when somebody stands in the way."""
        body = self.body
        for _, corner in pairwise(path):
            while math.dist(body.place, corner) > 0.02:
                if in_the_way(body.place, corner, self.others()):
                    body.speed = 0.0
                    return False
                body.movement = "walk" if body.holding is None else "transport"
                self._stride(corner, math.dist(body.place, corner) if corner == path[-1] else math.inf)
                yield
        body.speed = 0.0
        return True

    def _stride(self, corner: Point, left: float) -> None:
        """One control step towards a corner, ``left`` metres before the end of the path."""
        body = self.body
        wanted = bearing(body.place, corner)
        body.turn_to(wanted)
        off = abs(turn(wanted - body.heading))
        fast = body.settings.walk_speed * max(TURNING_SHARE, math.cos(off))
        fast = min(fast, math.sqrt(2 * ACCELERATION * left) + 0.05)
        change = ACCELERATION * body.dt
        body.speed = max(body.speed - 2 * change, min(body.speed + change, fast))
        step = min(body.speed * body.dt, math.dist(body.place, corner))
        body.x += step * math.cos(wanted)
        body.y += step * math.sin(wanted)
        body.relax_hand()

    def _face(self, point: Point) -> Ticks:
        body = self.body
        while abs(turn(bearing(body.place, point) - body.heading)) > 0.02:
            body.turn_to(bearing(body.place, point))
            body.stand(body.on_the_spot)
            yield
