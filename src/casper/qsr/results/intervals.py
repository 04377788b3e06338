"""Allen's relations of intervals of time: given as arrays, or between episodes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from casper.kb.errors import TraceError
from casper.qsr.arrays.regions import allen as on_arrays
from casper.qsr.arrays.scene import Array
from casper.qsr.plain.regions import ALLEN
from casper.qsr.results.episodes import Episode


def allen(
    one: Sequence[ArrayLike] | Sequence[Episode], other: Sequence[ArrayLike] | Sequence[Episode], tolerance: float = 0.0
) -> Array:
    """The relation of each interval of the first to each of the second, as labels (n, m).

    Args:
        one, other: episodes, or two arrays: starts and ends (seconds).
        tolerance: seconds up to which ends count as equal.

    Raises:
        TraceError: an interval that does not end after it starts; an episode of a single step has no length.
    """
    if not tolerance >= 0.0:
        raise TraceError(f"the tolerance of Allen's relations is a number of seconds from 0, not {tolerance}")
    (starts, ends), (other_starts, other_ends) = _ends(one), _ends(other)
    codes = on_arrays(starts[:, None], ends[:, None], other_starts[None, :], other_ends[None, :], tolerance)
    return np.array(ALLEN, dtype=object)[codes]


def _ends(given: Sequence[ArrayLike] | Sequence[Episode]) -> tuple[Array, Array]:
    if all(isinstance(each, Episode) for each in given):
        pairs = [(each.begins, each.ends) for each in given if isinstance(each, Episode)]
        starts, ends = np.array(pairs, dtype=np.float64).reshape(-1, 2).T
    else:
        if len(given) != 2:
            raise TraceError(f"intervals are two arrays, starts and ends, or episodes, not {len(given)} arrays")
        starts, ends = (np.array(each, dtype=np.float64, ndmin=1) for each in given)
    if starts.shape != ends.shape or starts.ndim != 1:
        raise TraceError(f"there are {starts.size} starts and {ends.size} ends")
    wrong = np.flatnonzero(~((starts < ends) & np.isfinite(starts) & np.isfinite(ends)))
    if len(wrong):
        at = int(wrong[0])
        raise TraceError(f"an interval ends after it starts, and number {at} goes from {starts[at]:g} to {ends[at]:g}")
    return starts, ends
