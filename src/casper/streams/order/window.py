"""A reordering buffer: what comes late by less than a window is put in its place, later than that is left out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from heapq import heappop, heappush

from casper.engine.live import Report
from casper.kb.errors import CasperError
from casper.streams.items import Given, Item, Note
from casper.streams.order.clock import BACK, Clock

MOST = 10_000  # messages that wait
LATE = 60.0  # seconds up to which a wider window is worth its while


def check_window(seconds: float) -> None:
    """Refuse a window that is none.

    Raises:
        CasperError: it is negative or not finite.
    """
    if not 0 <= seconds < math.inf:
        raise CasperError(f"the window is a finite number of seconds from 0 (nothing waits), not {seconds}")


def usual_window(is_live: bool) -> float:
    """Seconds: waiting costs nothing in a file, and in a live stream it would hold back whoever waits for an answer."""
    return 0.0 if is_live else 1.0


def in_order(items: Iterable[Item], window: float = 0.0) -> Iterator[Item]:
    """World states and reports in the order of time, each moment once; sentences stay where they are."""
    clock, buffer = Clock(max(BACK, window)), Window(window)
    for item in items:
        if isinstance(item, Note):
            yield item
            continue
        for timed in clock.take(item):
            if isinstance(timed, Note):
                yield timed
            else:
                yield from buffer.take(timed)
    for timed in clock.rest():
        yield timed
    yield from buffer.rest()


@dataclass
class Window:
    """What waits until nothing earlier can come any more, ``seconds`` after it at the latest."""

    seconds: float = 0.0
    repeats: int = 0
    _newest: float = -math.inf
    _heap: list[tuple[float, bool, int, Given]] = field(default_factory=list)  # reports after the state of their time
    _states: dict[float, Given] = field(default_factory=dict)  # those that wait, and the last that did
    _last: float = -math.inf  # the time of the state that went last
    _reported: float = -math.inf  # and of the report
    _count: int = 0

    def take(self, given: Given) -> Iterator[Item]:
        """One more; what need not wait any longer."""
        t = given.message.t
        if isinstance(given.message, Report):
            newest = max(self._newest if self._count else 0.0, self._reported)
            if newest - t > self.seconds or t < max(self._last, self._reported):
                yield Note(self._late(given, f"time must not run backwards: what the robot did at {_after(t, newest)}"))
                return
        else:
            twin = self._states.get(t)
            if twin is not None:
                yield from self._repeated(given, twin)
                return
            if self._newest - t > self.seconds or t <= self._last:
                yield Note(self._late(given, _after(t, self._newest)))
                return
            self._states[t] = given
            self._newest = max(self._newest, t)
        yield from self._waits(given)

    def _waits(self, given: Given) -> Iterator[Given]:
        """It waits its turn; those whose turn it is go."""
        self._count += 1
        if not self.seconds and not self._heap:
            yield self._gone(given)
            return
        heappush(self._heap, (given.message.t, isinstance(given.message, Report), self._count, given))
        while self._heap and (self._newest - self._heap[0][0] >= self.seconds or len(self._heap) > MOST):
            yield self._gone(heappop(self._heap)[3])

    def rest(self) -> Iterator[Item]:
        """Nothing comes any more."""
        while self._heap:
            yield self._gone(heappop(self._heap)[3])
        if self.repeats > 1:
            yield Note(f"{self.repeats} lines that repeat a world state were left out in all")

    def _gone(self, given: Given) -> Given:
        """It is on its way; the last state that went is remembered, in case that it comes again."""
        t = given.message.t
        if isinstance(given.message, Report):
            self._reported = t
        else:
            self._states.pop(self._last, None)
            self._last = t
        return given

    def _repeated(self, given: Given, twin: Given) -> Iterator[Note]:
        if given.message == twin.message:
            self.repeats += 1
            if self.repeats == 1:
                yield Note(f"{given.where} is left out: it repeats {twin.where}; more that do so are counted")
            return
        told = f"time must advance from one world state to the next: t={given.message.t:g} was at {twin.where}, too"
        yield Note(f"{given.where} is left out: {told}, and differs")

    def _late(self, given: Given, why: str) -> str:
        late = self._newest - given.message.t
        advice = f"; --window {late:.3g} or more puts it in order" if self.seconds < late <= LATE else ""
        return f"{given.where} is left out: {why}{advice}"


def _after(t: float, newest: float) -> str:
    return f"t={t:g} came after t={newest:g}"
