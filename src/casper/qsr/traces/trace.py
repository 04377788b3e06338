"""A trace: named things at growing times, each of which may be absent at some of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Array
from casper.qsr.plain.points import LARGEST
from casper.qsr.traces.checking import check_names, check_times, first_place, shown


@dataclass(frozen=True, eq=False)
class Trace:
    """Things at some times; made by `Trace.of`, or read by `casper.qsr.traces.reading`.

    Every array is things by steps. t: seconds, growing. where: metres along x, y and perhaps z; NaN where a thing is
    absent (z also where it has no height). present: None when everything always is. heading: radians, NaN where there
    is none. sizes: full extents along each axis. held: the index of what is in the hand, -1 for nothing.
    """

    t: Array
    names: tuple[str, ...]
    where: tuple[Array, ...]
    present: Array | None = None
    heading: Array | None = None
    sizes: tuple[Array, ...] | None = None
    held: Array | None = None

    @staticmethod
    def of(
        t: ArrayLike,
        names: Sequence[str],
        places: ArrayLike,
        *,
        present: ArrayLike | None = None,
        headings: ArrayLike | None = None,
        sizes: ArrayLike | None = None,
        holding: Sequence[Sequence[str | None]] | None = None,
    ) -> Trace:
        """A trace from arrays whose first axis is time.

        Args:
            t: (T,) seconds, growing.
            names: of the N things, each once.
            places: (T, N, 2) or (T, N, 3) metres; a NaN third coordinate is a thing without a height.
            present: (T, N) truth values; where false a thing is absent and its numbers do not matter. None: never.
            headings: (T, N) radians, NaN for what has none.
            sizes: (T, N, D) or (N, D) full extents of boxes, NaN for what has none.
            holding: for each step, for each thing, the name of what is in its hand, or None.

        Raises:
            TraceError: shapes that do not fit, a name that is there twice, times that do not grow, or a coordinate of a
                present thing that is no usable number; the sentence names the thing and the time.
        """
        times, known = check_times(t), check_names(names)
        if holding is not None:
            known = check_names(dict.fromkeys((*known, *(h for row in holding for h in row if h is not None))))
        shape, full = (len(times), len(names)), (len(times), len(known))
        cube = _cube(places, shape, "places", (2, 3))
        there = _there(present, shape, full)
        where = tuple(_grown(cube[:, :, axis], full) for axis in range(cube.shape[2]))
        _check_places(where, times, known, there)
        held = None if holding is None else _held(holding, known, shape, full)
        return Trace(
            times, known, where, there, _headings(headings, times, known, full), _sizes(sizes, shape, full), held
        )

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<Trace of {shown(self.names)}, {len(self)} steps>"

    def index(self, name: str) -> int:
        """The row of a thing.

        Raises:
            TraceError: it is not in the trace.
        """
        if name not in self.names:
            raise TraceError(f"{name} is not in the trace; it has {shown(self.names)}")
        return self.names.index(name)


def _cube(given: ArrayLike, shape: tuple[int, int], what: str, widths: tuple[int, ...]) -> Array:
    cube = np.asarray(given, dtype=np.float64)
    if cube.ndim != 3 or cube.shape[:2] != shape or cube.shape[2] not in widths:
        wanted = " or ".join(str((*shape, width)) for width in widths)
        raise TraceError(f"{what} should have the shape {wanted} (steps, things, axes), not {cube.shape}")
    return cube


def _grown(columns: Array, full: tuple[int, int]) -> Array:
    """Things by steps; things that are only held have a row of NaN."""
    rows = np.full((full[1], full[0]), np.nan) if columns.shape[1] != full[1] else np.empty((full[1], full[0]))
    rows[: columns.shape[1]] = columns.T
    return rows


def _there(present: ArrayLike | None, shape: tuple[int, int], full: tuple[int, int]) -> Array | None:
    if present is None and shape == full:
        return None
    there = np.zeros((full[1], full[0]), dtype=bool)
    given = np.ones(shape, dtype=bool) if present is None else np.asarray(present, dtype=bool)
    if given.shape != shape:
        raise TraceError(f"present should have the shape {shape} (steps, things), not {given.shape}")
    there[: shape[1]] = given.T
    return None if there.all() else there


def _check_places(where: tuple[Array, ...], t: Array, names: Sequence[str], there: Array | None) -> None:
    """Blank what is absent; refuse what is present and has no usable place."""
    for axis, (rows, letter) in enumerate(zip(where, "xyz")):
        if there is not None:
            rows[~there] = np.nan
        usable = np.abs(rows) < LARGEST
        if axis == 2:
            usable |= np.isnan(rows)
        if not (usable.all() if there is None else (usable | ~there).all()):
            i, at = first_place(~usable if there is None else ~usable & there)
            raise TraceError(
                f"{names[i]} has {rows[i, at]:g} as its {letter} at t={t[at]:g}; coordinates are finite numbers"
            )
    if len(where) == 3:
        has = ~np.isnan(where[2])
        some = has.any(axis=1) & (~has if there is None else ~has & there).any(axis=1)
        if some.any():
            raise TraceError(f"{names[int(np.flatnonzero(some)[0])]} has a height at some steps and none at others")


def _headings(given: ArrayLike | None, t: Array, names: Sequence[str], full: tuple[int, int]) -> Array | None:
    if given is None:
        return None
    rows = np.asarray(given, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[0] != full[0] or rows.shape[1] > full[1]:
        raise TraceError(f"headings should have the shape {full} (steps, things), not {rows.shape}")
    grown = _grown(rows, full)
    if np.isinf(grown).any():
        i, at = first_place(np.isinf(grown))
        raise TraceError(f"{names[i]} has an infinite heading at t={t[at]:g}")
    return grown


def _sizes(given: ArrayLike | None, shape: tuple[int, int], full: tuple[int, int]) -> tuple[Array, ...] | None:
    if given is None:
        return None
    cube = np.asarray(given, dtype=np.float64)
    if cube.ndim == 2:
        cube = np.broadcast_to(cube, (shape[0], *cube.shape))
    cube = _cube(cube, shape, "sizes", (2, 3))
    return tuple(_grown(cube[:, :, axis], full) for axis in range(cube.shape[2]))


def _held(
    holding: Sequence[Sequence[Any]], names: Sequence[str], shape: tuple[int, int], full: tuple[int, int]
) -> Array:
    place = {name: i for i, name in enumerate(names)}
    if len(holding) != shape[0] or any(len(row) != shape[1] for row in holding):
        raise TraceError(f"holding should have a row for each of {shape[0]} steps, with {shape[1]} names or None")
    held = np.full((full[1], full[0]), -1, dtype=np.int32)
    for at, row in enumerate(holding):
        for i, name in enumerate(row):
            if name is not None:
                held[i, at] = place[name]
    return held
