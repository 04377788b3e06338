"""Allen's relations, rectangle algebra and RCC on arrays (`casper.qsr.plain.regions`)."""

from __future__ import annotations

import numpy as np

from casper.qsr.arrays.scene import Array, Scene, rows_of
from casper.qsr.plain.regions import COARSER, RCC8

_INNER = np.array(((2, 7, 8), (3, 6, 9), (4, 5, 10)), dtype=np.int8)


def _signs(difference: Array, tolerance: float) -> Array:
    return (difference > tolerance).astype(np.int8) - (difference < -tolerance)


def allen(starts: Array, ends: Array, other_starts: Array, other_ends: Array, tolerance: float = 0.0) -> Array:
    """Codes of `casper.qsr.plain.regions.ALLEN` of intervals, element by element."""
    first, last = _signs(ends - other_starts, tolerance), _signs(starts - other_ends, tolerance)
    begins, stops = _signs(starts - other_starts, tolerance), _signs(ends - other_ends, tolerance)
    codes = _INNER[begins + 1, stops + 1]
    codes = np.where(last >= 0, np.where(last == 0, 11, 12), codes)
    return np.asarray(np.where(first <= 0, np.where(first == 0, 1, 0), codes).astype(np.int8))


def by_axis(scene: Scene, axes: int, tolerance: float) -> list[Array]:
    """Allen's relation of the boxes of the first two members along each axis, for the columns from 1."""
    assert scene.frames.sizes is not None
    told = []
    for axis in range(axes):
        ends = []
        for member in (0, 1):
            centre = scene.axis(member, axis)[:, 1:]
            half = rows_of(scene.frames.sizes[axis], scene.of[member])[:, 1:] / 2.0
            ends += [centre - half, centre + half]
        starts, stops, other_starts, other_stops = np.broadcast_arrays(*ends)
        told.append(allen(starts, stops, other_starts, other_stops, tolerance))
    return told


def rectangle(relations: list[Array]) -> Array:
    """The codes of all axes in one number, the first axis first."""
    codes = relations[0].astype(np.int16)
    for relation in relations[1:]:
        codes = codes * 13 + relation
    return codes


_OUTSIDE = np.isin(np.arange(13), (0, 12))
_TOUCHING = np.isin(np.arange(13), (1, 11))
_WITHIN = np.isin(np.arange(13), (3, 4, 5, 6))
_AROUND = np.isin(np.arange(13), (6, 7, 8, 9))


def rcc8(relations: list[Array]) -> Array:
    """Codes of `RCC8` from Allen's relation along each axis."""
    stacked = np.stack(relations)
    codes = np.full(stacked.shape[1:], RCC8.index("po"), dtype=np.int8)
    for holds, name in (
        (_WITHIN[stacked].all(axis=0), "tpp"),
        ((stacked == 4).all(axis=0), "ntpp"),
        (_AROUND[stacked].all(axis=0), "tppi"),
        ((stacked == 8).all(axis=0), "ntppi"),
        ((stacked == 6).all(axis=0), "eq"),
        (_TOUCHING[stacked].any(axis=0), "ec"),
        (_OUTSIDE[stacked].any(axis=0), "dc"),
    ):
        codes[holds] = RCC8.index(name)
    return codes


def coarsened(codes: Array, kind: int, labels: tuple[str, ...]) -> Array:
    """RCC8's codes as those of a coarser calculus with these labels."""
    table = np.array([labels.index(COARSER[kind][name]) for name in RCC8], dtype=np.int8)
    return table[codes]
