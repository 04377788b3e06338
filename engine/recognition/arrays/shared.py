"""What kernels on numpy share: exact sums, prices, a posterior that is read from an array, the best of many ends."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias, TypeVar

from casper.engine.recognition.kernels.kernel import Kernel, Leading
from casper.engine.recognition.scoring import least_tie
from casper.engine.verification.matching import Matcher
from casper.plans.trees.plan import Plan

Array: TypeAlias = Any  # numpy.ndarray; numpy is imported when the first large library is read
EXACT_LEAVES = 66  # C(66, 33) < 2**63
L = TypeVar("L")


class OnArrays(Kernel[L]):
    """A kernel by names on numpy. ``goal`` and ``prior`` are numbers by plan; so are `masses`, in an array."""

    def __init__(
        self, plans: Sequence[Plan], matcher: Matcher, noise: float | None, priors: Sequence[float] | None
    ) -> None:
        import numpy as np

        super().__init__(plans, matcher, noise, priors)
        self.np = np
        self.goal = np.array([self.index[label] for label in self.labels])
        self.prior = np.array(self.priors, float)
        self._own_goal = len(self.index) == len(plans)

    def total(self, level: L) -> float:
        masses: Array = self.masses(level)
        return float(masses.sum())

    @abstractmethod
    def nearest(self, level: L, most: int | None = None) -> Ties:
        """Ends of the best explanations, nearly or quite, as they weigh when that many observations are marked at most;
        None for what is."""

    def leading(self, level: L) -> Leading | None:
        return self.nearest(level).leading(self.np, self.goal)

    def posterior(self, level: L) -> Mapping[str, float]:
        masses: Array = self.masses(level)
        whole = self.total(level) if self.several else masses.sum()
        shares = masses if self._own_goal else self.np.bincount(self.goal, masses, len(self.index))
        return Shares(self.index, shares / whole if whole else shares)


class Shares(Mapping[str, float]):
    """A posterior over many goals, read from an array when asked for."""

    def __init__(self, index: Mapping[str, int], values: Array) -> None:
        self._index, self.values_array = index, values

    def __getitem__(self, goal: str) -> float:
        return float(self.values_array[self._index[goal]])

    def __iter__(self) -> Iterator[str]:
        return iter(self._index)

    def __len__(self) -> int:
        return len(self._index)


class Prices:
    """Powers of the price of a needless observation; a price of 0 leaves what marks most, and nothing else."""

    def __init__(self, np: Any, noise: float) -> None:
        self._np, self._noise, self._powers = np, noise, np.ones(1)

    def of(self, marked: Array, most: int) -> Array:
        """What the needless observations cost where so many were marked, but for those that all take for needless."""
        if len(self._powers) <= most:
            self._powers = self._np.array([self._noise**needless for needless in range(2 * most + 8)], float)
        return self._powers.take(most - marked)


def narrowest(largest: float) -> str:
    """The narrowest unsigned integers that hold numbers up to this one; above 64 bits Python's."""
    return next((f"u{size}" for size in (2, 4, 8) if largest < 1 << 8 * size), "O")


def exactly(np: Any, counts: Array) -> int:
    """The sum of counts of any width as a Python integer: it may not fit into 64 bits, though every count does."""
    if counts.dtype.kind == "O":
        return int(counts.sum())
    if counts.dtype.itemsize < 8:
        return int(counts.sum(dtype=np.uint64))
    if counts.sum(dtype=float) < 1 << 62:
        return int(counts.sum())
    return (int((counts >> 32).sum()) << 32) + int((counts & 0xFFFFFFFF).sum())


class Ties(NamedTuple):
    """Ends, the best among them. Shapes: (ends,); ``second`` is the plan of a second goal, which comes later in the
    library, or -1."""

    weight: Array  # of each explanation that ends there
    plan: Array
    second: Array
    missed: Array  # leaves
    number: Array  # explanations

    def leading(self, np: Any, goal: Array) -> Leading | None:
        """The best of them and its rivals. ``goal``: by plan, its goal's number."""
        if not len(self.weight):
            return None
        top = self.weight.max()
        ties = np.flatnonzero(self.weight >= least_tie(top))
        weight, plan, second, missed, number = (part[ties] for part in self)
        heaviest = np.flatnonzero(weight == top)
        first = heaviest[np.lexsort((second[heaviest], plan[heaviest]))[0]]
        one, other = goal[plan], np.where(second < 0, -1, goal[second])
        low, high = np.minimum(one, other), np.maximum(one, other)
        same = (low == low[first]) & (high == high[first])
        plans = (int(plan[first]),) if second[first] < 0 else (int(plan[first]), int(second[first]))
        return float(top), plans, int(missed[same].min()), exactly(np, number[~same]), exactly(np, number)
