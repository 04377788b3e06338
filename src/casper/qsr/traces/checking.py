"""What every trace must be: names that differ, times that grow, numbers that can be reckoned with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Array


def check_names(names: Iterable[str]) -> tuple[str, ...]:
    """The names, each of which is there once.

    Raises:
        TraceError: one is there twice, or is no text.
    """
    given = tuple(names)
    seen: set[str] = set()
    for name in given:
        if not isinstance(name, str) or not name:
            raise TraceError(f"things go by names, and {name!r:.40} is none")
        if name in seen:
            raise TraceError(f"two things are named {name}; names are given once")
        seen.add(name)
    return given


def check_times(t: ArrayLike) -> Array:
    """Seconds that grow.

    Raises:
        TraceError: one is not finite, or does not come after the one before; the sentence names both.
    """
    times = np.array(t, dtype=np.float64, ndmin=1)
    if times.ndim != 1:
        raise TraceError(f"times are a row of numbers, not an array of shape {times.shape}")
    if not np.isfinite(times).all():
        raise TraceError(f"the time of step {int(np.flatnonzero(~np.isfinite(times))[0])} is not finite")
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(back):
        at = int(back[0])
        raise TraceError(f"time must advance from one step to the next: t={times[at + 1]:g} came after t={times[at]:g}")
    return times


def first_place(wrong: Array) -> tuple[int, int]:
    """The thing and the step of the first that is wrong, by time."""
    at = int(np.flatnonzero(wrong.any(axis=0))[0])
    return int(np.flatnonzero(wrong[:, at])[0]), at


def shown(names: Sequence[str], most: int = 8) -> str:
    """The names in a sentence, not too many of them."""
    if not names:
        return "nothing"
    rest = len(names) - most
    return ", ".join(names[:most]) + (f" and {rest} more" if rest > 0 else "")
