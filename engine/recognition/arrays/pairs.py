"""Up to two goals at once, for many plans that are chains, by names: all pairs in arrays (numpy), exactly.

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
computed as `Interleaving` does, which is the specification. Counts, the best weight and ties are exact, sums of
scores agree to a relative 1e-12. Where nothing may be needless T' is D + D^T, as if needless observations cost
everything: noise is 0. `pair_counts` or `last_pairs` does the sums, `noisy_arrays` or `arrays` those of one goal.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.recognition.arrays.arrays import Arrays
from casper.engine.recognition.arrays.last_pairs import LastPairs
from casper.engine.recognition.arrays.noisy_arrays import CLOSE, NoisyArrays
from casper.engine.recognition.arrays.pair_counts import PairCounts
from casper.engine.recognition.arrays.pair_states import Ends, States, no_ends, wide
from casper.engine.recognition.arrays.shared import Array, OnArrays, Prices, Ties, exactly
from casper.engine.recognition.kernels.kernel import Parts, Plans
from casper.engine.verification.matching import Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan


@dataclass(frozen=True, slots=True)
class Level:
    """What was counted after an observation. Memory: as `PairCounts`, and a number for each pair of plans."""

    k: int
    alone: Any  # the level of explanations of one goal
    counts: PairCounts | LastPairs
    count: int  # explanations of two goals
    most: int  # observations that an explanation marks, of one goal or two
    mass: Array  # shape (plans, plans): by the plan that moved last, and the other
    best: Ends  # nearly or quite


class Pairs(OnArrays[Level]):
    """Counts for one or two goals at once; they are exact beyond 64 bits too, but slow."""

    several = True
    goals = 2

    def __init__(
        self, plans: Sequence[Plan], matcher: Matcher, noise: float | None = None, priors: Sequence[float] | None = None
    ) -> None:
        super().__init__(plans, matcher, noise, priors)
        self.single: Any = Arrays(plans, matcher, priors)
        if noise is not None:
            self.single = NoisyArrays(plans, matcher, noise, priors)
        self.price = noise or 0.0
        self._prices = Prices(self.np, self.price)
        self._states = States(self.np, plans)
        self._square = self.np.add.outer(self._states.lengths, self._states.lengths) ** 2

    def begin(self) -> Level:
        """Nothing is marked."""
        make = LastPairs.start if self.noise is None else PairCounts
        counts = make(self.np, self._states, self.goal[:, None] != self.goal)
        return Level(0, self.single.begin(), counts, 0, 0, self.np.zeros(self._square.shape), no_ends(self.np))

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """The pairs that have the action go on; all others take it for needless."""
        alone = self.single.advance(level.alone, seen, matcher)
        name, k = seen.action, level.k + 1
        if name not in self._states.named:
            return Level(k, alone, level.counts, level.count, level.most, level.mass, level.best)
        counts, rows, added = level.counts.moved(name)
        here, columns = self._states.named[name].at, counts.columns()
        most = max(level.most, k - self.single.least(alone), counts.marked)
        mass = self.price ** (most - level.most) * level.mass + self._mass(here, columns, added, most)
        best = self._best(level.best, counts.furthest(here, columns, rows), here, most)
        number = exactly(self.np, added) + (level.count if self.noise is not None else 0)
        return Level(k, alone, counts, number, most, mass, best)

    def _mass(self, here: Array, columns: Array, added: Array, most: int) -> Array:
        """Sums of scores by pair of plans, of what was added. Shape of that: (here, marked, columns)."""
        np, states = self.np, self._states
        q = np.arange(1, added.shape[1] + 1) if self.noise is not None else np.array([most])
        price = self._prices.of(q, most)
        if len(q) == 1:
            once = added[:, 0] * float(price[0] * q[0])
            number = self._by_plan(once, columns)
            once *= states.right[columns] + q[0]  # in place: these arrays are the largest there are
        else:
            once, twice = (np.stack((price * q, price * q * q)) @ added.astype(float)).transpose(1, 0, 2)
            number = self._by_plan(once, columns)
            once = once * states.right[columns] + twice
        rests = self._by_plan(once, columns) + number * states.right[here][:, None]
        own, first = np.unique(states.plan[here], return_index=True)
        found: Array = np.zeros(self._square.shape)
        found[own] = np.add.reduceat(rests, first, axis=0) / self._square[own]
        return found

    def _by_plan(self, numbers: Array, columns: Array) -> Array:
        """Sums over the columns of each plan. Shapes: (rows, columns) -> (rows, plans)."""
        np, plan = self.np, self._states.plan[columns]
        if (plan[1:] < plan[:-1]).any():
            order = np.argsort(plan, kind="stable")
            numbers, plan = numbers[:, order], plan[order]
        own, first = np.unique(plan, return_index=True)
        found = np.zeros((len(numbers), len(self.plans)))
        found[:, own] = np.add.reduceat(numbers, first, axis=1)
        return found

    def _weights(self, ends: Ends, most: int) -> Array:
        """What each explanation of two goals weighs."""
        states, marked = self._states, ends.marked
        p, q = states.plan[ends.x], states.plan[ends.y]
        scores = marked * (states.right[ends.x] + states.right[ends.y] + marked) / self._square[p, q]
        weights: Array = self._prices.of(marked, most) * scores
        return weights if self.evenly else weights * (self.prior[p] * self.prior[q])

    def _best(self, before: Ends, new: Ends, here: Array, most: int) -> Ends:
        """The ends close to the best: of those before where nothing moved, and of the new ones."""
        if self.noise is not None:
            code, name = self._states.code, self._states.code[here[0]]
            left = before.where((code[before.x] != name) & (code[before.y] != name))
            new = Ends(*map(self.np.concatenate, zip(left, new)))
        weights = self._weights(new, most)
        return new.where(weights >= CLOSE * weights.max(initial=0.0))

    def count(self, level: Level) -> int:
        """Explanations of one goal, and of two."""
        return int(self.single.count(level.alone)) + level.count

    def alive(self, level: Level) -> set[int]:
        """The plans that take part: with needless observations each that does can do so alone."""
        alone: set[int] = self.single.alive(level.alone)
        if self.noise is not None or not level.k:
            return alone
        ends = level.counts.ends()
        return alone | set(self._states.plan[self.np.concatenate((ends.x, ends.y))].tolist())

    def least(self, level: Level) -> int:
        """All but the most that any explanation marks."""
        return level.k - level.most if self.noise is not None else 0

    def _sums(self, level: Level) -> tuple[Array, Array]:
        """Sums of weights: of two plans (each pair in two parts), and of one plan alone."""
        alone = self.single.masses(level.alone) * self._behind(level)
        return level.mass * self.np.multiply.outer(self.prior, self.prior), alone

    def _behind(self, level: Level) -> float:
        """What explanations of one goal weigh less, because they mark fewer observations than those of two."""
        behind: int = level.most - level.k + self.single.least(level.alone)
        return float(self.price**behind)

    def masses(self, level: Level) -> Array:
        pairs, alone = self._sums(level)
        return pairs.sum(axis=0) + pairs.sum(axis=1) + alone

    def total(self, level: Level) -> float:
        return float(sum(part.sum() for part in self._sums(level)))

    def nearest(self, level: Level, most: int | None = None) -> Ties:
        np, states, ends = self.np, self._states, level.best
        alone = self.single.nearest(level.alone, level.most)
        p, q = states.plan[ends.x], states.plan[ends.y]
        missed = states.closed[ends.x] + states.closed[ends.y] - ends.marked
        pairs = (self._weights(ends, level.most), np.minimum(p, q), np.maximum(p, q), missed, ends.number)
        alone = alone._replace(number=wide(np, alone.number))
        return Ties(*map(np.concatenate, zip(alone, pairs)))

    def tops(self, level: Level) -> Iterator[tuple[float, Plans]]:
        """What the explanations weigh that end in two states, and the best of each plan alone."""
        ends = level.counts.ends()
        plans = zip(self._states.plan[ends.x].tolist(), self._states.plan[ends.y].tolist())
        for weight, (p, q) in zip(self._weights(ends, level.most).tolist(), plans):
            yield weight, (min(p, q), max(p, q))
        yield from self.single.tops(level.alone, level.most)

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By plan and leaf of one goal, then by pairs of these."""
        np, size = self.np, len(self._states.plan)
        for parts, mass in self.single.ends(level.alone):
            yield parts, mass * self._behind(level)
        ends = level.counts.ends()
        cells, which = np.unique(ends.x * size + ends.y, return_inverse=True)
        masses = np.bincount(which, self._weights(ends, level.most) * ends.number.astype(float), len(cells))
        plans, closed = self._states.plan.tolist(), self._states.closed.tolist()
        parts_of = [(plan, (1 << leaves) - 1, self.binding(plan)) for plan, leaves in zip(plans, closed)]
        for cell, mass in zip(cells.tolist(), masses.tolist()):
            one, other = sorted((parts_of[cell // size], parts_of[cell % size]))
            yield (one, other), mass
