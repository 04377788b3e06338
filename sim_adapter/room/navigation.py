"""Paths on the walkable floor: grid A* (networkx), then string pulling; and where to stand to reach something."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import networkx as nx

from casper.sim_adapter.room.geometry import Disc, Floor, point_to_segment
from casper.sim_adapter.room.scene import Point, Scene

CELL = 0.1
SQUARE = 0.05  # metres one may stand to the side of what is in a cabinet
Cell = tuple[int, int]


class Navigator:
    """Finds ways for a round body of one radius. The grid is built once; other agents are discs to avoid."""

    def __init__(self, floor: Floor, radius: float) -> None:
        self.floor = floor
        self.radius = radius
        self.graph = _grid(floor, radius)

    def free(self, point: Point, avoid: Sequence[Disc] = ()) -> bool:
        """Whether the body fits at a point."""
        return self.floor.free(point, self.radius) and not any(_within(disc, point) for disc in avoid)

    def straight(self, start: Point, end: Point, avoid: Sequence[Disc] = ()) -> bool:
        """Whether the body can go straight from one point to the other."""
        if any(point_to_segment((disc.x, disc.y), (start, end)) < disc.radius for disc in avoid):
            return False
        return self.floor.straight(start, end, self.radius)

    def path(self, start: Point, goal: Point, avoid: Sequence[Disc] = ()) -> list[Point] | None:
        """Corner points of a free way from start to goal, both included; None when there is none.

        A start that touches a border or a disc (something came too close) may be left, never a goal entered.
        """
        if not self.free(goal, avoid):
            return None
        if self.straight(start, goal, avoid):
            return [start, goal]
        first, last = self._entry(start, avoid), self._entry(goal, avoid)
        if first is None or last is None:
            return None
        cells = self._search(first, last, avoid)
        if cells is None:
            return None
        return self._pull([start, *(_centre(cell) for cell in cells), goal], avoid)

    def standing_points(self, target: Point, rings: Sequence[float], avoid: Sequence[Disc] = ()) -> list[Point]:
        """Free points round a target, those of the first ring (distance, metres) that has any; may be empty."""
        for ring in rings:
            angles = (math.radians(degrees) for degrees in range(0, 360, 5))
            points = [(target[0] + ring * math.cos(a), target[1] + ring * math.sin(a)) for a in angles]
            free = [point for point in points if self.free(point, avoid)]
            if free:
                return free
        return []

    def _entry(self, point: Point, avoid: Sequence[Disc]) -> Cell | None:
        """The nearest grid cell a point can be joined to the grid by."""
        column, row = round(point[0] / CELL), round(point[1] / CELL)
        near = [(column + i, row + j) for i in range(-4, 5) for j in range(-4, 5)]
        cells = [cell for cell in near if cell in self.graph and not _blocked(cell, avoid)]
        cells.sort(key=lambda cell: math.dist(_centre(cell), point))
        squeeze = min(self.radius, self.floor.clearance(point)) - 1e-6
        for cell in cells:
            if self.floor.straight(point, _centre(cell), squeeze):
                return cell
        return None

    def _search(self, first: Cell, last: Cell, avoid: Sequence[Disc]) -> list[Cell] | None:
        blocked = {cell for cell in self.graph if _blocked(cell, avoid)} if avoid else set()

        def weight(_: Cell, to: Cell, edge: dict[str, float]) -> float | None:
            return None if to in blocked else edge["length"]

        def ahead(a: Cell, b: Cell) -> float:
            return CELL * math.dist(a, b)

        try:
            cells: list[Cell] = nx.astar_path(self.graph, first, last, heuristic=ahead, weight=weight)
        except nx.NetworkXNoPath:
            return None
        return cells

    def _pull(self, points: list[Point], avoid: Sequence[Disc]) -> list[Point]:
        """Drop every corner that can be cut."""
        pulled, at = [points[0]], 0
        while at < len(points) - 1:
            reach = len(points) - 1
            while reach > at + 1 and not self.straight(points[at], points[reach], avoid):
                reach -= 1
            pulled.append(points[reach])
            at = reach
        return pulled


def is_square(scene: Scene, at: Point, point: Point) -> bool:
    """Whether one stands well for what is at ``at``: if it is in a cabinet, before the opening and off its walls."""
    cabinet = next((p for p in scene.furniture if p.kind == "cabinet" and p.holds(*at)), None)
    if cabinet is None:
        return True
    axis = 1 if cabinet.opens in ("west", "east") else 0
    return abs(point[axis] - at[axis]) <= SQUARE


def square_on(scene: Scene, at: Point, points: Sequence[Point]) -> list[Point]:
    """Those of some standing points that are square on, or all when none is."""
    return [point for point in points if is_square(scene, at, point)] or list(points)


def length(path: Sequence[Point]) -> float:
    """Length of a path, metres."""
    return sum(math.dist(a, b) for a, b in pairwise(path))


@lru_cache(maxsize=8)
def _grid(floor: Floor, radius: float) -> nx.Graph:
    """Free cells, joined to those of their eight neighbours that can be reached straight. Never changed."""
    graph = nx.Graph()
    columns = [round(x / CELL) for x, _ in floor.polygon]
    rows = [round(y / CELL) for _, y in floor.polygon]
    for column in range(min(columns), max(columns) + 1):
        for row in range(min(rows), max(rows) + 1):
            centre = _centre((column, row))
            if floor.free(centre, radius):
                graph.add_node((column, row), roomy=floor.clearance(centre) > radius + 1.5 * CELL)
    for column, row in list(graph):
        for step in ((1, 0), (0, 1), (1, 1), (1, -1)):
            here, there = (column, row), (column + step[0], row + step[1])
            if there not in graph:
                continue
            if graph.nodes[here]["roomy"] or floor.straight(_centre(here), _centre(there), radius):
                graph.add_edge(here, there, length=CELL * math.dist(here, there))
    return graph


def _centre(cell: Cell) -> Point:
    return cell[0] * CELL, cell[1] * CELL


def _within(disc: Disc, point: Point) -> bool:
    return math.dist((disc.x, disc.y), point) < disc.radius


def _blocked(cell: Cell, avoid: Sequence[Disc]) -> bool:
    centre = _centre(cell)
    return any(_within(disc, centre) for disc in avoid)
