"""Where an object goes when it is put at a place, and whether it is there: inside, on top, or beside."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from casper.sim_adapter.room.scene import WALL, Point, Scene, Thing

Spot = tuple[float, float, float]
GAP = 0.03  # between an object and what it is put beside
MARGIN = 0.01
RIM_SLACK = 0.004
PILE = 0.1  # what lies on something else that is there, this high, is there too


def inner_floor(place: Thing, at: Spot) -> float:
    """Height things rest at inside or on top of a place whose body is at ``at``."""
    if place.shape == "basin":
        return at[2] - place.height
    if place.shape == "panel":
        return at[2] + place.height
    if place.shape == "dish":
        return at[2] - place.height / 2 + WALL
    return at[2] + place.height / 2


def place_spot(scene: Scene, where: Mapping[str, Spot], target: str, destination: str, near: Point) -> Spot:
    """Where the middle of ``target`` belongs when put at ``destination``; ``where`` has the present positions.

    The spot nearest the middle that is free of other objects, and of those that are equally near the one that the agent
    at ``near`` reaches best (beside: to the side, as that agent sees it); when nothing is free, the middle, on top of
    what lies there.
    """
    thing, place, at = scene.thing(target), scene.thing(destination), where[destination]
    others = _others(scene, where, target, destination)
    if place.placing == "beside":
        return _beside(scene, thing, place, at, others, near)
    floor = inner_floor(place, at)
    for x, y in _offsets(at, near):
        if _fits(thing, place, (x - at[0], y - at[1])) and _clear(thing, (x, y), others):
            return x, y, floor + thing.height / 2
    below = [z + o.height / 2 for o, (x, y, z) in others if math.dist((x, y), at[:2]) < thing.radius + o.radius]
    return at[0], at[1], max(below, default=floor) + thing.height / 2


def is_placed(scene: Scene, where: Mapping[str, Spot], target: str, destination: str, *, inside: bool = False) -> bool:
    """Whether ``target`` is at ``destination`` the way things are put there (or ``inside`` whatever way that is)."""
    if target not in where or destination not in where or target == destination:
        return False
    thing, place = scene.thing(target), scene.thing(destination)
    (x, y, z), at = where[target], where[destination]
    bottom = z - thing.height / 2
    if place.placing == "beside" and not inside:
        gap = math.dist((x, y), at[:2]) - thing.radius - place.radius
        return gap < 2 * GAP and abs(bottom - (at[2] - place.height / 2)) < 0.03
    floor = inner_floor(place, at)
    depth = place.height if place.shape == "basin" else PILE
    return _within(place, (x - at[0], y - at[1])) and floor - 0.02 < bottom < floor + depth


def _others(scene: Scene, where: Mapping[str, Spot], target: str, destination: str) -> list[tuple[Thing, Spot]]:
    """What is in the way: movables but the two concerned and what lies on the target."""
    here, radius = where[target], scene.thing(target).radius
    others = []
    for name in scene.movables:
        if name in (target, destination) or name not in where:
            continue
        spot = where[name]
        if math.dist(spot[:2], here[:2]) < radius and spot[2] > here[2]:
            continue
        others.append((scene.thing(name), spot))
    return others


def _clear(thing: Thing, spot: Point, others: list[tuple[Thing, Spot]]) -> bool:
    return all(math.dist(spot, at[:2]) >= thing.radius + o.radius + MARGIN for o, at in others)


def _offsets(at: Spot, near: Point) -> Iterator[Point]:
    """Ring after ring round the middle; of each ring first what is nearest to who is to reach it."""
    yield at[0], at[1]
    for ring in range(1, 11):
        turns = ((0.02 * ring, math.pi * eighth / 4) for eighth in range(8))
        points = [(at[0] + reach * math.cos(angle), at[1] + reach * math.sin(angle)) for reach, angle in turns]
        yield from sorted(points, key=lambda point: round(math.dist(point, near), 3))


def _fits(thing: Thing, place: Thing, offset: Point) -> bool:
    """Whether the whole footprint lies within the inside (or top) of the place."""
    if place.shape in ("dish", "cylinder"):
        inner = place.radius - (WALL if place.shape == "dish" else 0.0) - RIM_SLACK
        return math.hypot(*offset) + thing.radius <= inner or offset == (0.0, 0.0)
    return all(abs(o) + thing.radius <= side / 2 - RIM_SLACK for o, side in zip(offset, place.size))


def _within(place: Thing, offset: Point) -> bool:
    if place.shape in ("dish", "cylinder"):
        return math.hypot(*offset) < place.radius
    return all(abs(o) < side / 2 for o, side in zip(offset, place.size))


def _beside(scene: Scene, thing: Thing, place: Thing, at: Spot, others: list[tuple[Thing, Spot]], near: Point) -> Spot:
    """Right beside a place on the same furniture; to the side, where it stands in nobody's way to the place."""
    reach = thing.radius + place.radius + GAP
    bottom = at[2] - place.height / 2
    angles = [math.pi * sixteenth / 8 for sixteenth in range(16)]
    points = [(at[0] + reach * math.cos(a), at[1] + reach * math.sin(a)) for a in angles]
    points.sort(key=lambda point: abs(math.dist(point, near) - math.dist(at[:2], near)))
    good = [p for p in points if _stands(scene, thing, p, bottom) and _clear(thing, p, others)]
    x, y = (good or points)[0]
    return x, y, bottom + thing.height / 2


def _stands(scene: Scene, thing: Thing, spot: Point, bottom: float) -> bool:
    margin = thing.radius + MARGIN
    return any(abs(p.surface - bottom) < 0.02 and p.holds(*spot, margin) for p in scene.furniture)
