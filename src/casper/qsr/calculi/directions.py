"""Cardinal directions, directions as seen by one who looks somewhere, and TPCC."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from casper.qsr.calculi.calculus import Moment, Plain, at_least_nothing, require
from casper.qsr.plain.directions import CARDINAL, EGOCENTRIC, TPCC, ahead_and_right, cone, projection, tpcc

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene

MODELS = {"cone": cone, "projection": projection}


@dataclass(frozen=True)
class Cardinal(Plain):
    """Cardinal direction: (a, b) is ``n`` when a is north of b (+y); ``eq`` in one place.

    model: ``cone``, eight sectors of 45° (QSRlib's ``cardir``), or ``projection``, where ``n`` is straight north and
    all between is ``ne`` (its composition is exact). tolerance: metres up to which coordinates are the same.
    """

    model: str = "cone"
    tolerance: float = 0.0
    name: str = "cardinal"
    arity = 2
    motion = False
    needs = ()
    labels = CARDINAL
    remembers = False

    def __post_init__(self) -> None:
        require(self.model in MODELS, f"cardinal directions are by cone or projection, not {self.model}")
        at_least_nothing("the tolerance of cardinal directions", self.tolerance)

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays import directions

        dx, dy = (-offset[:, 1:] for offset in scene.offsets[:2])
        on_arrays = directions.cone if self.model == "cone" else directions.projection
        return on_arrays(dx, dy, self.tolerance)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        a, b = moment.now
        return CARDINAL[MODELS[self.model](a.x - b.x, a.y - b.y, self.tolerance)]


@dataclass(frozen=True)
class Egocentric(Plain):
    """Where b is for a, by a's heading: ``front``, ``front_right`` … eight sectors of 45°; ``here`` in one place."""

    tolerance: float = 0.0
    name: str = "egocentric"
    arity = 2
    motion = False
    needs = ("heading",)
    labels = EGOCENTRIC
    remembers = False

    def __post_init__(self) -> None:
        at_least_nothing("the tolerance of egocentric directions", self.tolerance)

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays import directions

        dx, dy = (offset[:, 1:] for offset in scene.offsets[:2])
        right, ahead = directions.ahead_and_right(dx, dy, directions.headings(scene, 0))
        return directions.cone(right, ahead, self.tolerance)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        a, b = moment.now
        right, ahead = ahead_and_right(b.x - a.x, b.y - a.y, a.heading or 0.0)
        return EGOCENTRIC[cone(right, ahead, self.tolerance)]


@dataclass(frozen=True)
class Tpcc(Plain):
    """Ternary point configuration: where the third lies for one who looks from the first to the second.

    tolerance: metres up to which points are one, and off a line up to which they are on it.
    """

    tolerance: float = 0.0
    name: str = "tpcc"
    arity = 3
    motion = False
    needs = ()
    labels = TPCC
    remembers = False

    def __post_init__(self) -> None:
        at_least_nothing("the tolerance of TPCC", self.tolerance)

    def codes(self, scene: Scene, before: Array) -> Array:
        """See `Calculus.codes`."""
        from casper.qsr.arrays.directions import tpcc as on_arrays

        return on_arrays(scene, self.tolerance)

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        origin, relatum, referent = moment.now
        return tpcc(origin[:2], relatum[:2], referent[:2], self.tolerance)
