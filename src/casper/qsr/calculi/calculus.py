"""What a calculus is to the batch and to the stream."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, NamedTuple, Protocol

from casper.kb.errors import TraceError

if TYPE_CHECKING:
    from casper.qsr.arrays.scene import Array, Scene


Names = tuple[str, ...]


class Body(NamedTuple):
    """A thing at one moment: metres, radians (0 = +x, counter-clockwise), full extents, who or what is in the hand."""

    x: float
    y: float
    z: float | None = None
    heading: float | None = None
    size: tuple[float, ...] | None = None
    holding: str | None = None


class Moment(NamedTuple):
    """One tuple of things now, a step before (None: one was not there, or that is too long ago), seconds between."""

    now: Sequence[Body]
    was: Sequence[Body] | None
    dt: float


class Step(NamedTuple):
    """The tuples that are related at one step, all of whose things are there now; things now, a step before;
    seconds."""

    rows: Sequence[Names]
    now: Mapping[str, Body]
    was: Mapping[str, Body]
    dt: float


class Calculus(Protocol):
    """A set of relations that exclude each other and of which one always holds."""

    @property
    def name(self) -> str:
        """What results are filed under."""

    @property
    def arity(self) -> int:
        """How many things are related: 1, 2 or 3."""

    @property
    def motion(self) -> bool:
        """Whether it is told of two steps; the first has none then."""

    @property
    def needs(self) -> tuple[str, ...]:
        """What of `Body` is needed beside the place, and may be missing: ``heading``, ``size``."""

    @property
    def labels(self) -> tuple[str, ...]:
        """The base relations, in the order of their codes."""

    @property
    def remembers(self) -> bool:
        """Whether the label of the step before matters (hysteresis)."""

    @property
    def quick(self) -> bool:
        """Whether `many` is a loop of its own, and faster than arrays up to some hundreds of tuples."""

    def codes(self, scene: Scene, before: Array) -> Array:
        """The labels' numbers, tuples by steps (the columns from 1); where things are missing, any.

        ``before``: the codes at column 0, -1 where there was none.
        """

    def one(self, moment: Moment, before: str | None) -> str:
        """The label of one tuple at one step; for motion ``moment.was`` is there."""

    def many(self, step: Step, before: Mapping[Names, str]) -> Sequence[str | None]:
        """The labels of many tuples at one step, None where undefined: by `one`, or by a loop that does the same
        faster.

        ``before``: the labels a step before; it is looked at where `remembers` only.
        """


class Plain:
    """Calculi that tell many tuples one by one."""

    arity: ClassVar[int]
    motion: ClassVar[bool]

    @property
    def quick(self) -> bool:
        """See `Calculus.quick`."""
        return False

    def one(self, moment: Moment, before: str | None) -> str:
        """See `Calculus.one`."""
        raise NotImplementedError

    def many(self, step: Step, before: Mapping[Names, str]) -> Sequence[str | None]:
        """See `Calculus.many`."""
        told: list[str | None] = []
        rows, now, was, dt = step
        for row in rows:
            earlier = [was[name] for name in row if name in was] if self.motion else None
            if earlier is not None and len(earlier) != len(row):
                told.append(None)
            else:
                told.append(self.one(Moment([now[name] for name in row], earlier, dt), before.get(row)))
        return told


def require(holds: bool, sentence: str) -> None:
    """Raise TraceError with this sentence unless ``holds``."""
    if not holds:
        raise TraceError(sentence)


def at_least_nothing(name: str, metres: float) -> None:
    """Refuse a tolerance or a margin that is negative or no number."""
    require(metres >= 0.0, f"{name} is a length from 0, not {metres}")
