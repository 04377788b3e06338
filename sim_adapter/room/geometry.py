"""Plane geometry of the walkable floor: what is inside, how far from the edge, which straight walk is free."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from casper.sim_adapter.room.scene import Point, Scene

Edge = tuple[Point, Point]
GRAZE = 0.03  # metres a planned way may graze a disc that has moved a little since
SLACK = 1e-9  # so that touching a border exactly is not a collision


@dataclass(frozen=True, slots=True)
class Disc:
    """Something round to keep away from: another agent."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True, slots=True)
class Floor:
    """The walkable polygon less rectangular holes; ``edges`` are all borders."""

    polygon: tuple[Point, ...]
    holes: tuple[tuple[float, float, float, float], ...]
    edges: tuple[Edge, ...]

    def free(self, point: Point, radius: float) -> bool:
        """Whether a round body of that radius fits here."""
        if not inside(self.polygon, point) or any(_in_hole(hole, point) for hole in self.holes):
            return False
        return self.clearance(point) >= radius - SLACK

    def clearance(self, point: Point) -> float:
        """Distance to the nearest border (from either side), metres."""
        return min(point_to_segment(point, edge) for edge in self.edges)

    def straight(self, start: Point, end: Point, radius: float) -> bool:
        """Whether a round body can go straight from one point to the other."""
        if not self.free(start, radius) or not self.free(end, radius):
            return False
        return all(segment_distance((start, end), edge) >= radius - SLACK for edge in self.edges)


def floor_of(scene: Scene) -> Floor:
    """The floor of a scene."""
    corners = scene.walkable
    edges = list(zip(corners, corners[1:] + corners[:1]))
    for min_x, min_y, max_x, max_y in scene.holes:
        square = ((min_x, min_y), (max_x, min_y), (max_x, max_y), (min_x, max_y))
        edges.extend(zip(square, square[1:] + square[:1]))
    return Floor(corners, scene.holes, tuple(edges))


def inside(polygon: Sequence[Point], point: Point) -> bool:
    """Even-odd rule; a point exactly on the border may count as either."""
    x, y = point
    within = False
    for (x1, y1), (x2, y2) in zip(polygon, (*polygon[1:], polygon[0])):
        if (y1 > y) != (y2 > y) and x < (x2 - x1) * (y - y1) / (y2 - y1) + x1:
            within = not within
    return within


def point_to_segment(point: Point, segment: Edge) -> float:
    """Distance of a point to a segment."""
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    if length == 0.0:
        return math.dist(point, (ax, ay))
    along = max(0.0, min(1.0, ((point[0] - ax) * dx + (point[1] - ay) * dy) / length))
    return math.hypot(point[0] - ax - along * dx, point[1] - ay - along * dy)


def segment_distance(one: Edge, other: Edge) -> float:
    """Distance between two segments; 0 where they cross."""
    if _cross(one, other):
        return 0.0
    return min(
        point_to_segment(one[0], other),
        point_to_segment(one[1], other),
        point_to_segment(other[0], one),
        point_to_segment(other[1], one),
    )


def in_the_way(here: Point, corner: Point, discs: Sequence[Disc], ahead: float = 0.5) -> bool:
    """Whether going on towards a corner soon enters a disc, or goes deeper into one it is in."""
    gap = math.dist(here, corner)
    share = min(1.0, ahead / gap) if gap > 0 else 0.0
    soon = (here[0] + share * (corner[0] - here[0]), here[1] + share * (corner[1] - here[1]))
    for disc in discs:
        centre = (disc.x, disc.y)
        nearest = point_to_segment(centre, (here, soon))
        if nearest < disc.radius - GRAZE and nearest < math.dist(here, centre) - 1e-3:
            return True
    return False


def turn(angle: float) -> float:
    """The same angle within ±π."""
    return math.remainder(angle, 2 * math.pi)


def bearing(start: Point, end: Point) -> float:
    """Direction from one point to another, radians, 0 = +x, counter-clockwise."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def _in_hole(hole: tuple[float, float, float, float], point: Point) -> bool:
    return hole[0] < point[0] < hole[2] and hole[1] < point[1] < hole[3]


def _side(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _cross(one: Edge, other: Edge) -> bool:
    first = _side(*one, other[0]) * _side(*one, other[1])
    second = _side(*other, one[0]) * _side(*other, one[1])
    return first < 0 and second < 0
