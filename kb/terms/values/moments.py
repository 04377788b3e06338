"""Times without a clock: of what happened one after the other only the order is known, or between what times it was.

A rule may ask which of two came first; how many seconds lie between, or have passed, has no value. Such a comparison is
undefined, as any evaluation that fails, and never a "no".
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from casper.kb.terms.values.failure import EvaluationFailed


@dataclass(frozen=True, slots=True, eq=True)
class Moment:
    """The time of the event of this number; equal to no other time, and to no number of seconds.

    ``earlier`` is the mask of the numbers of all events that were earlier, ``since`` a time (seconds) that it is later
    than, ``until`` one that it is earlier than; events of which none was earlier than the other have no order. One that
    has no number (`sometime`) is known by these bounds alone.
    """

    number: int
    earlier: int = 0
    since: float = -math.inf
    until: float = math.inf

    def __hash__(self) -> int:
        return hash((self.number, self.since, self.until))

    def __lt__(self, other: Any) -> bool:
        return self.is_before(other)

    def __gt__(self, other: Any) -> bool:
        return self != other and not self.is_before(other)

    def __le__(self, other: Any) -> bool:
        return self == other or self.is_before(other)

    def __ge__(self, other: Any) -> bool:
        return self == other or not self.is_before(other)

    def is_before(self, other: Any) -> bool:
        """Whether it is earlier than another moment, or a number of seconds.

        Raises:
            EvaluationFailed: that is not known.
        """
        if isinstance(other, Moment):
            if self.until <= other.since or other.until <= self.since:
                return self.until <= other.since
            if UNNUMBERED in (self.number, other.number):
                raise EvaluationFailed(f"which of {self} and {other} came first is not known")
            if self.number == other.number or self.earlier >> other.number & 1:
                return False
            if other.earlier >> self.number & 1:
                return True
            raise EvaluationFailed(f"which of {self} and {other} came first is not known")
        if isinstance(other, (int, float)) and (other <= self.since or other >= self.until):
            return other >= self.until
        raise EvaluationFailed(f"{self} is known by its order only, not in seconds")

    def __repr__(self) -> str:
        if self.number != UNNUMBERED:
            return f"moment {self.number}"
        before = f"some time before {self.until:g}"
        return before if self.since == -math.inf else f"{before}, after {self.since:g}"


UNNUMBERED = -1


def sometime(since: float, until: float) -> Moment:
    """A time between two others (seconds), more of which is not known."""
    return Moment(UNNUMBERED, 0, since, until)


def are_same(left: Any, right: Any) -> bool:
    """Whether two numbers or times are equal: the meaning of ``=:=``.

    Raises:
        EvaluationFailed: that is not known.
    """
    if isinstance(left, Moment) or isinstance(right, Moment):
        return not (left < right or left > right)
    return bool(left == right)


def differ(left: Any, right: Any) -> bool:
    """Whether two numbers or times are not equal: the meaning of ``=\\=``.

    Raises:
        EvaluationFailed: that is not known.
    """
    return not are_same(left, right)


def moment_after(history: Iterable[tuple[Any, float | Moment]]) -> Moment:
    """The moment of what happens after all of a history."""
    number, since = 0, -math.inf
    for _, t in history:
        number = max(number, t.number if isinstance(t, Moment) else number) + 1
        since = max(since, t.since if isinstance(t, Moment) else t)
    return Moment(number, (1 << number) - 1, since)
