"""Qualitative spatial relations of one agent towards one object, as pure functions on metres.

They agree with QSRlib's ``argd``, ``mos`` and ``qtcbs`` (facts of the paper's Perception section); a
threshold of a trajectory relation is a length per step, which the caller makes from a speed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

Point = tuple[float, float]


def qdc(distance: float, bands: Sequence[tuple[str, float]], before: str | None = None, margin: float = 0.0) -> str:
    """The first label whose threshold is at least ``distance``; upper ends are closed.

    Beyond the last threshold the last label. With a ``margin`` (metres) the label ``before`` is kept while
    the distance is within its band widened by the margin on both sides (hysteresis).
    """
    if margin > 0.0 and before is not None and _within(distance, bands, before, margin):
        return before
    for label, threshold in bands:
        if distance <= threshold:
            return label
    return bands[-1][0]


def _within(distance: float, bands: Sequence[tuple[str, float]], label: str, margin: float) -> bool:
    lower = 0.0
    for name, upper in bands:
        if name == label:
            return lower - margin < distance <= upper + margin
        lower = upper
    return False


def approach_by_projection(before: Point, now: Point, towards: Point) -> float:
    """QSRlib's QTC_B: metres the agent went along the line from where it was to where the object was.

    Positive is nearer; 0 when the two coincided.
    """
    dx, dy = towards[0] - before[0], towards[1] - before[1]
    length = math.hypot(dx, dy)
    if length == 0.0:
        return 0.0
    return ((now[0] - before[0]) * dx + (now[1] - before[1]) * dy) / length


def approach_by_distance(before: Point, now: Point, towards: Point) -> float:
    """The textbook's QTC_B: metres the distance to where the object was has shrunk by, 0 if they coincided."""
    was = math.hypot(towards[0] - before[0], towards[1] - before[1])
    if was == 0.0:
        return 0.0
    return was - math.hypot(towards[0] - now[0], towards[1] - now[1])


def qtc(approach: float, threshold: float, before: str | None = None, margin: float = 0.0) -> str:
    """``-`` towards, ``+`` away, ``0`` when the approach (metres) is within the threshold.

    With a ``margin`` the symbol ``before`` is harder to leave than to keep (hysteresis).
    """
    symbol = "-" if approach > 0.0 else "+"
    limit = threshold + (-margin if symbol == before else margin)
    return symbol if abs(approach) > limit else "0"


def moving(displacement: float, threshold: float, before: bool | None = None, margin: float = 0.0) -> bool:
    """MOS: strictly more displacement than the threshold (both metres), with optional hysteresis."""
    if before is not None:
        threshold += -margin if before else margin
    return displacement > threshold
