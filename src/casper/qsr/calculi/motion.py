"""Who moves (MOS) and how two things move to each other (QTC_B, QTC_C, QTC_BC)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import sqrt
from typing import TYPE_CHECKING, Any

from casper.qsr.calculi.calculus import Body, Moment, Names, Plain, Step, require
from casper.qsr.plain.motion import approach_by_distance, approach_by_projection, moving, qtc, sideways
from casper.qsr.plain.points import Point, distance, distance_in_space
from casper.qsr.thresholds import NONE, PAPER, Threshold

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene

VARIANTS = {"projection": approach_by_projection, "distance": approach_by_distance}


def points(bodies: tuple[Body, ...], heights: bool) -> tuple[Point, ...]:
    """The places of things, in space where heights count and all have one."""
    if heights and all(body[2] is not None for body in bodies):
        return tuple(body[:3] for body in bodies)  # type: ignore[misc]
    return tuple(body[:2] for body in bodies)


@dataclass(frozen=True)
class Mos(Plain):
    """Moving or stationary: moving is strictly more displacement in a step than the threshold.

    margin: by how much more or less before the label is given up (hysteresis). heights: whether rising is moving.
    """

    threshold: Threshold = PAPER
    margin: Threshold = NONE
    heights: bool = False
    name: str = "mos"
    arity = 1
    motion = True
    needs = ()
    labels = ("stationary", "moving")

    @property
    def remembers(self) -> bool:
        """With a margin."""
        return bool(self.margin.per_step(1.0) > 0.0)

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.motion import displacement
        from casper.qsr.arrays.motion import moving as on_arrays

        limit, margin = (given.per_step(scene.frames.dt) for given in (self.threshold, self.margin))
        return on_arrays(displacement(scene, self.heights), limit, margin, before, scene.moved)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        assert moment.was is not None
        was, now = points((moment.was[0], moment.now[0]), self.heights)
        metres = distance_in_space(was, now) if len(was) == 3 else distance(was, now)
        limit, margin = self.threshold.per_step(moment.dt), self.margin.per_step(moment.dt)
        moves = moving(metres, limit, None if before is None else before == "moving", margin)
        return "moving" if moves else "stationary"

    @property
    def quick(self) -> bool:
        """In the plane without a margin."""
        return not self.remembers and not self.heights

    def many(self, step: Step, before: Mapping[Names, str]) -> Sequence[str | None]:
        """See `Calculus.many`: in the plane without a margin in one loop."""
        if not self.quick:
            return super().many(step, before)
        rows, now, was, dt = step
        limit = self.threshold.per_step(dt)
        told: list[str | None] = []
        for row in rows:
            name = row[0]
            if name in was:
                body, earlier = now[name], was[name]
                dx, dy = body[0] - earlier[0], body[1] - earlier[1]
                told.append("moving" if sqrt(dx * dx + dy * dy) > limit else "stationary")
            else:
                told.append(None)
        return told


class _Symbols(Plain):
    """What the variants of QTC share: rows of symbols, each towards or left, neither, or away or right."""

    threshold: Threshold
    variant: str
    margin: Threshold
    heights: bool
    how_many = 2

    def __post_init__(self) -> None:
        require(self.variant in VARIANTS, f"qtc is projection or distance, not {self.variant}")

    @property
    def labels(self) -> tuple[str, ...]:
        """Every row of symbols; the last symbol changes fastest."""
        return tuple("".join(symbols) for symbols in product("-0+", repeat=self.how_many))

    @property
    def remembers(self) -> bool:
        """With a margin."""
        return bool(self.margin.per_step(1.0) > 0.0)

    def symbols(self, scene: Scene, before: Array) -> list[Array]:
        """The codes of each symbol: of k's and l's approach, then of their sides."""
        from casper.qsr.arrays.motion import approach, symbols
        from casper.qsr.arrays.motion import sideways as across

        limit, margin = (given.per_step(scene.frames.dt) for given in (self.threshold, self.margin))
        told = []
        for place in range(self.how_many):
            member = place % 2
            metres = approach(scene, member, self.variant, self.heights) if place < 2 else across(scene, member)
            earlier = before if not self.remembers else _digit(before, place, self.how_many)
            told.append(symbols(metres, limit, margin, earlier, scene.moved))
        return told

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        first, *others = self.symbols(scene, before)
        codes = first
        for symbol in others:
            codes = codes * codes.dtype.type(3) + symbol
        return codes

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        assert moment.was is not None
        limit, margin = self.threshold.per_step(moment.dt), self.margin.per_step(moment.dt)
        k, other, k_was, other_was = points((*moment.now, *moment.was), self.heights)
        pairs = ((k_was, k, other_was), (other_was, other, k_was)) * 2
        label = ""
        for place in range(self.how_many):
            metres = VARIANTS[self.variant](*pairs[place]) if place < 2 else sideways(*pairs[place])
            label += qtc(metres, limit, before[place] if before is not None else None, margin)
        return label


def _digit(codes: Array, place: int, how_many: int) -> Any:
    """One symbol of rows of symbols; -1 stays -1."""
    return codes // 3 ** (how_many - 1 - place) % 3 * (codes >= 0) - (codes < 0)


@dataclass(frozen=True)
class QtcB(_Symbols):
    """QTC_B, basic: k's symbol towards l, then l's towards k: ``-`` towards, ``+`` away, ``0`` neither.

    threshold: metres a step, or metres a second, up to which there is no motion. variant: ``projection`` on the line
    between the two (QSRlib's), or ``distance``, as in the textbook. margin: hysteresis. heights: in space.
    """

    threshold: Threshold = PAPER
    variant: str = "projection"
    margin: Threshold = NONE
    heights: bool = False
    name: str = "qtc_b"
    arity = 2
    motion = True
    needs = ()

    @property
    def quick(self) -> bool:
        """Projections in the plane without a margin."""
        return not self.remembers and not self.heights and self.variant == "projection" and self.how_many <= 2

    def many(self, step: Step, before: Mapping[Names, str]) -> Sequence[str | None]:
        """See `Calculus.many`: projections in the plane without a margin in one loop."""
        if not self.quick:
            return super().many(step, before)
        rows, now, was, dt = step
        limit, both = self.threshold.per_step(dt), self.how_many == 2
        told: list[str | None] = []
        for row in rows:
            k, other = row
            if k not in was or other not in was:
                told.append(None)
                continue
            k_was, other_was, k_now = was[k], was[other], now[k]
            kx, ky = k_was[0], k_was[1]
            dx, dy = other_was[0] - kx, other_was[1] - ky
            length = sqrt(dx * dx + dy * dy)
            if length == 0.0:
                told.append("00" if both else "0")
                continue
            along = ((k_now[0] - kx) * dx + (k_now[1] - ky) * dy) / length
            symbol = "-" if along > limit else "+" if along < -limit else "0"
            if both:
                moved = now[other]
                along = ((other_was[0] - moved[0]) * dx + (other_was[1] - moved[1]) * dy) / length
                symbol += "-" if along > limit else "+" if along < -limit else "0"
            told.append(symbol)
        return told


@dataclass(frozen=True)
class QtcB11(QtcB):
    """The first symbol of QTC_B only, as the paper uses it: the other's own motion does not enter."""

    name: str = "qtc_b11"
    how_many = 1


@dataclass(frozen=True)
class QtcC(QtcB):
    """QTC_C, double cross: QTC_B's symbols, then on which side of the line each goes: ``-`` left, ``+`` right."""

    name: str = "qtc_c"
    how_many = 4


@dataclass(frozen=True)
class QtcBC(QtcC):
    """QTC_C between two that are within some metres of each other now, QTC_B beyond (Dondrup et al. 2014)."""

    name: str = "qtc_bc"
    within: float = 1.22

    def __post_init__(self) -> None:
        super().__post_init__()
        require(not self.remembers, "QTC_BC has no margin: its symbols come and go; take QTC_B or QTC_C with one")

    @property
    def labels(self) -> tuple[str, ...]:
        """QTC_C's, then QTC_B's."""
        return (*super().labels, *("".join(symbols) for symbols in product("-0+", repeat=2)))

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        import numpy as np

        from casper.qsr.arrays.motion import approach, symbols
        from casper.qsr.arrays.motion import sideways as across

        limit, margin = (given.per_step(scene.frames.dt) for given in (self.threshold, self.margin))
        metres = [approach(scene, member, self.variant, self.heights) for member in (0, 1)]
        metres += [across(scene, member) for member in (0, 1)]
        k, other, k_side, other_side = (symbols(m, limit, margin, before, None).astype(np.int16) for m in metres)
        near = scene.distance[:, 1:] <= self.within
        return np.asarray(np.where(near, ((k * 3 + other) * 3 + k_side) * 3 + other_side, 81 + k * 3 + other))

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        label = super().one(moment, None)
        k, other = points(tuple(moment.now), False)
        return label if distance(k, other) <= self.within else label[:2]
