"""Up to two goals at once, for many plans that are chains, by names: all pairs in one array (numpy), exactly.

The states of a plan are its beginning and its leaves; T[x, y] counts the ways to share the observations out such that
one plan stands in x and another in y. T is symmetric, and zero unless x or y is a leaf of the last name, so only the
rows U = T[A] of those states A are kept. When the next observation has the states B,

    S[x, y] = sum of T[x', y] over the states x' of x's plan left of x      (the observation moves x's plan)
    T[x, y] = S[x, y] + [y in B] S[y, x]                                    for x in B

which is a cumulative sum along each axis of U, and gathers. Explanations of one goal only come from
`arrays`. `interleaving` is the specification.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from heapq import heapify, heappop, heappush
from itertools import count
from typing import Any

from casper.engine.explanation.explanation import Interleaved
from casper.engine.recognition.arrays import Array, Arrays, Shares
from casper.engine.recognition.exact import exactly
from casper.engine.recognition.interleaving import Interleaving
from casper.engine.recognition.levels import positions_of
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Binding, Matcher, Mismatch, NameMatcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan


class Pairs:
    """Counts for one or two goals at once. Interface: `recognisers.Recogniser`."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        import numpy as np

        self.np, self.plans, self.matcher = np, plans, matcher
        self.single = Arrays(plans, matcher, priors)
        self.observations: list[Seen] = []
        self.labels = self.single.labels
        self.index = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}
        self.goal = np.array([self.index[label] for label in self.labels])
        lengths = np.array([len(plan.leaves) for plan in plans])
        self.begin = np.concatenate(([0], np.cumsum(lengths + 1)))[:-1]  # each plan's first state
        self.plan = np.repeat(np.arange(len(plans)), lengths + 1)
        self.right = np.concatenate([np.arange(n, -1, -1) for n in lengths])  # leaves right of each state
        prior = np.array(self.single.priors)
        self.square = np.add.outer(lengths, lengths) ** 2
        self.prior = np.multiply.outer(prior, prior)
        names: dict[str, list[int]] = {}
        for number, plan in enumerate(plans):
            for name, leaves in positions_of(plan).items():
                names.setdefault(name, []).extend(int(self.begin[number]) + leaf + 1 for leaf in leaves)
        self.states = {name: np.array(at) for name, at in names.items()}
        first = np.zeros((len(plans), len(self.plan)), np.int64)
        first[:, self.begin] = self.goal[:, None] != self.goal[None, :]
        self._levels: list[tuple[Array, Array]] = [(self.begin, first)]
        self._sums: tuple[Array, Array] | None = None

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every pair that has the action."""
        np = self.np
        here, before = self._levels[-1]
        there = self.states[seen.action]
        begin = self.begin[self.plan[there]]
        running = np.zeros((len(here) + 1, before.shape[1]), np.int64)
        np.cumsum(before, axis=0, out=running[1:])
        moved = running.take(np.searchsorted(here, there), axis=0)
        moved -= running.take(np.searchsorted(here, begin), axis=0)
        others = before.copy()
        others[:, here] = 0
        np.cumsum(others, axis=1, out=others)
        upto = others.take(there - 1, axis=1)  # a leaf is never the first state
        upto -= np.where(begin > 0, others.take(begin - 1, axis=1), 0)
        moved[:, here] += upto.T
        after = moved.copy()
        after[:, there] += moved[:, there].T
        self._levels.append((there, after))
        self.single.observe(seen)
        self.observations.append(seen)
        self._sums = None

    def undo(self) -> None:
        """Take back the last observation."""
        self.observations.pop()
        self._levels.pop()
        self.single.undo()
        self._sums = None

    def fork(self) -> Pairs:
        """A copy that goes its own way; arrays are shared."""
        other = object.__new__(Pairs)
        other.__dict__.update(self.__dict__)
        other.observations, other._levels = list(self.observations), list(self._levels)
        other.single = self.single.fork()
        return other

    # --- what the counts say ---------------------------------------------------------------------------------------

    @property
    def mismatches(self) -> Sequence[Mapping[int, Sequence[Mismatch]]]:
        """No name ever clashes with a parameter."""
        return self.single.mismatches

    @property
    def is_exact(self) -> bool:
        """Every explanation is counted."""
        return True

    @property
    def count(self) -> int:
        """The exact number of explanations, of one goal or two; before the first observation, of plans."""
        if not self.observations:
            return self.single.count
        here, counts = self._levels[-1]
        np = self.np
        twice = 2 * exactly(np, counts) - 2 * exactly(np, counts[:, self.begin]) - exactly(np, counts[:, here])
        return self.single.count + twice // 2

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations."""
        here, counts = self._levels[level]
        some = counts > 0
        if level:
            some[:, self.begin] = False
        rows, columns = some.any(axis=1), some.any(axis=0)
        found = set(self.plan[here[rows]].tolist()) | set(self.plan[self.np.flatnonzero(columns)].tolist())
        return found | self.single.alive(level)

    def _pair_sums(self) -> tuple[Array, Array]:
        """Sums of the scores of pairs, weighed by priors: by the plan that stands in a leaf of the last name, and the
        other; each explanation once. Shape (plans, plans)."""
        if self._sums is None:
            np, k = self.np, len(self.observations)
            here, counts = self._levels[-1]
            mass = counts.astype(float)
            mass[:, self.begin] = 0.0
            mass[:, here] *= 0.5
            rows = self.plan[here]
            numbers = np.add.reduceat(mass, self.begin, axis=1)  # by leaf of the last name and other plan
            mass *= self.right
            rests = np.add.reduceat(mass, self.begin, axis=1)
            rests += numbers * (k + self.right[here])[:, None]
            sums = np.zeros(self.square.shape)
            own, first = np.unique(rows, return_index=True)
            sums[own] = np.add.reduceat(rests, first, axis=0)
            sums *= k * self.prior / self.square
            self._sums = sums, self.single._sums() * self.single._prior
        return self._sums

    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being among those pursued."""
        np = self.np
        if not self.observations:
            return Shares(self.index, np.zeros(len(self.index)))
        pairs, single = self._pair_sums()
        whole = pairs.sum() + single.sum()
        by_plan = pairs.sum(axis=0) + pairs.sum(axis=1) + single
        shares = np.bincount(self.goal, by_plan, len(self.index))
        return Shares(self.index, shares / whole if whole else shares)

    def total(self) -> float:
        """The sum of all scores, weighed by priors."""
        pairs, single = self._pair_sums()
        return float(pairs.sum() + single.sum())

    def _best_pairs(self) -> Array:
        """The weight of the best explanation of each pair of plans; 0 where there is none. Shape (plans, plans)."""
        np, k = self.np, len(self.observations)
        here, counts = self._levels[-1]
        right = np.where(counts > 0, self.right.astype(np.int32), -1)
        right[:, self.begin] = -1
        best = np.maximum.reduceat(right, self.begin, axis=1).astype(np.int64)
        total = np.where(best >= 0, best + self.right[here][:, None] + k, 0)
        own, first = np.unique(self.plan[here], return_index=True)
        found = np.zeros(self.square.shape, np.int64)
        found[own] = np.maximum.reduceat(total, first, axis=0)
        found = np.maximum(found, found.T)
        weights: Array = self.prior * (k * found / self.square)
        return weights

    def standing(self) -> Standing | None:
        """The best explanation and its rivals, of other sets of goals."""
        if not self.observations:
            return None
        np, pairs, single = self.np, self._best_pairs(), self.single.best()
        top = max(float(pairs.max()), single[0] if single is not None else 0.0)
        if not top:
            return None
        least = least_tie(top)
        best: dict[tuple[int, ...], tuple[float, int, int]] = {}  # by plans: weight, how many, and leaves left open
        for weight, plan, left, number in (entry for entry in self.single.tops() if entry[0] >= least):
            best[(plan,)] = (weight, number, left)
        for p, q in np.argwhere(np.triu(pairs >= least)).tolist():
            best[p, q] = (float(pairs[p, q]), *self._ties(p, q, least))
        plans = min(plans for plans, (weight, _, _) in best.items() if weight == top)
        goals, k = self._goals(plans), len(self.observations)
        same = {others: left for others, (_, _, left) in best.items() if self._goals(others) == goals}
        missed = min(sum(len(self.plans[plan].leaves) for plan in others) - left - k for others, left in same.items())
        rivals = sum(number for others, (_, number, _) in best.items() if self._goals(others) != goals)
        return Standing(self.count, " + ".join(goals), missed, rivals, sum(number for _, number, _ in best.values()))

    def _goals(self, plans: tuple[int, ...]) -> tuple[str, ...]:
        return tuple(sorted((self.labels[plan] for plan in plans), key=self.index.__getitem__))

    def _ties(self, p: int, q: int, least: float) -> tuple[int, int]:
        """How many explanations of the two plans weigh as much as the best, and how many leaves these leave open."""
        k, found, left = len(self.observations), 0, 0
        for x, y, number in self._cells(p, q):
            open_leaves = int(self.right[x] + self.right[y])
            if self.prior[p, q] * (k * (open_leaves + k) / self.square[p, q]) >= least:
                found, left = found + number, open_leaves
        return found, left

    def _cells(self, p: int, q: int) -> Iterator[tuple[int, int, int]]:
        """The states of two plans with explanations, both begun: state, state, count."""
        here, counts = self._levels[-1]
        for a, b in ((p, q), (q, p)):
            rows = self.np.flatnonzero(self.plan[here] == a)
            begin = int(self.begin[b])
            for row in rows.tolist():
                for y in range(begin + 1, begin + len(self.plans[b].leaves) + 1):
                    x = int(here[row])
                    both = y in here  # then the cell comes again with its plans the other way round
                    if counts[row, y] and not (both and (a, b) == (q, p)):
                        yield x, y, int(counts[row, y])

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""
        k, whole = len(self.observations), self.total()
        alone = float(self._pair_sums()[1].sum())
        for parts, share in self.single.ends():
            yield parts, share * alone / whole if whole else 0.0
        for p, q in self.np.argwhere(self.np.triu(self._best_pairs() > 0)).tolist():
            for x, y, number in self._cells(p, q):
                score = k * (int(self.right[x] + self.right[y]) + k) / int(self.square[p, q])
                parts = tuple(sorted(self._part(state) for state in (x, y)))
                yield parts, number * score * float(self.prior[p, q]) / whole

    def _part(self, state: int) -> tuple[int, int, Binding]:
        plan = int(self.plan[state])
        return plan, (1 << state - int(self.begin[plan])) - 1, self.single._binding(plan)

    def first(self, goal: str | None = None) -> Interleaved | None:
        """The best explanation, of all or of a goal (goals pursued together are joined by " + "); None for none."""
        return next(self._told(goal), None)

    def explanations(self) -> Iterator[Interleaved]:
        """Every explanation, best first, lazily."""
        return self._told(None)

    def _told(self, goal: str | None) -> Iterator[Interleaved]:
        whole, order = self.total(), count()
        heap: list[tuple[float, tuple[int, ...], int, Interleaved | None, Iterator[Interleaved]]] = []
        best = self._best_pairs()
        for p, q in self.np.argwhere(self.np.triu(best > 0)).tolist():
            heap.append((-float(best[p, q]), (p, q), next(order), None, self._together((p, q), whole)))
        for weight, plan, _, _ in self.single.tops():
            heap.append((-weight, (plan,), next(order), None, self._together((plan,), whole)))
        if goal is not None:
            heap = [entry for entry in heap if " + ".join(self._goals(entry[1])) == goal]
        heapify(heap)
        while heap:
            _, plans, _, found, rest = heappop(heap)
            if found is not None:
                yield found
            following = next(rest, None)
            if following is not None:
                weight = following.score * self._prior_of(plans)
                heappush(heap, (-weight, plans, next(order), following, rest))

    def _prior_of(self, plans: tuple[int, ...]) -> float:
        return float(self.prior[plans]) if len(plans) == 2 else self.single.priors[plans[0]]

    def _together(self, plans: tuple[int, ...], whole: float) -> Iterator[Interleaved]:
        """The explanations of exactly these plans, best first."""
        chosen = [self.plans[plan] for plan in plans]
        engine = Interleaving(chosen, NameMatcher(chosen), len(plans))
        for seen in self.observations:
            engine.observe(seen)
        for found in engine.explanations():
            if len(found.parts) == len(plans):
                share = found.score * self._prior_of(plans) / whole
                parts = zip(plans, found.parts)
                told = (replace(part, share=share, binding=self.single._binding(plan)) for plan, part in parts)
                yield Interleaved(tuple(sorted(told, key=lambda part: self.index[part.goal])), found.score, share)

    def interleaving(self) -> Interleaving:
        """The same as an `Interleaving`, which takes uncertain observations too."""
        engine = Interleaving(self.plans, self.matcher, 2, priors=self.single.priors)
        for seen in self.observations:
            engine.observe(seen)
        return engine



def fits(plans: Sequence[Plan], most: int = 40_000_000) -> bool:
    """Whether all pairs of the plans' states can be held in an array, and every count in 64 bits."""
    lengths = [len(plan.leaves) for plan in plans]
    names: dict[Any, int] = {}
    for plan in plans:
        for leaf in plan.leaves:
            names[leaf[0]] = names.get(leaf[0], 0) + 1
    return sum(sorted(lengths)[-2:]) <= 66 and max(names.values()) * (sum(lengths) + len(plans)) <= most
