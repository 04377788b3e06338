"""The things that are related, as arrays of things by steps; what several calculi need of them is worked out once.

Column 0 is the step before the first: what is told is told of the columns after it, so that a long trace may be cut
anywhere (`casper.qsr.batch`) and a stream may be two columns wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


@dataclass(frozen=True)
class Frames:
    """What is known of all things at some steps; every array is things by steps, NaN where a thing is absent.

    where: metres along x, y and, where there are heights, z. dt: seconds of each step, for the columns from 1.
    present: None when everything always is. sizes: full extents along each axis. held: the index of the thing in
    the hand, -1 for none.
    """

    where: tuple[Array, ...]
    dt: Array
    present: Array | None = None
    heading: Array | None = None
    sizes: tuple[Array, ...] | None = None
    held: Array | None = None
    steady: Array | None = None
    """Which steps are short enough for motion to be taken across them; None: all."""


@dataclass
class Scene:
    """Some tuples of things of some frames: ``of`` has an array of indices for each place of the tuple."""

    frames: Frames
    of: tuple[Array, ...]
    _taken: dict[tuple[int, int], Array] = field(default_factory=dict)

    def axis(self, member: int, axis: int) -> Array:
        """Metres of the members at one place of the tuples, tuples by all columns; one row if it is always the same."""
        key = (member, axis)
        if key not in self._taken:
            self._taken[key] = rows_of(self.frames.where[axis], self.of[member])
        return self._taken[key]

    @cached_property
    def offsets(self) -> tuple[Array, ...]:
        """Metres from the first member to the second, along each axis, at all columns."""
        return tuple(flat(self.axis(1, axis) - self.axis(0, axis), axis) for axis in range(len(self.frames.where)))

    @cached_property
    def distance(self) -> Array:
        """Metres in the plane between the first two members, at all columns."""
        dx, dy = self.offsets[:2]
        return np.sqrt(_squares(dx, dy))

    @cached_property
    def distance_in_space(self) -> Array:
        """The same in space."""
        return np.sqrt(_squares(*self.offsets)) if len(self.offsets) == 3 else self.distance

    def shift(self, member: int, axis: int) -> Array:
        """Metres that the members at one place went along an axis in each step, for the columns from 1."""
        places = self.axis(member, axis)
        return flat(places[:, 1:] - places[:, :-1], axis)

    @cached_property
    def present(self) -> Array | None:
        """Where all members are there, at all columns; None: everywhere."""
        if self.frames.present is None:
            return None
        there = rows_of(self.frames.present, self.of[0])
        for indices in self.of[1:]:
            there = there & rows_of(self.frames.present, indices)
        return np.broadcast_to(there, (len(self.of[0]), there.shape[1]))

    @cached_property
    def moved(self) -> Array | None:
        """Where motion is defined, at the columns from 1: all members are there, and were a step before."""
        there = None if self.present is None else self.present[:, 1:] & self.present[:, :-1]
        steady = self.frames.steady
        if steady is None or steady.all():
            return there
        return np.broadcast_to(steady, (len(self.of[0]), len(steady))) if there is None else there & steady

    def told(self, codes: Array, motion: bool) -> Array:
        """The codes, -1 where a member is missing, or for motion was missing a step before."""
        defined = self.moved if motion else (None if self.present is None else self.present[:, 1:])
        if codes.shape[0] != len(self.of[0]):
            codes = np.broadcast_to(codes, (len(self.of[0]), codes.shape[1]))
        return codes if defined is None else np.where(defined, codes, codes.dtype.type(-1))


def flat(metres: Array, axis: int) -> Array:
    """Differences of heights are 0 where one of the two has none: they are related in the plane then."""
    return np.nan_to_num(metres, copy=False, nan=0.0) if axis == 2 else metres


def _squares(*offsets: Array) -> Array:
    total = offsets[0] * offsets[0]
    for offset in offsets[1:]:
        total += offset * offset
    return total


def rows_of(array: Array, indices: Array) -> Array:
    """Rows of an array: views where the indices are one, or in a row, else a copy."""
    first, last = int(indices[0]), int(indices[-1])
    if (indices == first).all():
        return array[first : first + 1]
    if last - first == len(indices) - 1 and (np.diff(indices) == 1).all():
        return array[first : last + 1]
    return array[indices]


def pairs_array(tuples: Sequence[Sequence[int]]) -> tuple[Array, ...]:
    """Tuples of indices as one array for each place."""
    return tuple(np.asarray(column, dtype=np.intp) for column in zip(*tuples, strict=True))
