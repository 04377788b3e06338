"""Up to two goals at once, for many plans that are chains, by names, where observations may be needless (numpy): exact.

The states of a plan are its beginning and its leaves; T_q[x, y] counts the ways to have marked q observations such that
one plan stands in x and another, of another goal, in y. T is symmetric, T_0 is 1 for two beginnings. Observing o,

    D_q[x, y] = [x in o] * sum of T_{q-1}[x', y] over the states x' of x's plan left of x          T' = T + D + D^T

and a needless observation moves nothing. Every new explanation of two goals is counted by one entry of D with y begun.
Let n = n_p + n_q be the leaves of its plans, r those right of x and y, and m the most observations that any explanation
marks (all take the others for needless, so their price is left out). Then it weighs prior_p * prior_q * W_q[x, y], with

    W_q[x, y] = noise^(m - q) * q (r + q) / n^2        mass' = noise^(m' - m) * mass + sum of D_q[x, y] W_q[x, y]

where mass is, by pair of plans, the sum of such scores. W grows with q. So of the explanations that end in x and y the
best mark most, and what is best can only change in the rows of o; the ends close to the best are kept from one
observation to the next, since an end that is left behind can only catch up by a mark. Among them floats decide,
computed as `interleaving` does, which is the specification. Counts, the best weight and ties are exact, sums of
scores agree to a relative 1e-12. `pair_counts` does the sums, `noisy_arrays` explanations of one goal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import count
from math import prod
from typing import TypeAlias

from casper.engine.explanation.explanation import Interleaved
from casper.engine.recognition.arrays import Array, Shares
from casper.engine.recognition.exact import exactly
from casper.engine.recognition.interleaving import Interleaving
from casper.engine.recognition.noisy_arrays import CLOSE, NoisyArrays
from casper.engine.recognition.pair_counts import Ends, PairCounts, States, memory, no_ends, wide
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Binding, Matcher, Mismatch, NameMatcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

UNBOUNDED = 1 << 60  # hypotheses
Listed: TypeAlias = Iterator[tuple[float, Interleaved]]  # weights and explanations, best first


@dataclass(frozen=True, slots=True)
class Level:
    """What was counted after an observation. Memory: as `PairCounts`, and a number for each pair of plans."""

    counts: PairCounts
    count: int  # explanations of two goals
    most: int  # observations that an explanation marks, of one goal or two
    mass: Array  # shape (plans, plans): by the plan that moved last, and the other
    best: Ends  # nearly or quite


@dataclass(frozen=True)
class Ties:
    """Where explanations end that tie for the best. Shapes: (ends,)."""

    p: Array  # plan
    q: Array  # the plan of the second goal, which comes later in the library; -1 for none
    missed: Array  # leaves
    number: Array  # explanations
    weight: Array  # of each of them

    @cached_property
    def first(self) -> int:
        """The one that comes first: by weight, then plans."""
        ends = (-self.weight).tolist(), self.p.tolist(), self.q.tolist(), range(len(self.p))
        return min(zip(*ends))[3]

    @property
    def plans(self) -> tuple[int, ...]:
        """The plans of the one that comes first."""
        p, q = int(self.p[self.first]), int(self.q[self.first])
        return (p, q) if q >= 0 else (p,)


class NoisyPairs:
    """Counts for one or two goals at once. Interface: `recognisers.Recogniser`.

    A level is never changed once made, and shares what its observation left as it was; so `undo` is exact, and `fork`
    copies a list. Counts are exact beyond 64 bits too, but slow.

    Args:
        plans: the plans, all of them chains.
        matcher: by names.
        noise: the factor on a score for each needless observation, above 0 and at most 1.
        priors: per plan the prior of its goal.
    """

    def __init__(
        self, plans: Sequence[Plan], matcher: Matcher, noise: float, priors: Sequence[float] | None = None
    ) -> None:
        import numpy as np

        self.np, self.plans, self.matcher, self.noise = np, plans, matcher, noise
        self.single = NoisyArrays(plans, matcher, noise, priors)
        self.observations: list[Seen] = []
        self.labels, self.priors = self.single.labels, self.single.priors
        self._index = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}
        self._goal = np.array([self._index[label] for label in self.labels])
        self._prior = np.array(self.priors, float)
        self._states = States(np, plans)
        self._square = np.add.outer(self._states.lengths, self._states.lengths) ** 2
        self._powers = np.ones(1)
        counts = PairCounts(np, self._states, self._goal[:, None] != self._goal)
        self._levels = [Level(counts, 0, 0, np.zeros(self._square.shape), no_ends(np))]

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every pair that has the action; all others take it for needless."""
        level, single = self._levels[-1], self.single.fork()
        single.observe(seen)
        if seen.action in self._states.named:
            level = self._moved(level, seen.action, single._levels[-1].most)
        self.single = single  # from here on nothing can go wrong: an observation is taken in or not
        self._levels.append(level)
        self.observations.append(seen)

    def _moved(self, before: Level, name: str, alone: int) -> Level:
        """What follows on an action that some plan has; one plan alone can mark so many."""
        counts, rows, added = before.counts.moved(name)
        here, columns = self._states.named[name].at, counts.columns()
        most = max(before.most, alone, counts.marked)
        mass = self.noise ** (most - before.most) * before.mass + self._mass(here, columns, added, most)
        best = self._best(before.best, counts.furthest(here, columns, rows), here, most)
        return Level(counts, before.count + exactly(self.np, added), most, mass, best)

    def undo(self) -> None:
        """Take back the last observation."""
        self.single.undo()
        self._levels.pop()
        self.observations.pop()

    def fork(self) -> NoisyPairs:
        """A copy that goes its own way; arrays are shared."""
        other = object.__new__(NoisyPairs)
        other.__dict__.update(self.__dict__)
        other.observations, other._levels = list(self.observations), list(self._levels)
        other.single = self.single.fork()
        return other

    def _mass(self, here: Array, columns: Array, added: Array, most: int) -> Array:
        """Sums of scores by pair of plans, of what was added. Shape of that: (here, marked, columns)."""
        np, states, plans = self.np, self._states, len(self.plans)
        q = np.arange(1, added.shape[1] + 1)
        price = self._prices(q, most)
        sums = np.stack((price * q, price * q * q)) @ added.astype(float)
        scores = sums[:, 0] * np.add.outer(states.right[here], states.right[columns]) + sums[:, 1]
        pair = np.add.outer(states.plan[here] * plans, states.plan[columns])
        found: Array = np.bincount(pair.ravel(), scores.ravel(), plans * plans).reshape(plans, plans) / self._square
        return found

    def _prices(self, marked: Array, most: int) -> Array:
        """What the needless observations cost where so many were marked, but for those that all take for needless."""
        if len(self._powers) <= most:
            self._powers = self.np.array([self.noise**needless for needless in range(2 * most + 8)], float)
        return self._powers.take(most - marked)

    def _weights(self, ends: Ends, most: int) -> Array:
        """What each explanation of two goals weighs."""
        states, marked = self._states, ends.marked
        p, q = states.plan[ends.x], states.plan[ends.y]
        scores = marked * (states.right[ends.x] + states.right[ends.y] + marked) / self._square[p, q]
        weights: Array = self._prices(marked, most) * scores
        return weights if self.single.evenly else weights * (self._prior[p] * self._prior[q])

    def _best(self, before: Ends, new: Ends, here: Array, most: int) -> Ends:
        """The ends close to the best: of those before where nothing moved, and of the new ones."""
        code, name = self._states.code, self._states.code[here[0]]
        ends = Ends.joined(self.np, [before.where((code[before.x] != name) & (code[before.y] != name)), new])
        weights = self._weights(ends, most)
        return ends.where(weights >= CLOSE * weights.max(initial=0.0))

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
        return self.single.count + self._levels[-1].count

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations: each can do so alone."""
        return self.single.alive(level)

    def _sums(self) -> tuple[Array, Array]:
        """Sums of weights: of two plans (each pair in two parts), and of one plan alone."""
        level, alone = self._levels[-1], self.single._levels[-1]
        sums = self.np.empty(len(self.plans))
        sums[self.single._layout.order] = self.noise ** (level.most - alone.most) * alone.mass
        return level.mass * self.np.multiply.outer(self._prior, self._prior), sums * self._prior

    def total(self) -> float:
        """The sum of all weights."""
        return float(sum(part.sum() for part in self._sums()))

    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being among those pursued."""
        pairs, alone = self._sums()
        whole = pairs.sum() + alone.sum()
        shares = self.np.bincount(self._goal, pairs.sum(axis=0) + pairs.sum(axis=1) + alone, len(self._index))
        return Shares(self._index, shares / whole if whole else shares)

    def _ties(self) -> Ties | None:
        """The ends of all explanations, of one goal or two, that tie for the best; None when there is none."""
        np, states, level = self.np, self._states, self._levels[-1]
        pairs, alone = level.best, self.single._levels[-1].best
        if not len(alone.at):  # then no plan has any of the names
            return None
        (plan, leaf), marked = self.single._plans(alone), alone.marked.astype(np.int64)
        p, q = states.plan[pairs.x], states.plan[pairs.y]
        parts = (
            (plan, np.minimum(p, q)),
            (np.full(len(plan), -1), np.maximum(p, q)),
            (leaf + 1 - marked, states.closed[pairs.x] + states.closed[pairs.y] - pairs.marked),
            (wide(np, alone.number), pairs.number),
            (self.single._weights_at(alone.at, marked, level.most), self._weights(pairs, level.most)),
        )
        found = [np.concatenate(part) for part in parts]
        ties = found[-1] >= least_tie(found[-1].max())
        return Ties(*(part[ties] for part in found))

    def standing(self) -> Standing | None:
        """The best explanation and its rivals, of other sets of goals."""
        ties = self._ties()
        if ties is None:
            return None
        one, other = self._goal[ties.p], self.np.where(ties.q < 0, -1, self._goal[ties.q])
        low, high = self.np.minimum(one, other), self.np.maximum(one, other)
        same = (low == low[ties.first]) & (high == high[ties.first])
        rivals, every = exactly(self.np, ties.number[~same]), exactly(self.np, ties.number)
        return Standing(self.count, self._goals(ties.plans), int(ties.missed[same].min()), rivals, every)

    def _goals(self, plans: tuple[int, ...]) -> str:
        return " + ".join(sorted((self.labels[plan] for plan in plans), key=self._index.__getitem__))

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""
        np, whole, size = self.np, self.total() or 1.0, len(self._states.plan)
        alone = float(self._sums()[1].sum())
        for parts, share in self.single.ends():
            yield parts, share * alone / whole
        ends = self._levels[-1].counts.ends()
        cells, which = np.unique(ends.x * size + ends.y, return_inverse=True)
        weights = self._weights(ends, self._levels[-1].most) * ends.number.astype(float)
        shares = np.bincount(which, weights, len(cells)) / whole
        parts_of = [self._part(state) for state in range(size)]
        for cell, share in zip(cells.tolist(), shares.tolist()):
            one, other = sorted((parts_of[cell // size], parts_of[cell % size]))
            yield (one, other), share

    def _part(self, state: int) -> tuple[int, int, Binding]:
        plan = int(self._states.plan[state])
        return plan, (1 << int(self._states.closed[state])) - 1, self.single._binding(plan)

    # --- single explanations ---------------------------------------------------------------------------------------

    def first(self, goal: str | None = None) -> Interleaved | None:
        """The best explanation, of all or of a goal (goals pursued together are joined by " + "); None for none."""
        if goal is None:
            ties = self._ties()
            plans = None if ties is None else ties.plans
        else:
            tops = ((-weight, plans) for weight, plans in self._tops() if self._goals(plans) == goal)
            plans = min(tops, default=(0.0, None))[1]
        return None if plans is None else next(self._listed(plans, self.total()))[1]

    def explanations(self) -> Iterator[Interleaved]:
        """Every explanation, best first, lazily: by weight, then plans, then marks."""
        whole, order = self.total(), count()
        heap: list[tuple[float, tuple[int, ...], int, Interleaved | None, Listed]] = [
            (-weight, plans, next(order), None, self._listed(plans, whole)) for weight, plans in self._tops()
        ]
        heapify(heap)
        while heap:
            _, plans, _, found, rest = heappop(heap)
            if found is not None:
                yield found
            weight, following = next(rest, (0.0, None))
            if following is not None:
                heappush(heap, (-weight, plans, next(order), following, rest))

    def _tops(self) -> Iterator[tuple[float, tuple[int, ...]]]:
        """The weight of the best explanation of each plan, and of each pair of plans that explains anything."""
        np, size, most = self.np, len(self.plans), self._levels[-1].most
        ends, alone = self._levels[-1].counts.ends(), self.single._ends()
        p, q = self._states.plan[ends.x], self._states.plan[ends.y]
        best = np.full((size + 1) * size, -1.0)
        np.maximum.at(best, np.minimum(p, q) * size + np.maximum(p, q), self._weights(ends, most))
        weights = self.single._weights_at(alone.at, alone.marked.astype(np.int64), most)
        np.maximum.at(best, size * size + self.single._plans(alone)[0], weights)
        for at in np.flatnonzero(best >= 0).tolist():
            p, q = divmod(at, size)
            yield float(best[at]), (p, q) if p < size else (q,)

    def _listed(self, plans: tuple[int, ...], whole: float) -> Listed:
        """The explanations of exactly these plans, best first, with their weights."""
        chosen = [self.plans[plan] for plan in plans]
        engine = Interleaving(chosen, NameMatcher(chosen), len(plans), self.noise, budget=UNBOUNDED)
        for seen in self.observations:
            engine.observe(seen)
        level = engine._levels[-1]
        engine._levels[-1] = {hypothesis: level[hypothesis] for hypothesis in level if len(hypothesis[0]) == len(plans)}
        for found in engine.explanations():
            weight = self._weight(plans, found)
            share = weight / whole if whole else 0.0
            parts = zip(plans, found.parts)
            told = (replace(part, binding=self.single._binding(plan), share=share) for plan, part in parts)
            ordered = tuple(sorted(told, key=lambda part: self._index[part.goal]))
            yield weight, Interleaved(ordered, found.score, share, found.needless)

    def _weight(self, plans: tuple[int, ...], found: Interleaved) -> float:
        marked, n = sum(len(part.marks) for part in found.parts), sum(len(self.plans[plan].leaves) for plan in plans)
        right = n - sum(part.marks[-1] + 1 for part in found.parts)
        price = self.noise ** (self._levels[-1].most - marked)
        return price * (marked * (right + marked) / (n * n)) * prod(self.priors[plan] for plan in plans)

    def interleaving(self) -> Interleaving:
        """The same as an `Interleaving`, which takes uncertain observations too."""
        engine = Interleaving(self.plans, self.matcher, 2, self.noise, self.priors)
        for seen in self.observations:
            engine.observe(seen)
        return engine


def fits(plans: Sequence[Plan], most: int = 1_000_000_000) -> bool:
    """Whether sixteen observations of the commonest name take so few bytes."""
    return memory(plans, 16) <= most
