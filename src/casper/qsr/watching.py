"""One observer who watches many things, step by step in plain Python: QDC, QTC_B, MOS and bearings worked out together.

What `casper.qsr.Stream` tells of an observer in the plane, for those who need it fast: a displacement and its length
are taken once for the distance, the bearing, and the trajectory of the next step.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from math import atan2, remainder, sqrt, tau
from typing import Any, NamedTuple

from casper.qsr.calculi.calculus import Body, Calculus, Names, Step
from casper.qsr.calculi.distances import Qdc
from casper.qsr.calculi.motion import Mos, QtcB11

Place = tuple[float, float]
"""Metres."""


class Watched(NamedTuple):
    """What holds at one step, by thing but for ``moving``; None where there was no step before.

    bearing: radians from 0 to pi between the heading and the line to the thing, 0 for one in the same place.
    """

    moving: bool | None
    qdc: dict[str, str]
    qtc: dict[str, str | None]
    bearing: dict[str, float]


class Watcher:
    """Keeps the step before. Heights do not count: all three calculi are taken in the plane."""

    def __init__(self, qdc: Qdc, qtc: QtcB11, mos: Mos) -> None:
        self._qdc, self._qtc, self._mos = qdc, qtc, mos
        self._labels, self._ends = qdc.labels, tuple(end for _, end in qdc.bands[:-1])
        self._fast = qdc.quick and qtc.quick and mos.quick
        self.reset()

    def reset(self) -> None:
        """Forget the step before: the next one is a first step again."""
        self._here: Place | None = None
        self._offsets: dict[str, tuple[float, float, float]] = {}
        self._slow = _Slowly(self._qdc, self._qtc, self._mos)

    def seen_before(self, name: str) -> bool:
        """Whether a thing was there a step ago."""
        return name in self._offsets

    def update(self, dt: float, here: Place, heading: float, places: Mapping[str, Place]) -> Watched:
        """The step ``dt`` seconds after the one before: the observer's place and heading (radians), the things'."""
        moving, gone = self._moved(dt, here)
        limit, before, offsets = self._qtc.threshold.per_step(dt), self._offsets, {}
        labels, ends, (x, y), (mx, my) = self._labels, self._ends, here, gone
        qdc: dict[str, str] = {}
        qtc: dict[str, str | None] = {}
        bearing = {}
        for name, (there_x, there_y) in places.items():
            dx, dy = there_x - x, there_y - y
            length = sqrt(dx * dx + dy * dy)
            offsets[name] = dx, dy, length
            qdc[name] = labels[bisect_left(ends, length)]
            bearing[name] = abs(remainder(atan2(dy, dx) - heading, tau)) if dx != 0.0 or dy != 0.0 else 0.0
            was = before.get(name)
            if was is None:
                qtc[name] = None
                continue
            was_x, was_y, length = was
            along = (mx * was_x + my * was_y) / length if length != 0.0 else 0.0
            qtc[name] = "-" if along > limit else "+" if along < -limit else "0"
        if not self._fast:
            moving, qdc, qtc = self._slow.update(dt, self._here, here, places)
        self._here, self._offsets = here, offsets
        return Watched(moving, qdc, qtc, bearing)

    def _moved(self, dt: float, here: Place) -> tuple[bool | None, Place]:
        if self._here is None:
            return None, (0.0, 0.0)
        mx, my = here[0] - self._here[0], here[1] - self._here[1]
        return sqrt(mx * mx + my * my) > self._mos.threshold.per_step(dt), (mx, my)


_OBSERVER: Any = object()  # no thing's name equals it, whatever the things are called
_ALONE = ((_OBSERVER,),)


class _Slowly:
    """The same by the calculi themselves: distance variant, margins."""

    def __init__(self, *calculi: Calculus) -> None:
        self._calculi = calculi
        self._was: dict[str, Body] = {}
        self._held: list[dict[Names, str]] = [{}, {}, {}]

    def update(
        self, dt: float, was: Place | None, here: Place, places: Mapping[str, Place]
    ) -> tuple[bool | None, dict[str, str], dict[str, str | None]]:
        now = {name: Body(*place) for name, place in places.items()} | {_OBSERVER: Body(*here)}
        pairs = tuple((_OBSERVER, name) for name in places)
        earlier = self._was if was is not None else {}
        told = []
        for place, (calculus, rows) in enumerate(zip(self._calculi, (pairs, pairs, _ALONE))):
            labels = calculus.many(Step(rows, now, earlier, dt), self._held[place])
            self._held[place] = {row: label for row, label in zip(rows, labels) if label is not None}
            told.append(labels)
        self._was = now
        moving = None if told[2][0] is None else told[2][0] == "moving"
        qdc = {name: label for name, label in zip(places, told[0]) if label is not None}
        return moving, qdc, dict(zip(places, told[1], strict=True))
