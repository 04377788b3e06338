"""Counting by names for large libraries of chains: all leaves of all goals in arrays, grouped by action name (numpy).

Counts are kept only on the leaves of the last name. For each ordered pair of names (a, b) a *cut* is made once: where
b's leaves, and the beginnings of their plans, fall among a's. An update is then one cumulative sum over a's leaves and
two gathers over b's. Sums wrap around in 64 bits where they run over many plans, but differences within a plan come
out exact as long as a plan has at most 66 leaves; longer ones are counted in Python's integers. Counts are exact;
posteriors agree with `counting` to a relative 1e-12. Memory: at most `KEPT` numbers a leaf are kept for cuts
and scores.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from threading import Lock
from typing import Any, NamedTuple

from casper.engine.recognition.arrays.shared import EXACT_LEAVES, Array, OnArrays, Ties, exactly
from casper.engine.recognition.kernels.kernel import Marks, Parts, Plans
from casper.engine.recognition.kernels.marks import leftmost
from casper.engine.recognition.scoring import least_tie
from casper.engine.verification.matching import Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

KEPT = 24


class Leaves(NamedTuple):
    """The leaves of one name, in the order of the library. Shapes: (leaves of the name,)."""

    at: Array  # number among all leaves
    begin: Array  # number of its plan's first leaf
    plan: Array
    right: Array  # leaves right of it
    square: Array  # of its plan's number of leaves


@dataclass(slots=True)
class Level:
    """Counts on the leaves of the last name. ``living``, made when asked for: those in which explanations end (numbers
    among the leaves of the name), how many, and the score of each."""

    k: int
    action: str
    counts: Array
    living: tuple[Array, Array, Array] | None = None


class Arrays(OnArrays[Level]):
    """Counts for many chains, by names."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        super().__init__(plans, matcher, None, priors)
        np = self.np
        lengths = np.array([len(plan.leaves) for plan in plans])
        self._type = np.int64 if lengths.max() <= EXACT_LEAVES else object
        self._names = leaves_by_name(np, plans, lengths)
        self._names[""] = Leaves(*[np.zeros(0, np.int64)] * 5)  # before anything was seen
        self._room = KEPT * int(lengths.sum())
        self._kept: OrderedDict[tuple[Any, ...], tuple[Array, ...]] = OrderedDict()
        self._lock = Lock()

    def begin(self) -> Level:
        """Every plan counts once."""
        return Level(0, "", self.np.ones(len(self.plans), self._type), (self._names[""].at,) * 3)

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """The plans that have the action go on."""
        np, last, action = self.np, level.action, seen.action
        if not last:
            return Level(1, action, np.ones(len(self._names[action].at), self._type))
        upto, since = self._cut(last, action)
        running = np.empty(len(level.counts) + 1, self._type)
        running[0] = 0
        np.cumsum(level.counts, out=running[1:])
        following = running.take(upto)
        following -= running.take(since)
        return Level(level.k + 1, action, following)

    def _cut(self, last: str, action: str) -> tuple[Array, ...]:
        """Per leaf of the name: how many leaves of the last name lie left of it, and left of its plan."""
        before, here, search = self._names[last], self._names[action], self.np.searchsorted
        return self._kept.get((last, action)) or self._keep(
            (last, action), search(before.at, here.at), search(before.at, here.begin)
        )

    def _scores(self, action: str, k: int) -> Array:
        """Per leaf of the name: the score of an explanation that ends in it."""
        here = self._names[action]
        return (self._kept.get((action, k)) or self._keep((action, k), k * (here.right + k) / here.square))[0]

    def _keep(self, key: tuple[Any, ...], *arrays: Array) -> tuple[Array, ...]:
        with self._lock:  # forks share what is kept, and may be used by several threads
            self._kept[key] = arrays
            while sum(len(a) for kept in self._kept.values() for a in kept) > self._room and len(self._kept) > 1:
                self._kept.popitem(last=False)
        return arrays

    def alive(self, level: Level) -> set[int]:
        """The plans of the leaves that have counts."""
        if not level.k:
            return set(range(len(self.plans)))
        return set(self._names[level.action].plan[level.counts > 0].tolist())

    def count(self, level: Level) -> int:
        return exactly(self.np, level.counts)

    def _living(self, level: Level) -> tuple[Array, Array, Array]:
        if level.living is None:
            counts, scores = level.counts, self._scores(level.action, level.k)
            at = self.np.flatnonzero(counts)
            level.living = (at, counts, scores) if len(at) == len(counts) else (at, counts.take(at), scores.take(at))
        return level.living

    def masses(self, level: Level) -> Array:
        (at, counts, scores), here = self._living(level), self._names[level.action]
        mass = (counts * scores).astype(float, copy=False)
        sums = self.np.bincount(here.plan.take(at), mass, len(self.plans))
        return sums if self.evenly else sums * self.prior

    def _weights(self, level: Level) -> Array:
        """Of the leaves in which explanations end: the weight of each."""
        at, _, scores = self._living(level)
        return scores if self.evenly else scores * self.prior[self._names[level.action].plan.take(at)]

    def best(self, level: Level) -> tuple[float, Plans] | None:
        """The best explanation ends in the first leaf of the greatest weight."""
        weights = self._weights(level)
        if not len(weights):
            return None
        first = int(weights.argmax())
        return float(weights[first]), (int(self._names[level.action].plan[self._living(level)[0][first]]),)

    def nearest(self, level: Level, most: int | None = None) -> Ties:
        (at, counts, _), weights, here = self._living(level), self._weights(level), self._names[level.action]
        near = self.np.flatnonzero(weights >= least_tie(weights.max(initial=0.0)))  # fewer to look at below
        at = at.take(near)
        missed = here.at.take(at) - here.begin.take(at) + 1 - level.k
        plan = here.plan.take(at)
        return Ties(weights.take(near), plan, self.np.full(len(plan), -1), missed, counts.take(near))

    def tops(self, level: Level, most: int | None = None) -> list[tuple[float, Plans]]:
        """By plan, what the best explanation weighs: its leftmost end scores most."""
        plans = self._names[level.action].plan[self._living(level)[0]]
        plans, first = self.np.unique(plans, return_index=True)
        return [(weight, (plan,)) for weight, plan in zip(self._weights(level)[first].tolist(), plans.tolist())]

    def first_marks(self, level: Level, plan: int, seen: Sequence[Seen]) -> Marks:
        """Every observation is the first leaf that it can be."""
        return leftmost(self.plans[plan], seen)

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By leaf of the last name."""
        (at, counts, _), here = self._living(level), self._names[level.action]
        masses = counts * self._weights(level)
        closed = here.at.take(at) - here.begin.take(at) + 1
        for plan, leaves, mass in zip(here.plan.take(at).tolist(), closed.tolist(), masses.tolist()):
            yield ((plan, (1 << leaves) - 1, self.binding(plan)),), mass


def leaves_by_name(np: Any, plans: Sequence[Plan], lengths: Array) -> dict[str, Leaves]:
    """The leaves of every name; ``lengths``: by plan, how many leaves it has."""
    names = [leaf[0] for plan in plans for leaf in plan.leaves]
    numbers = {name: at for at, name in enumerate(dict.fromkeys(names))}
    symbols = np.fromiter((numbers[name] for name in names), np.int64, len(names))
    ends = np.cumsum(lengths)
    plan_of = np.repeat(np.arange(len(plans)), lengths)
    order = np.argsort(symbols, kind="stable")
    bounds = np.searchsorted(symbols[order], np.arange(len(numbers) + 1))
    found = {}
    for name, number in numbers.items():
        at = order[bounds[number] : bounds[number + 1]]
        plan = plan_of[at]
        found[name] = Leaves(at, (ends - lengths)[plan], plan, ends[plan] - at - 1, lengths[plan] ** 2)
    return found
