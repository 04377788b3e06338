"""The room: floor, walls, counters (with cut-outs for basins), tables, cabinets."""

from __future__ import annotations

import math
from typing import Any

import mujoco

from casper.sim_adapter.physics.parts import FIXED_BITS, FLOOR, FURNITURE, WALLS, add_geom, rgba
from casper.sim_adapter.room.scene import Furniture, Scene, Thing

WALL_HEIGHT = 2.4
BOARD = 0.03
Rect = tuple[float, float, float, float]


def furniture_name(name: str) -> str:
    """Name of the body of a piece of furniture."""
    return f"furniture:{name}"


def add_room(spec: Any, scene: Scene) -> None:
    """Floor, light, walls and furniture as bodies fixed to the world, one body for each piece."""
    world = spec.worldbody
    add_geom(world, "plane", (30, 30, 1), colour=rgba(0.78, 0.74, 0.68), group=FLOOR, bits=FIXED_BITS)
    light = world.add_light(pos=[0, -1, 4], dir=[0, 0, -1])
    light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    light.diffuse = [0.35, 0.35, 0.35]
    light.castshadow = False
    walls = world.add_body(name="walls")
    for start, end in zip(scene.outline, scene.outline[1:] + scene.outline[:1]):
        _add_wall(walls, start, end)
    for piece in scene.furniture:
        body = world.add_body(name=furniture_name(piece.name))
        {"counter": _add_counter, "table": _add_table, "cabinet": _add_cabinet}[piece.kind](body, piece, scene)


def _add_wall(body: Any, start: tuple[float, float], end: tuple[float, float]) -> None:
    length = math.dist(start, end)
    yaw = math.atan2(end[1] - start[1], end[0] - start[0])
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, WALL_HEIGHT / 2)
    quat = (math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2))
    size = (length / 2, 0.01, WALL_HEIGHT / 2)
    add_geom(body, "box", size, middle, colour=rgba(0.9, 0.88, 0.84), group=WALLS, bits=FIXED_BITS, quat=quat)


def _add_box(body: Any, rect: Rect, bottom: float, top: float, colour: list[float]) -> None:
    left, front, right, back = rect
    size = ((right - left) / 2, (back - front) / 2, (top - bottom) / 2)
    pos = ((left + right) / 2, (front + back) / 2, (top + bottom) / 2)
    add_geom(body, "box", size, pos, colour=colour, group=FURNITURE, bits=FIXED_BITS)


def _rect(piece: Furniture) -> Rect:
    half_x, half_y = piece.size_x / 2, piece.size_y / 2
    return piece.x - half_x, piece.y - half_y, piece.x + half_x, piece.y + half_y


def _add_counter(body: Any, piece: Furniture, scene: Scene) -> None:
    colour = rgba(0.72, 0.62, 0.5)
    basin = next((t for t in scene.things.values() if t.shape == "basin" and piece.holds(t.x, t.y)), None)
    if basin is None:
        _add_box(body, _rect(piece), 0.0, piece.top, colour)
        return
    _add_cut_counter(body, piece, basin, colour)


def _add_cut_counter(body: Any, piece: Furniture, basin: Thing, colour: list[float]) -> None:
    """A counter with a hole: a lower block, and four blocks round the basin."""
    left, front, right, back = _rect(piece)
    wall = 0.01
    half_x, half_y = basin.size[0] / 2 + wall, basin.size[1] / 2 + wall
    in_left, in_right = max(left, basin.x - half_x), min(right, basin.x + half_x)
    in_front, in_back = max(front, basin.y - half_y), min(back, basin.y + half_y)
    floor = basin.z - basin.size[2] - wall
    _add_box(body, (left, front, right, back), 0.0, floor, colour)
    blocks: tuple[Rect, ...] = (
        (left, front, right, in_front),
        (left, in_back, right, back),
        (left, in_front, in_left, in_back),
        (in_right, in_front, right, in_back),
    )
    for block in blocks:
        if block[2] - block[0] > 1e-6 and block[3] - block[1] > 1e-6:
            _add_box(body, block, floor, piece.top, colour)


def _add_table(body: Any, piece: Furniture, scene: Scene) -> None:
    colour = rgba(0.55, 0.38, 0.24)
    left, front, right, back = _rect(piece)
    _add_box(body, (left, front, right, back), piece.top - BOARD, piece.top, colour)
    leg = 0.05
    for x in (left, right - leg):
        for y in (front, back - leg):
            _add_box(body, (x, y, x + leg, y + leg), 0.0, piece.top - BOARD, colour)


def _add_cabinet(body: Any, piece: Furniture, scene: Scene) -> None:
    """An open-fronted box: side walls, top and bottom; the board things stand on is a body of its own."""
    colour = rgba(0.88, 0.9, 0.92)
    left, front, right, back = _rect(piece)
    sides: dict[str, Rect] = {
        "west": (left, front, left + BOARD, back),
        "east": (right - BOARD, front, right, back),
        "south": (left, front, right, front + BOARD),
        "north": (left, back - BOARD, right, back),
    }
    for side, rect in sides.items():
        if side != piece.opens:
            _add_box(body, rect, 0.0, piece.top, colour)
    _add_box(body, (left, front, right, back), piece.top - BOARD, piece.top, colour)
    _add_box(body, (left, front, right, back), 0.0, 0.1, colour)
    _add_box(body, (left, front, right, back), piece.surface - BOARD, piece.surface, colour)
