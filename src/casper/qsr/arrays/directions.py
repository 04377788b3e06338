"""Directions and TPCC on arrays (`casper.qsr.plain.directions`)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from casper.qsr.arrays.scene import Array, Scene, rows_of
from casper.qsr.plain.directions import TAN, TPCC

_PLACE = {name: place for place, name in enumerate(TPCC)}


def _eighths(dx: Array, dy: Array, here: Array, straight_ahead: Array, straight_across: Array) -> Array:
    north, east = dy > 0.0, dx > 0.0
    slanted = np.where(east, np.where(north, 1, 3), np.where(north, 7, 5))
    told = np.where(straight_across, np.where(east, 2, 6), slanted)
    told = np.where(straight_ahead, np.where(north, 0, 4), told)
    return np.asarray(np.where(here, 8, told).astype(np.int8))


def cone(dx: Array, dy: Array, tolerance: float) -> Array:
    """Eighths clockwise from 0 straight ahead, 8 within the tolerance."""
    across, along = np.abs(dx), np.abs(dy)
    here = (across <= tolerance) & (along <= tolerance)
    return _eighths(dx, dy, here, across <= TAN * along, along <= TAN * across)


def projection(dx: Array, dy: Array, tolerance: float) -> Array:
    """The same by comparing coordinates."""
    in_line, abreast = np.abs(dx) <= tolerance, np.abs(dy) <= tolerance
    return _eighths(dx, dy, in_line & abreast, in_line, abreast)


_cos = np.frompyfunc(math.cos, 1, 1)
_sin = np.frompyfunc(math.sin, 1, 1)
"""Not numpy's own, which round differently from one machine to the next."""


def ahead_and_right(dx: Array, dy: Array, heading: Array) -> tuple[Array, Array]:
    """Displacements in the frame of one who looks along a heading (radians): metres right, ahead."""
    c, s = (np.asarray(each(heading), dtype=np.float64) for each in (_cos, _sin))
    return dx * s - dy * c, dx * c + dy * s


def headings(scene: Scene, member: int) -> Array:
    """Radians, for the columns from 1; absent ones are 0."""
    assert scene.frames.heading is not None
    return np.nan_to_num(rows_of(scene.frames.heading, scene.of[member])[:, 1:])


def _codes(names: str, prefix: str) -> Array:
    return np.array([_PLACE[prefix + name] for name in names.split()], dtype=np.int8)


_NAMES = "bl lb lf fl br rb rf fr sb sl sf sr"
_BY_REACH = np.stack([_codes(_NAMES, "c"), _codes(_NAMES, "d")])


def tpcc(scene: Scene, tolerance: float) -> Array:
    """Codes of `TPCC` for (origin, relatum, referent)."""

    def between(one: int, other: int) -> tuple[Any, Any]:
        return tuple(scene.axis(other, a)[:, 1:] - scene.axis(one, a)[:, 1:] for a in (0, 1))  # type: ignore[return-value]

    (ax, ay), (bx, by) = between(0, 1), between(1, 2)
    base, reach = np.sqrt(ax * ax + ay * ay), np.sqrt(bx * bx + by * by)
    with np.errstate(divide="ignore", invalid="ignore"):
        beyond, left = (ax * bx + ay * by) / base, (ax * by - ay * bx) / base
    back, to_left = beyond > 0.0, left > 0.0
    steep = np.abs(left) > np.abs(beyond)
    sector = np.where(back, steep, 3 - steep.astype(np.int8)) + np.where(to_left, 0, 4)
    sector = np.where(np.abs(beyond) <= tolerance, np.where(to_left, 9, 11), sector)
    sector = np.where(np.abs(left) <= tolerance, np.where(back, 8, 10), sector)
    codes = _BY_REACH[(reach >= base).astype(np.intp), sector]
    codes = np.where(reach <= tolerance, _PLACE["sam"], codes)
    no_base = np.where(reach <= tolerance, _PLACE["tri"], _PLACE["dou"])
    return np.asarray(np.where(base <= tolerance, no_base, codes).astype(np.int8))
