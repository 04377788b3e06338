"""How good a sensor is, estimated from what it says: noise of positions, share of lost detections, pace.

Things that rest are the gauge: two detections one after the other differ by the noise alone, and of three in a row the
middle one is missing only where it was lost. Medians are taken, so that the few things which move do not count. Who is
watched is in view all the time, so the middle one of their detections says as much; who was never missing is taken to
be the one that looks, and says nothing.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from statistics import median

from casper.engine.perception.world import ObjectState, WorldState

MEDIAN_OF_SQUARES = 2 * 0.6931471805599453  # of the squared length of a standard normal vector in the plane
KEPT = 160  # differences, and gaps, that are looked back on
LEAST = 12  # differences before the noise is told
OFTEN = 10  # world states between two estimates, once there is enough to look back on
PRIOR = 30  # detections without a loss that are taken as seen before any


@dataclass(frozen=True, slots=True)
class Quality:
    """What is known of the sensor by now.

    noise: metres, standard deviation of a coordinate; None while unknown. lost: share of the detections that are
    missing, never above what is sure. period: seconds between two world states, None before the second.
    """

    noise: float | None = None
    lost: float = 0.0
    period: float | None = None


class Gauge:
    """Estimates the quality, a world state at a time."""

    def __init__(self) -> None:
        self._t: float | None = None
        self._periods: deque[float] = deque(maxlen=9)
        self._squares: deque[float] = deque(maxlen=KEPT)
        self._gaps: deque[bool] = deque(maxlen=KEPT)
        self._before: Mapping[str, ObjectState] = {}
        self._earlier: Mapping[str, ObjectState] = {}
        self._people: tuple[Collection[str], Collection[str]] = ((), ())  # in view two world states ago, and one
        self._missed: set[str] = set()  # of them, who were lost at least once
        self._count = 0
        self.quality = Quality()

    def update(self, world: WorldState) -> Quality:
        """The quality after one more world state."""
        if self._t is not None:
            self._periods.append(world.t - self._t)
        self._t, now, before, earlier = world.t, world.objects, self._before, self._earlier
        squares, gaps = self._squares, self._gaps
        for name, thing in now.items():
            was = before.get(name)
            if was is not None:
                dx, dy = thing.x - was.x, thing.y - was.y
                squares.append((dx * dx + dy * dy) / 2.0)
            if name in earlier:
                gaps.append(was is None)
        self._earlier, self._before = before, now
        self._look_for(world.agents)
        self._count += 1
        if self._count % OFTEN == 0 or len(squares) < KEPT:
            self.quality = Quality(self._noise(), sum(gaps) / (len(gaps) + PRIOR), self._period())
        return self.quality

    def _look_for(self, now: Collection[str]) -> None:
        earlier, before = self._people
        for name in now:
            if name in earlier:
                if name not in before:
                    self._missed.add(name)
                if name in self._missed:
                    self._gaps.append(name not in before)
        self._people = before, now

    def _noise(self) -> float | None:
        return (median(self._squares) / MEDIAN_OF_SQUARES) ** 0.5 if len(self._squares) >= LEAST else None

    def _period(self) -> float | None:
        return median(self._periods) if self._periods else None
