"""Minds whose actions are placed by a day's hypotheses, instead of by sight (`engine.reading.by_day`).

    >>> minds = Partners(domain, segments=by_day(domain))

By sight is the default: what fits the goal under way belongs to it, what does not begins another one or is left out. A
day weighs that against needless actions, goals taken up again and several at once, at its prices. It then may think
better of an announcement: in the kitchen's days of three goals (`benchmarks/day/room.py`) both read and help with all
of them, but by a day three of eight seeds announce a goal and withdraw it, by sight none.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.reading.by_day import REMEMBERED, ByDay
from casper.engine.reading.reading import Reading
from casper.engine.verification.observation import Seen


def by_day(domain: Domain, **options: Any) -> Callable[[str, Callable[[], Reading]], ByDay]:
    """What makes the segments of each partner (``segments`` of `Mind` and `Partners`): all share one day.

    Args:
        domain: where it happens.
        options: those of `Domain.day`; with ``verification=False`` the minds must be without it, too.

    Raises:
        CasperError: as `Domain.day`.
    """
    day, seen = domain.day(**options), deque[tuple[int, Seen]](maxlen=REMEMBERED)
    return lambda agent, fresh: ByDay(day, agent, fresh, seen)
