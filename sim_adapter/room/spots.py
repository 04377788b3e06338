"""Where a thing can be set down beside the places that plans know: free spots on the furniture, within reach."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

from casper.sim_adapter.room.geometry import Floor, floor_of
from casper.sim_adapter.room.navigation import Navigator
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Furniture, Point, Scene

GRID = 0.1  # metres between two spots that are looked at
EDGE = 0.04  # metres a thing stays off the edge
APART = (0.65, 0.45, 0.3)  # metres to the objects of interest: the most that leaves any spot
NEAR = 0.52  # metres from a spot within which everybody must be able to stand


def free_spots(scene: Scene, thing: str) -> list[Spot]:
    """Where the middle of a thing may be put: on a counter or a table, away from every object, in everybody's reach.

    Args:
        scene: the room as it is at the start.
        thing: what is to be put there; its own place counts as free.

    Returns a list that is empty where the furniture leaves no room.
    """
    floor, radius = floor_of(scene), max(scene.robot_settings.radius, scene.human_settings.radius)
    others = [(o.x, o.y) for name, o in scene.things.items() if name != thing]
    own = scene.thing(thing)
    found = [spot for piece in scene.furniture for spot in _on(piece, own.radius + EDGE, own.height)]
    for apart in APART:
        wide = [s for s in found if all(math.dist(s[:2], other) >= apart for other in others)]
        reachable = [spot for spot in wide if _in_reach(floor, radius, spot[:2])]
        if reachable:
            return [spot for spot in reachable if math.dist(spot[:2], (own.x, own.y)) >= apart] or reachable
    return []


@lru_cache(maxsize=10_000)
def _in_reach(floor: Floor, radius: float, point: Point) -> bool:
    """Whether a body of that radius can stand near a point."""
    return bool(Navigator(floor, radius).standing_points(point, (NEAR, NEAR - 0.05)))


def _on(piece: Furniture, margin: float, height: float) -> Iterator[Spot]:
    """Spots on what is open above, on a grid."""
    if piece.kind == "cabinet":
        return
    across, along = piece.size_x / 2 - margin, piece.size_y / 2 - margin
    for column in range(-int(across / GRID), int(across / GRID) + 1) if across >= 0 else ():
        for row in range(-int(along / GRID), int(along / GRID) + 1) if along >= 0 else ():
            yield piece.x + GRID * column, piece.y + GRID * row, piece.top + height / 2
