"""What movements are told by: the paper's four features of one moment, and five more that look back (or say how sure).

Every value is qualitative, and counts by its place in the order of its feature. Nothing here knows of labels, or of
what comes later.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import NamedTuple

from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations

MOS = ("still", "moving")
HOLD = ("free", "holding")
QDC = ("touch", "near", "medium", "far", "ignore")
QTC = ("-", "0", "+", "ignore")
GRASP = ("none", "weak", "strong", "sure")
LONG = ("brief", "short", "while", "long", "longer")
CARRIED = ("no", "yes")
EYE = ("plain", "filtered")

ENDS = (0.55, 1.05, 2.05, 4.05)  # seconds up to which something is brief, short, …
EVIDENCE = (0.2, 0.5, 0.8)  # weights up to which a grasp is none, weak, strong
WALKED = 0.6  # seconds in motion from which what is in a hand has been carried


class Features(NamedTuple):
    """The paper's: ``still`` or ``moving``, ``free`` or ``holding``, the target's QDC and QTC.

    Without a target the last two are ``ignore``. A tuple, so that it is the key of the relation's table.
    """

    mos: str
    hold: str
    qdc: str
    qtc: str


class TimedFeatures(NamedTuple):
    """The same, and what went before.

    grasp: the evidence that the hand holds something. held: for how long it has been as it is, free or full. carried:
    whether there was a walk since. stood: for how long the agent has been still, or moving. eye: ``filtered`` where the
    sensor is poor (`engine.perception.filters`).
    """

    mos: str
    hold: str
    qdc: str
    qtc: str
    grasp: str
    held: str
    carried: str
    stood: str
    eye: str


Seen = Features | TimedFeatures
NOT_PERCEIVED = Features("ignore", "ignore", "ignore", "ignore")
"""The features of a movement that was not told by any, such as a simulated one."""

ORDERS: tuple[tuple[str, ...], ...] = (MOS, HOLD, QDC, QTC)
"""The values of each of the paper's features in the order they count in: still 0, moving 1; free 0, holding 1; …"""
TIMED_ORDERS = (*ORDERS, GRASP, LONG, CARRIED, LONG, EYE)


def orders_of(kind: type[Seen]) -> tuple[tuple[str, ...], ...]:
    """The values of each feature, in order."""
    return ORDERS if kind is Features else TIMED_ORDERS


def features(relations: Relations, focus: Focus) -> Features:
    """The paper's features at one moment; the first step, which has no MOS, counts as still."""
    mos = "moving" if relations.moving else "still"
    hold = "free" if relations.holding is None else "holding"
    target = focus.target
    if target is None or target not in relations.qdc:
        return Features(mos, hold, "ignore", "ignore")
    return Features(mos, hold, relations.qdc[target], relations.qtc[target] or "ignore")


class Timed:
    """The timed features, from relations in the order of time."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget what went before."""
        self._t: float | None = None
        self._hand: tuple[str, float] = ("", 0.0)  # what it is, and since when
        self._motion: tuple[str, float] = ("", 0.0)
        self._walked = 0.0  # seconds in motion since the hand changed

    def update(self, relations: Relations, focus: Focus) -> TimedFeatures:
        """The features of this step. A change is dated back to the step before, the earliest that it can have been."""
        now, t = features(relations, focus), relations.t
        before = t if self._t is None else self._t
        self._t = t
        if now.hold != self._hand[0]:
            self._hand, self._walked = (now.hold, before), 0.0
        if now.mos != self._motion[0]:
            self._motion = now.mos, before
        if relations.moving:
            self._walked += t - before
        doubt = relations.doubt
        sure = float(relations.holding is not None) if doubt is None else doubt.grasp
        return TimedFeatures(
            *now,
            GRASP[bisect_left(EVIDENCE, sure)],
            LONG[bisect_left(ENDS, t - self._hand[1])],
            CARRIED[self._walked >= WALKED],
            LONG[bisect_left(ENDS, t - self._motion[1])],
            EYE[doubt is not None],
        )
