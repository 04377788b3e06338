"""QDC and relative distances on arrays (`casper.qsr.plain.points`)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from casper.qsr.arrays.hysteresis import kept
from casper.qsr.arrays.scene import Array


def qdc(metres: Array, ends: Sequence[float], margin: float, before: Array, defined: Array | None) -> Array:
    """The number of the band of each distance; with a margin, of the band before while that is left by less.

    defined: where there is a distance at all; None: everywhere.
    """
    plain = np.zeros(metres.shape, dtype=np.int8)
    for end in ends[:-1]:
        plain += metres > end
    if margin <= 0.0:
        return plain
    if defined is not None:
        plain[~defined] = -1
    lower = (0.0, *ends[:-1])
    return kept(
        plain, np.stack([(low - margin < metres) & (metres <= end + margin) for low, end in zip(lower, ends)]), before
    )


def relative_distance(near: Array, far: Array, tolerance: float) -> Array:
    """0 closer, 1 same, 2 farther."""
    difference = near - far
    return 1 + (difference > tolerance).astype(np.int8) - (difference < -tolerance)
