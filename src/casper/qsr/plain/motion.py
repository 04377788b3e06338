"""Motion of one point from one step to the next: MOS, and the symbols of QTC.

Sources: QSRlib's ``mos``, ``qtcbs``, ``qtccs`` and ``qtcbcs``; Van de Weghe 2004 for the textbook's QTC. A threshold
is a length per step, which the caller makes from a speed where there is one.
"""

from __future__ import annotations

import math

from casper.qsr.plain.points import Point


def moving(displacement: float, threshold: float, before: bool | None = None, margin: float = 0.0) -> bool:
    """MOS: strictly more displacement than the threshold (both metres), with optional hysteresis."""
    if before is not None:
        threshold += -margin if before else margin
    return displacement > threshold


def approach_by_projection(before: Point, now: Point, towards: Point) -> float:
    """QSRlib's QTC_B: metres the point went along the line from where it was to where the other was.

    Positive is nearer; 0 when the two coincided. In the plane, or in space where the points have a height.
    """
    if len(before) == 3:
        return _approach_in_space(before, now, towards)
    dx, dy = towards[0] - before[0], towards[1] - before[1]
    length = math.sqrt(dx * dx + dy * dy)
    if length == 0.0:
        return 0.0
    return ((now[0] - before[0]) * dx + (now[1] - before[1]) * dy) / length


def _approach_in_space(before: Point, now: Point, towards: Point) -> float:
    dx, dy, dz = towards[0] - before[0], towards[1] - before[1], towards[2] - before[2]
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    if length == 0.0:
        return 0.0
    return ((now[0] - before[0]) * dx + (now[1] - before[1]) * dy + (now[2] - before[2]) * dz) / length


def approach_by_distance(before: Point, now: Point, towards: Point) -> float:
    """The textbook's QTC_B: metres the distance to where the other was has shrunk by, 0 if they coincided."""
    dx, dy = towards[0] - before[0], towards[1] - before[1]
    ex, ey = towards[0] - now[0], towards[1] - now[1]
    was, far = dx * dx + dy * dy, ex * ex + ey * ey
    if len(before) == 3:
        dz, ez = towards[2] - before[2], towards[2] - now[2]
        was, far = was + dz * dz, far + ez * ez
    return math.sqrt(was) - math.sqrt(far) if was != 0.0 else 0.0


def sideways(before: Point, now: Point, towards: Point) -> float:
    """QTC_C: metres the point went to the left of the line to where the other was; 0 if they coincided."""
    dx, dy = towards[0] - before[0], towards[1] - before[1]
    length = math.sqrt(dx * dx + dy * dy)
    if length == 0.0:
        return 0.0
    return ((now[1] - before[1]) * dx - (now[0] - before[0]) * dy) / length


def qtc(approach: float, threshold: float, before: str | None = None, margin: float = 0.0) -> str:
    """``-`` towards (or left), ``+`` away (or right), ``0`` when the approach (metres) is within the threshold.

    With a ``margin`` the symbol ``before`` is harder to leave than to keep (hysteresis).
    """
    symbol = "-" if approach > 0.0 else "+"
    limit = threshold + (-margin if symbol == before else margin)
    return symbol if abs(approach) > limit else "0"
