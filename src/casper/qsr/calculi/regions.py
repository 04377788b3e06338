"""Relations of boxes: rectangle and block algebra, RCC8 and what is derived from it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

from casper.qsr.calculi.calculus import Moment, Plain, at_least_nothing, require
from casper.qsr.plain.regions import ALLEN, COARSER, Interval, intervals, rcc8, rectangle

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene


def _boxes(moment: Moment, axes: int) -> list[tuple[Interval, ...]]:
    boxes = []
    for body in moment.now:
        assert body.size is not None
        boxes.append(intervals(body[:axes], body.size[:axes]))  # type: ignore[arg-type]
    return boxes


@dataclass(frozen=True)
class Rectangle(Plain):
    """Rectangle algebra: Allen's relation along x, then along y, joined by a comma. tolerance: metres of one border."""

    tolerance: float = 0.0
    name: str = "rectangle"
    arity = 2
    motion = False
    needs: tuple[str, ...] = ("size",)
    remembers = False
    axes = 2

    def __post_init__(self) -> None:
        at_least_nothing("the tolerance of rectangle algebra", self.tolerance)

    @property
    def labels(self) -> tuple[str, ...]:
        """Every pair (for blocks, triple) of Allen's relations."""
        return tuple(",".join(relations) for relations in product(ALLEN, repeat=self.axes))

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.regions import by_axis
        from casper.qsr.arrays.regions import rectangle as on_arrays

        return on_arrays(by_axis(scene, self.axes, self.tolerance))

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        one, other = _boxes(moment, self.axes)
        return rectangle(one, other, self.tolerance)


@dataclass(frozen=True)
class Block(Rectangle):
    """Block algebra: Allen's relation along x, y and z."""

    name: str = "block"
    needs: tuple[str, ...] = ("size", "z")
    axes = 3


@dataclass(frozen=True)
class Rcc(Plain):
    """The region connection calculus of boxes: RCC8, or what is derived from it: RCC5, RCC4, RCC3, RCC2.

    axes: 2 in the plane, 3 in space. tolerance: metres of one border.
    """

    kind: int = 8
    axes: int = 2
    tolerance: float = 0.0
    arity = 2
    motion = False
    remembers = False

    def __post_init__(self) -> None:
        require(self.kind in COARSER, f"there are RCC8, RCC5, RCC4, RCC3 and RCC2, not RCC{self.kind}")
        require(self.axes in (2, 3), f"boxes have 2 or 3 axes, not {self.axes}")
        at_least_nothing("the tolerance of RCC", self.tolerance)

    @property
    def name(self) -> str:
        """``rcc8`` and so on."""
        return f"rcc{self.kind}"

    @property
    def needs(self) -> tuple[str, ...]:
        """A size, and in space a height."""
        return ("size",) if self.axes == 2 else ("size", "z")

    @property
    def labels(self) -> tuple[str, ...]:
        """Without repetition, in the order of RCC8."""
        return tuple(dict.fromkeys(COARSER[self.kind].values()))

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.regions import by_axis, coarsened
        from casper.qsr.arrays.regions import rcc8 as on_arrays

        return coarsened(on_arrays(by_axis(scene, self.axes, self.tolerance)), self.kind, self.labels)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        one, other = _boxes(moment, self.axes)
        return COARSER[self.kind][rcc8(one, other, self.tolerance)]
