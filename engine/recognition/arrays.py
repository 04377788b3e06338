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
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from threading import Lock
from typing import Any, TypeAlias

from casper.engine.recognition.exact import exactly
from casper.engine.recognition.replay import Replay
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Binding, Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

Array: TypeAlias = Any  # numpy.ndarray; numpy is imported when the first large library is read
EXACT_LEAVES = 66  # C(66, 33) < 2**63
KEPT = 24


@dataclass(frozen=True, slots=True)
class Leaves:
    """The leaves of one name, in the order of the library. Shapes: (leaves of the name,), but (plans that have it,)
    for ``first`` (where each such plan begins among them) and ``plans``."""

    at: Array  # number among all leaves
    begin: Array  # number of its plan's first leaf
    plan: Array
    right: Array  # leaves right of it
    square: Array  # of its plan's number of leaves
    first: Array
    plans: Array


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


class Arrays(Replay):
    """Counts for many chains, by names. Interface: `replay.Replay`."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        import numpy as np

        super().__init__(plans, matcher, priors)
        self.np = np
        lengths = np.array([len(plan.leaves) for plan in plans])
        self._type = np.int64 if lengths.max() <= EXACT_LEAVES else object
        self._names = _by_name(np, plans, lengths)
        self._room = KEPT * int(lengths.sum())
        self._kept: OrderedDict[tuple[Any, ...], tuple[Array, ...]] = OrderedDict()
        self._lock = Lock()
        self._index = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}
        self._goal = np.array([self._index[label] for label in self.labels])
        self._own_goal = len(self._index) == len(plans)
        self._prior = np.array(self.priors)
        self._levels: list[tuple[str | None, Array]] = [(None, np.ones(len(plans), self._type))]
        self._alive: tuple[Array, Array, Array] | None = None  # of the last level

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every plan that has the action."""
        np, action = self.np, seen.action
        last, counts = self._levels[-1]
        if last is None:
            following = np.ones(len(self._names[action].at), self._type)
        else:
            upto, since = self._cut(last, action)
            running = np.empty(len(counts) + 1, self._type)
            running[0] = 0
            np.cumsum(counts, out=running[1:])
            following = running.take(upto)
            following -= running.take(since)
        self.observations.append(seen)
        self._levels.append((action, following))
        self._alive = None

    def undo(self) -> None:
        """Take back the last observation."""
        super().undo()
        self._levels.pop()
        self._alive = None

    def fork(self) -> Arrays:
        """A copy that goes its own way; arrays are shared."""
        other = super().fork()
        assert isinstance(other, Arrays)
        other._levels = list(self._levels)
        return other

    def _cut(self, last: str, action: str) -> tuple[Array, ...]:
        """Per leaf of the name: how many leaves of the last name lie left of it, and left of its plan."""
        found = self._kept.get((last, action))
        if found is None:
            before, here = self._names[last], self._names[action]
            search = self.np.searchsorted
            found = self._keep((last, action), (search(before.at, here.at), search(before.at, here.begin)))
        return found

    def _scores(self, action: str, k: int) -> Array:
        """Per leaf of the name: the score of an explanation that ends in it."""
        found = self._kept.get((action, k))
        if found is None:
            here = self._names[action]
            found = self._keep((action, k), (k * (here.right + k) / here.square,))
        return found[0]

    def _keep(self, key: tuple[Any, ...], arrays: tuple[Array, ...]) -> tuple[Array, ...]:
        with self._lock:  # forks share what is kept, and may be used by several threads
            self._kept[key] = arrays
            while sum(len(a) for kept in self._kept.values() for a in kept) > self._room and len(self._kept) > 1:
                self._kept.popitem(last=False)
        return arrays

    # --- what the counts say ---------------------------------------------------------------------------------------

    def alive(self, level: int) -> set[int]:
        """The plans that explain the first so many observations."""
        action, counts = self._levels[level]
        if action is None:
            return set(range(len(self.plans)))
        return set(self._names[action].plan[counts > 0].tolist())

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return exactly(self.np, self._levels[-1][1])

    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""
        found: list[float] = self._sums().tolist()
        return found

    def _sums(self) -> Array:
        np = self.np
        action, _ = self._levels[-1]
        if action is None or not len(self._living()[0]):
            return np.zeros(len(self.plans))
        at, counts, scores = self._living()
        here = self._names[action]
        mass = np.multiply(counts, scores, dtype=float if self._type is not object else object)
        if len(at) == len(here.at):
            sums = np.zeros(len(self.plans))
            sums[here.plans] = np.add.reduceat(mass.astype(float, copy=False), here.first)
            return sums
        return np.bincount(here.plan.take(at), mass.astype(float, copy=False), len(self.plans))

    def _living(self) -> tuple[Array, Array, Array]:
        """The leaves of the last name in which explanations end (numbers among them), how many, and their score."""
        if self._alive is None:
            action, counts = self._levels[-1]
            assert action is not None
            scores = self._scores(action, len(self.observations))
            at = self.np.flatnonzero(counts)
            self._alive = at, counts, scores
            if len(at) < len(counts):
                self._alive = at, counts.take(at), scores.take(at)
        return self._alive

    def total(self) -> float:
        """The sum of all scores, weighed by priors."""
        return float((self._sums() * self._prior).sum())

    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of the sum of all scores, weighed by its prior."""
        sums = self._sums()
        if not self.evenly:
            sums *= self._prior
        if not self._own_goal:
            sums = self.np.bincount(self._goal, sums, len(self._index))
        whole = sums.sum()
        if whole:
            sums /= whole
        return Shares(self._index, sums)

    def _weights(self) -> Array:
        """Of the leaves in which explanations end: their weights."""
        at, _, scores = self._living()
        if self.evenly:
            return scores
        return scores * self._prior[self._names[self._levels[-1][0] or ""].plan.take(at)]

    def best(self) -> tuple[float, int, int, int] | None:
        """The best explanation: weight, plan, leaves right of its last marked one; how many of the library tie."""
        action, _ = self._levels[-1]
        if action is None or not len(self._living()[0]):
            return None
        (at, counts, _), weights, here = self._living(), self._weights(), self._names[action]
        first = int(weights.argmax())
        top = weights[first]
        leaf = at[first]
        return float(top), int(here.plan[leaf]), int(here.right[leaf]), int(counts[weights == top].sum())

    def tops(self) -> list[tuple[float, int, int, int]]:
        """Per plan that explains the observations: weight of its best explanation, plan, leaves right of it, ties."""
        action, _ = self._levels[-1]
        if action is None:
            return []
        (at, counts, _), weights, here = self._living(), self._weights(), self._names[action]
        plans, first = self.np.unique(here.plan[at], return_index=True)  # the leftmost leaf scores most
        right = here.right[at[first]]
        return list(zip(weights[first].tolist(), plans.tolist(), right.tolist(), counts[first].tolist()))

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: (plan, mask of closed leaves, binding), and the share of all scores."""
        action, _ = self._levels[-1]
        if action is None:
            return
        (at, counts, scores), here, whole = self._living(), self._names[action], self.total()
        plans = here.plan.take(at)
        shares = counts * scores * self._prior[plans] / (whole or 1.0)
        closed = here.at.take(at) - here.begin.take(at) + 1
        for plan, leaves, share in zip(plans.tolist(), closed.tolist(), shares.tolist()):
            yield ((plan, (1 << leaves) - 1, self._binding(plan)),), share

    def standing(self) -> Standing | None:
        """The best explanation and its rivals."""
        best = self.best()
        if best is None:
            return None
        top, plan, _, _ = best
        (at, counts, _), here = self._living(), self._names[self._levels[-1][0] or ""]
        ties = self._weights() >= least_tie(top)
        same = ties & (self._goal[here.plan.take(at)] == self._goal[plan])
        missed = (here.at.take(at) - here.begin.take(at))[same].min() + 1 - len(self.observations)
        every = int(counts[ties].sum())
        return Standing(self.count, self.labels[plan], int(missed), every - int(counts[same].sum()), every)


def _by_name(np: Any, plans: Sequence[Plan], lengths: Array) -> dict[str, Leaves]:
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
        own, first = np.unique(plan, return_index=True)
        begin = (ends - lengths)[plan]
        found[name] = Leaves(at, begin, plan, ends[plan] - at - 1, lengths[plan] ** 2, first, own)
    return found
