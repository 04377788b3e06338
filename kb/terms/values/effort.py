"""What a single step costs beyond its share: work on large terms, numbers and atoms is charged to the search under way.

A budget counts steps. Most steps are small and alike; one that copies a term of a million parts, or makes an atom of a
million characters, is as much work as thousands of others, and holds as much memory. Whoever does such work says how
many parts it was about; the search in whose step it happens counts them as steps, and may stop there and then.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

PARTS_A_STEP = 32
SMALL = 64  # parts that are part of any step
_AT_ONCE = 256 * PARTS_A_STEP  # parts after which the search is told, in the midst of a step
CHARACTERS_A_PART = 16
_BITS_A_PART = 128
_LARGE = 1 << 12  # bits of an integer whose size is worth a look


class Meter(threading.local):
    """Of each thread: the search whose step it is in, and what that step has cost so far.

    Attributes:
        look: takes steps that were taken, and raises where the search has to stop; None outside of any search.
        parts: what was not told yet.
    """

    look: Callable[[int], object] | None = None
    parts = 0


METER = Meter()


def charge(parts: int) -> None:
    """Count the parts of what was looked at, copied or made.

    Raises:
        BudgetExceeded: the search under way has had what it may.
    """
    meter = METER
    if meter.look is None:
        return
    meter.parts += parts
    if meter.parts >= _AT_ONCE:
        meter.look(taken())


def taken() -> int:
    """The steps that were charged for and not told yet; whoever asks tells of them."""
    steps, METER.parts = divmod(METER.parts, PARTS_A_STEP)
    return steps


@contextmanager
def charged_to(look: Callable[[int], object]) -> Iterator[None]:
    """Work inside is charged to a search; its rest is told at the end.

    Raises:
        BudgetExceeded: as `charge`.
    """
    outer, METER.look = METER.look, look
    try:
        yield
        if METER.parts:
            look(taken())
    finally:
        METER.look = outer


def charge_text(characters: int) -> None:
    """As `charge`, of an atom that was made."""
    if characters > SMALL * CHARACTERS_A_PART:
        charge(characters // CHARACTERS_A_PART)


def charge_integer(bits: int) -> None:
    """As `charge`, of an integer that was made."""
    if bits > _LARGE:
        charge(bits // _BITS_A_PART)
