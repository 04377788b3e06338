"""Intervals and a paired test, by counting and drawing: no distribution is assumed, and nothing is random."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

EXACT = 16  # pairs up to which every exchange of signs is tried
DRAWN = 20_000
SEED = 20260101  # of what is drawn, so that the same data give the same interval
Z = 1.959963984540054  # of 95 %


@dataclass(frozen=True, slots=True)
class Paired:
    """Differences of pairs: their mean with a 95 % interval, and how likely a mean as far from 0 is by chance.

    ``p`` is two-sided, of exchanging the two of a pair: exact up to 16 pairs, else from 20,000 draws. The interval is
    the bootstrap's (percentiles of 20,000 means). ``None`` where there is no pair.
    """

    pairs: int
    mean: float | None
    low: float | None
    high: float | None
    p: float | None


def paired(first: Sequence[float], second: Sequence[float]) -> Paired:
    """How much the first are above the second, pair by pair.

    Raises:
        ValueError: there are not as many of one as of the other.
    """
    if len(first) != len(second):
        raise ValueError(f"{len(first)} and {len(second)} values are no pairs")
    d = np.asarray(first, float) - np.asarray(second, float)
    if not d.size:
        return Paired(0, None, None, None, None)
    low, high = mean_interval(d.tolist())
    return Paired(int(d.size), float(d.mean()), low, high, _by_signs(d))


def mean_interval(values: Sequence[float]) -> tuple[float, float]:
    """A 95 % interval of the mean, by the bootstrap.

    Raises:
        ValueError: there are no values.
    """
    if not values:
        raise ValueError("no values have no mean")
    d, source = np.asarray(values, float), np.random.default_rng(SEED)
    drawn = d[source.integers(0, d.size, (DRAWN, d.size))].mean(axis=1) if d.size < 1000 else _normal(d, source)
    low, high = np.percentile(drawn, (2.5, 97.5))
    return float(low), float(high)


def _normal(d: np.ndarray, source: np.random.Generator) -> np.ndarray:
    """Of so many values the mean is as good as normal, and drawing them all again would take memory."""
    return source.normal(d.mean(), d.std(ddof=1) / math.sqrt(d.size), DRAWN)


def _by_signs(d: np.ndarray) -> float:
    seen, tolerance = abs(d.sum()), 1e-9 * float(np.abs(d).sum())
    if d.size <= EXACT:
        codes = np.arange(2**d.size)[:, None] >> np.arange(d.size) & 1
        return float(np.mean(np.abs((1 - 2 * codes) @ d) >= seen - tolerance))
    source, hits = np.random.default_rng(SEED), 0
    for _ in range(20):
        signs = source.integers(0, 2, (DRAWN // 20, d.size)) * 2 - 1
        hits += int(np.sum(np.abs(signs @ d) >= seen - tolerance))
    return (hits + 1) / (DRAWN + 1)  # what was seen is one of the draws: p is never 0


def share_interval(hits: int, count: int) -> tuple[float, float]:
    """A 95 % interval of a share (Wilson's).

    Raises:
        ValueError: there are more hits than were counted, or none was counted.
    """
    if not 0 <= hits <= count or count == 0:
        raise ValueError(f"{hits} of {count} is no share")
    p, n = hits / count, count
    middle, half = p + Z * Z / (2 * n), Z * math.sqrt(p * (1 - p) / n + Z * Z / (4 * n * n))
    return max(0.0, (middle - half) / (1 + Z * Z / n)), min(1.0, (middle + half) / (1 + Z * Z / n))
