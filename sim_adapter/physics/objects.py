"""The objects of interest: movable ones as free bodies, fixed ones as part of the room."""

from __future__ import annotations

import math
from typing import Any

from casper.sim_adapter.physics.parts import FIXED_BITS, MOVABLE_BITS, THINGS, add_geom, rgba
from casper.sim_adapter.room.scene import WALL, Scene, Thing

RIM_SEGMENTS = 16


def add_things(spec: Any, scene: Scene) -> None:
    """One body an object, named like it; a movable's origin is its middle, a fixed one's its position."""
    for thing in scene.things.values():
        body = spec.worldbody.add_body(name=thing.name)
        body.pos = [thing.x, thing.y, start_height(scene, thing)]
        if thing.movable:
            body.add_freejoint(name=thing.name)
        {
            "box": _add_block,
            "cylinder": _add_cylinder,
            "dish": _add_dish,
            "basin": _add_basin,
            "panel": _add_panel,
        }[thing.shape](body, thing)


def start_height(scene: Scene, thing: Thing) -> float:
    """Height of the body's origin at the start: a movable stands on the highest board below its position."""
    if not thing.movable:
        return thing.z
    boards = [p.surface for p in scene.furniture if p.holds(thing.x, thing.y) and p.surface <= thing.z + 0.02]
    return max(boards, default=0.0) + thing.height / 2


def _colour(thing: Thing) -> list[float]:
    return rgba(*thing.colour)


def _add_block(body: Any, thing: Thing) -> None:
    size = [side / 2 for side in thing.size]
    add_geom(body, "box", size, colour=_colour(thing), group=THINGS, bits=MOVABLE_BITS, mass=thing.mass)


def _add_cylinder(body: Any, thing: Thing) -> None:
    size = (thing.size[0] / 2, thing.size[2] / 2)
    add_geom(body, "cylinder", size, colour=_colour(thing), group=THINGS, bits=MOVABLE_BITS, mass=thing.mass)


def _add_dish(body: Any, thing: Thing) -> None:
    """A floor disc, which carries nearly all the mass, and a rim of short boards."""
    radius, height, colour = thing.size[0] / 2, thing.size[2], _colour(thing)
    disc = (radius, WALL / 2)
    low = (0.0, 0.0, (WALL - height) / 2)
    add_geom(body, "cylinder", disc, low, colour=colour, group=THINGS, bits=MOVABLE_BITS, mass=thing.mass)
    ring = radius - WALL / 2
    half_length = ring * math.tan(math.pi / RIM_SEGMENTS)
    for segment in range(RIM_SEGMENTS):
        angle = 2 * math.pi * segment / RIM_SEGMENTS
        pos = (ring * math.cos(angle), ring * math.sin(angle), WALL / 2)
        quat = (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))
        size = (WALL / 2, half_length, (height - WALL) / 2)
        add_geom(body, "box", size, pos, colour=colour, group=THINGS, bits=MOVABLE_BITS, mass=0.001, quat=quat)


def _add_basin(body: Any, thing: Thing) -> None:
    half_x, half_y, depth = thing.size[0] / 2, thing.size[1] / 2, thing.size[2]
    wall, colour = 0.005, _colour(thing)
    plates = (
        ((half_x + 2 * wall, half_y + 2 * wall, wall), (0.0, 0.0, -depth - wall)),
        ((wall, half_y + 2 * wall, depth / 2), (-half_x - wall, 0.0, -depth / 2)),
        ((wall, half_y + 2 * wall, depth / 2), (half_x + wall, 0.0, -depth / 2)),
        ((half_x, wall, depth / 2), (0.0, -half_y - wall, -depth / 2)),
        ((half_x, wall, depth / 2), (0.0, half_y + wall, -depth / 2)),
    )
    for size, pos in plates:
        add_geom(body, "box", size, pos, colour=colour, group=THINGS, bits=FIXED_BITS)


def _add_panel(body: Any, thing: Thing) -> None:
    size = (thing.size[0] / 2, thing.size[1] / 2, thing.size[2] / 2)
    pos = (0.0, 0.0, thing.size[2] / 2)
    add_geom(body, "box", size, pos, colour=_colour(thing), group=THINGS, bits=FIXED_BITS)
