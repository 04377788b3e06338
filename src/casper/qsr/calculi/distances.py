"""QDC, the absolute distance of two things, and the relative distance of three."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from typing import TYPE_CHECKING

from casper.qsr.calculi.calculus import Body, Moment, Names, Plain, Step, at_least_nothing, require
from casper.qsr.plain.points import BANDS, Band, distance, distance_in_space, qdc, relative_distance

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene


def metres_between(one: Body, other: Body, heights: bool = True) -> float:
    """The distance of two things, in space where both have a height and heights count."""
    if heights and one[2] is not None and other[2] is not None:
        return distance_in_space(one[:3], other[:3])  # type: ignore[arg-type]
    return distance(one, other)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Qdc(Plain):
    """Qualitative distance: the first band whose end is not exceeded; upper ends are closed.

    bands: labels with their upper ends in metres, growing; beyond the last the last label holds. margin: metres by
    which a band must be left before its label is given up (hysteresis). heights: in space where both things have a
    height.
    """

    bands: tuple[Band, ...] = BANDS
    margin: float = 0.0
    heights: bool = True
    name: str = "qdc"
    arity = 2
    motion = False
    needs = ()

    def __post_init__(self) -> None:
        ends = [end for _, end in self.bands]
        grows = all(low < high for low, high in pairwise(ends)) and all(end == end for end in ends)
        require(bool(ends) and grows, "QDC bands need ends that grow from band to band")
        require(len(set(self.labels)) == len(ends), "a QDC band is named twice")
        at_least_nothing("the margin of QDC", self.margin)

    @property
    def labels(self) -> tuple[str, ...]:
        """The bands, from the nearest."""
        return tuple(label for label, _ in self.bands)

    @property
    def remembers(self) -> bool:
        """With a margin."""
        return self.margin > 0.0

    @property
    def quick(self) -> bool:
        """Without a margin."""
        return not self.remembers

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.points import qdc as on_arrays

        metres = (scene.distance_in_space if self.heights else scene.distance)[:, 1:]
        defined = None if scene.present is None else scene.present[:, 1:]
        return on_arrays(metres, [end for _, end in self.bands], self.margin, before, defined)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        one, other = moment.now
        return qdc(metres_between(one, other, self.heights), self.bands, before, self.margin)

    def many(self, step: Step, before: Mapping[Names, str]) -> Sequence[str | None]:
        """See `Calculus.many`: without a margin by bisection of the ends."""
        if not self.quick:
            return super().many(step, before)
        told, now, heights = [], step.now, self.heights
        ends, labels = tuple(end for _, end in self.bands[:-1]), self.labels
        for row in step.rows:
            a, b = now[row[0]], now[row[1]]
            dx, dy = b[0] - a[0], b[1] - a[1]
            squares = dx * dx + dy * dy
            if heights and a[2] is not None and b[2] is not None:
                dz = b[2] - a[2]
                squares += dz * dz
            told.append(labels[bisect_left(ends, sqrt(squares))])
        return told


@dataclass(frozen=True)
class RelativeDistance(Plain):
    """Of (a, b, c): whether a is ``closer`` to b than to c, ``farther``, or the ``same`` within the tolerance
    (metres)."""

    tolerance: float = 0.0
    heights: bool = True
    name: str = "relative_distance"
    arity = 3
    motion = False
    needs = ()
    labels = ("closer", "same", "farther")
    remembers = False

    def __post_init__(self) -> None:
        at_least_nothing("the tolerance of relative distances", self.tolerance)

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.points import relative_distance as on_arrays
        from casper.qsr.arrays.scene import Scene as Pairs

        near, far = (Pairs(scene.frames, (scene.of[0], scene.of[member])) for member in (1, 2))
        metres = [(pair.distance_in_space if self.heights else pair.distance)[:, 1:] for pair in (near, far)]
        return on_arrays(metres[0], metres[1], self.tolerance)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        one, near, far = moment.now
        lengths = [metres_between(one, other, self.heights) for other in (near, far)]
        return relative_distance(lengths[0], lengths[1], self.tolerance)
