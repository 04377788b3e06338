"""Where one point lies as seen from another: cardinal directions, egocentric directions, TPCC.

Sources: Frank 1991 and Ligozat 1998 (cones and projections), Moratz and Ragni 2008 (TPCC). No arc functions: sectors
are told apart by comparing coordinates, so that both kernels agree to the bit.
"""

from __future__ import annotations

import math

from casper.qsr.plain.points import Point

TAN = math.tan(math.pi / 8.0)
"""A sector of an eighth reaches 22.5° to either side."""
COMPASS = ("n", "ne", "e", "se", "s", "sw", "w", "nw")
CARDINAL = (*COMPASS, "eq")
EGOCENTRIC = ("front", "front_right", "right", "back_right", "back", "back_left", "left", "front_left", "here")


def cone(dx: float, dy: float, tolerance: float = 0.0) -> int:
    """Which eighth a displacement (metres, y ahead or north) points to, clockwise from 0; 8 within the tolerance.

    The four main directions own their edges, so that mirroring and quarter turns map directions to directions.
    """
    across, along = abs(dx), abs(dy)
    if across <= tolerance and along <= tolerance:
        return 8
    if across <= TAN * along:
        return 0 if dy > 0.0 else 4
    if along <= TAN * across:
        return 2 if dx > 0.0 else 6
    return (1 if dy > 0.0 else 3) if dx > 0.0 else (7 if dy > 0.0 else 5)


def projection(dx: float, dy: float, tolerance: float = 0.0) -> int:
    """The same by comparing coordinates: north is straight north (within the tolerance), all between is north-east."""
    if abs(dx) <= tolerance:
        return 8 if abs(dy) <= tolerance else (0 if dy > 0.0 else 4)
    if abs(dy) <= tolerance:
        return 2 if dx > 0.0 else 6
    return (1 if dy > 0.0 else 3) if dx > 0.0 else (7 if dy > 0.0 else 5)


def ahead_and_right(dx: float, dy: float, heading: float) -> tuple[float, float]:
    """A displacement in the frame of one who looks along ``heading`` (radians, 0 = +x): metres right, ahead."""
    c, s = math.cos(heading), math.sin(heading)
    return dx * s - dy * c, dx * c + dy * s


_LEFT = ("bl", "lb", "lf", "fl")
_RIGHT = ("br", "rb", "rf", "fr")
_SECTORS = ("sb", *_LEFT[:2], "sl", *_LEFT[2:], "sf", *_RIGHT[:2], "sr", *_RIGHT[2:])
TPCC = ("dou", "tri", "sam", *("c" + name for name in _SECTORS), *("d" + name for name in _SECTORS))
"""27 relations: the three where points coincide, then close and distant in 12 directions as seen from the relatum."""


def tpcc(origin: Point, relatum: Point, referent: Point, tolerance: float = 0.0) -> str:
    """Where the referent lies for one who looks from the origin to the relatum.

    ``d`` or ``c``: not nearer to the relatum than the origin is, or nearer. Then the sector, seen from the relatum:
    back (beyond it), left, front (towards the origin), right; ``s`` straight, within the tolerance (metres off the
    line). ``sam``: the referent is the relatum; ``dou``: origin and relatum coincide, ``tri``: all three do.
    """
    ax, ay = relatum[0] - origin[0], relatum[1] - origin[1]
    bx, by = referent[0] - relatum[0], referent[1] - relatum[1]
    base, reach = math.sqrt(ax * ax + ay * ay), math.sqrt(bx * bx + by * by)
    if base <= tolerance:
        return "tri" if reach <= tolerance else "dou"
    if reach <= tolerance:
        return "sam"
    beyond, left = (ax * bx + ay * by) / base, (ax * by - ay * bx) / base
    return ("c" if reach < base else "d") + _sector(beyond, left, tolerance)


def _sector(beyond: float, left: float, tolerance: float) -> str:
    if abs(left) <= tolerance:
        return "sb" if beyond > 0.0 else "sf"
    if abs(beyond) <= tolerance:
        return "sl" if left > 0.0 else "sr"
    quarter = 0 if beyond > 0.0 else 2
    names = _LEFT if left > 0.0 else _RIGHT
    steep = abs(left) > abs(beyond)
    return names[quarter + (1 if steep == (beyond > 0.0) else 0)]
