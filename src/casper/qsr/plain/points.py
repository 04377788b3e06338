"""Distances between points, and QDC: which band a distance falls into.

Source: QSRlib's ``argd`` (absolute argument distance; Hernandez, Clementini and Di Felice 1995 for the bands).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

Point = Sequence[float]
"""Metres: (x, y), or (x, y, z)."""
Band = tuple[str, float]
BANDS: tuple[Band, ...] = (("touch", 0.6), ("near", 2.0), ("medium", 3.0), ("far", 5.0), ("ignore", math.inf))
"""The paper's: labels with their upper ends in metres."""

LARGEST = 1e150
"""Metres beyond which squares would overflow: such coordinates are refused."""


def distance(one: Point, other: Point) -> float:
    """Metres in the plane."""
    dx, dy = other[0] - one[0], other[1] - one[1]
    return math.sqrt(dx * dx + dy * dy)


def distance_in_space(one: Point, other: Point) -> float:
    """Metres in space."""
    dx, dy, dz = other[0] - one[0], other[1] - one[1], other[2] - one[2]
    return math.sqrt(dx * dx + dy * dy + dz * dz)


def qdc(metres: float, bands: Sequence[Band], before: str | None = None, margin: float = 0.0) -> str:
    """The first label whose threshold is at least ``metres``; upper ends are closed.

    Beyond the last threshold the last label. With a ``margin`` (metres) the label ``before`` is kept while
    the distance is within its band widened by the margin on both sides (hysteresis).
    """
    if margin > 0.0 and before is not None and _within(metres, bands, before, margin):
        return before
    for label, threshold in bands:
        if metres <= threshold:
            return label
    return bands[-1][0]


def _within(metres: float, bands: Sequence[Band], label: str, margin: float) -> bool:
    lower = 0.0
    for name, upper in bands:
        if name == label:
            return lower - margin < metres <= upper + margin
        lower = upper
    return False


def relative_distance(near: float, far: float, tolerance: float = 0.0) -> str:
    """Whether the first of two distances (metres) is ``closer``, ``same`` or ``farther`` than the second.

    Distances that differ by no more than the tolerance are the same.
    """
    difference = near - far
    if difference > tolerance:
        return "farther"
    return "closer" if difference < -tolerance else "same"
