"""Events held back to a pace: as many seconds of a stream a second as somebody asks for."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator

from casper.engine.events import Event
from casper.kb.errors import CasperError

NAP = 3600.0  # seconds slept at once: no platform counts up to any float


def check_speed(speed: float) -> None:
    """Refuse a speed that is none.

    Raises:
        CasperError: it is negative, or not finite.
    """
    if not 0 <= speed < math.inf:
        raise CasperError(f"the speed is a finite number from 0 (as fast as it goes), not {speed}")


def paced(events: Iterable[Event], speed: float, start: float | None = 0.0) -> Iterator[Event]:
    """The events, held back to the asked pace.

    Args:
        events: in the order of time.
        speed: seconds of theirs a second; 0: they are not held back.
        start: their time when it begins; None: that of the first of them.
    """
    began = time.monotonic()
    for event in events:
        start = event.t if start is None else start
        if speed > 0:
            while (left := (event.t - start) / speed - (time.monotonic() - began)) > 0:
                time.sleep(min(left, NAP))
        yield event
