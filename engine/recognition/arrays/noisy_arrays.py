"""Needless observations for chains by names: the leaves of all goals in arrays (numpy).

Let D[q, j] be the number of explanations that mark q observations and take the last of these for leaf j. Observing o
changes D on the leaves named o only, an observation that is needless changes nothing:

    D'[q, j] = D[q, j] + d[q, j]        d[q, j] = [q = 1] + sum of D[q - 1, i] over the leaves i < j of j's plan

With n leaves in the plan, r of them right of j, and m the most observations that any explanation marks (all take the
others for needless, so their price is left out) each of them weighs prior * W[q, j], where

    W[q, j] = noise^(m - q) * q (r + q) / n^2        mass' = noise^(m' - m) * mass + sum of d[q, j] W[q, j]

and mass is a plan's sum of such scores. Of the explanations that end in j the best marks most: W grows with q, and
D[q, j] > 0 follows from D[q + 1, j] > 0 (mark one less, at the beginning). So what is best can only change on the
leaves named o. Those close to the best are kept from one observation to the next, since a leaf that is left behind can
only catch up by a mark; among them floats decide, computed as `counting` does. Counts, the best explanation and
ties are exact, sums of scores agree to a relative 1e-12.
`blocks` does the sums.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from casper.engine.recognition.arrays.blocks import Layout, Leaves, Table
from casper.engine.recognition.arrays.shared import Array, OnArrays, Prices, Ties, exactly
from casper.engine.recognition.kernels.kernel import Marks, Parts, Plans
from casper.engine.recognition.kernels.marks import first_marks
from casper.engine.verification.matching import Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

CLOSE = 1 - 1e-9  # weights this near to the best may be equal to it as floats, now or later


class Ends(NamedTuple):
    """Where explanations end, each with what all of them share. Shapes: (ends,)."""

    at: Array  # leaf, as `Leaves.at`
    marked: Array  # observations
    number: Array  # explanations
    weight: Array  # of each of them


@dataclass(frozen=True, slots=True)
class Level:
    """What was counted after an observation. Memory: the counts of its own name, and a number for each plan."""

    k: int
    counts: dict[str, Array]  # by name seen so far: D on its leaves. Shape (marked, leaves of the name)
    count: int
    most: int  # observations that an explanation marks: weights leave out the price of those that all take for needless
    mass: Array  # by column
    best: Ends  # nearly or quite


class NoisyArrays(OnArrays[Level]):
    """Counts for many chains, by names, where observations may be needless.

    An observation keeps the counts of its own name. The table in which sums are made is one for all forks (as many
    rows as were ever marked, a number a leaf).
    """

    def __init__(
        self, plans: Sequence[Plan], matcher: Matcher, noise: float, priors: Sequence[float] | None = None
    ) -> None:
        super().__init__(plans, matcher, noise, priors)
        self.price, self._prices = noise, Prices(self.np, noise)
        self._layout = Layout(self.np, plans)
        self._table = Table(self._layout)
        self._prior = self.prior[self._layout.order]  # by column

    def begin(self) -> Level:
        """Nothing is marked."""
        none = self.np.zeros(0, self.np.int64)
        nowhere = Ends(none, none, none.astype(self.np.uint16), self.np.zeros(0))
        return Level(0, {}, 0, 0, self.np.zeros(len(self.plans)), nowhere)

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """The plans that have the action go on; all others take it for needless."""
        here = self._layout.leaves(seen.action)
        counts = self._table.following(level.counts, here, level.k + 1)
        count = level.count + exactly(self.np, counts)
        most = max(level.most, len(counts))
        mass = self.price ** (most - level.most) * level.mass + self._mass(here, counts, most)
        marked = (counts > 0).view(self.np.int8).sum(axis=0, dtype=self.np.int32)  # at most, by leaf
        if seen.action in level.counts:
            earlier = level.counts[seen.action]
            counts[: len(earlier)] += earlier
        best = self._best(level.best, here, marked, counts, most)
        return Level(level.k + 1, {**level.counts, seen.action: counts}, count, most, mass, best)

    def _mass(self, here: Leaves, counts: Array, most: int) -> Array:
        """Sums of scores by column, of so many explanations that end in leaves of one name."""
        q = self.np.arange(1, len(counts) + 1)
        price = self._prices.of(q, most)
        once, twice = self.np.stack((price * q, price * q * q)) @ counts.astype(float)
        return self.np.bincount(here.column, (once * here.right + twice) / here.square, len(self.plans))

    def _weights(self, column: Array, right: Array, square: Array, marked: Array, most: int) -> Array:
        scores = self._prices.of(marked, most) * (marked * (right + marked) / square)
        return scores if self.evenly else self._prior.take(column) * scores

    def weights_at(self, at: Array, marked: Array, most: int) -> Array:
        """What explanations weigh that end in these leaves, when that many observations are marked at most."""
        column, place = self._layout.find(at)
        lengths = self._layout.lengths[column]
        return self._weights(column, lengths - place - 1, lengths * lengths, marked, most)

    def _best(self, before: Ends, here: Leaves, marked: Array, counts: Array, most: int) -> Ends:
        """The ends close to the best: of those before where nothing was marked, and of the leaves of this name."""
        np = self.np
        new = self._weights(here.column, here.right, here.square, marked, most)
        stay = np.flatnonzero(self._layout.codes[before.at] != here.code)
        old = self.weights_at(before.at[stay], before.marked[stay], most)
        least = CLOSE * max(new.max(initial=0.0), old.max(initial=0.0))
        kept, added = np.flatnonzero(old >= least), np.flatnonzero(new >= least)
        stay = stay[kept]
        left = Ends(before.at[stay], before.marked[stay], before.number[stay], old[kept])
        come = Ends(here.at[added], marked[added], counts[marked[added] - 1, added], new[added])
        return Ends(*map(np.concatenate, zip(left, come)))

    def alive(self, level: Level) -> set[int]:
        """The plans that have one of the names."""
        found = self.np.full(len(self.plans), not level.k)
        for name in level.counts:
            found[self._layout.order[self._layout.leaves(name).column]] = True
        return set(self.np.flatnonzero(found).tolist())

    def count(self, level: Level) -> int:
        """All that were ever counted: an explanation stays one, by taking what comes for needless."""
        return level.count if level.k else len(self.plans)

    def least(self, level: Level) -> int:
        """All but the most that any explanation marks."""
        return level.k - level.most

    def masses(self, level: Level) -> Array:
        found = self.np.empty(len(self.plans))
        found[self._layout.order] = level.mass * self._prior
        return found

    def _ends(self, level: Level, most: int | None = None) -> Ends:
        """Where explanations end, by leaf and number of marks."""
        np, parts = self.np, [self.begin().best]
        for name, counts in level.counts.items():
            marks, leaves = np.nonzero(counts)
            at = self._layout.leaves(name).at[leaves]
            weights = self.weights_at(at, marks + 1, level.most if most is None else most)
            parts.append(Ends(at, marks + 1, counts[marks, leaves], weights))
        return Ends(*map(np.concatenate, zip(*parts)))

    def _plans(self, ends: Ends) -> tuple[Array, Array]:
        """The plans and leaves of ends."""
        column, leaf = self._layout.find(ends.at)
        return self._layout.order[column], leaf

    def nearest(self, level: Level, most: int | None = None) -> Ties:
        ends = level.best
        plan, leaf = self._plans(ends)
        weight = ends.weight if most in (None, level.most) else self.weights_at(ends.at, ends.marked, most or 0)
        return Ties(weight, plan, self.np.full(len(plan), -1), leaf + 1 - ends.marked, ends.number)

    def tops(self, level: Level, most: int | None = None) -> list[tuple[float, Plans]]:
        ends, weights = self._ends(level, most), self.np.full(len(self.plans), -1.0)
        self.np.maximum.at(weights, self._plans(ends)[0], ends.weight)
        plans = self.np.flatnonzero(weights >= 0)
        return [(weight, (plan,)) for weight, plan in zip(weights[plans].tolist(), plans.tolist())]

    def first_marks(self, level: Level, plan: int, seen: Sequence[Seen]) -> Marks | None:
        """Of the places where the plan's best explanations end, the one that is reached by the first marks."""
        best = level.best
        plans, leaves = self._plans(best)
        ours = self.np.flatnonzero(plans == plan)
        if not len(ours):
            return None
        top = best.weight[ours].max()
        names, observed = [leaf[0] for leaf in self.plans[plan].leaves], [one.action for one in seen]
        return min(
            first_marks(names, observed, int(leaves[at]), int(best.marked[at]))
            for at in ours.tolist() if best.weight[at] == top
        )  # fmt: skip

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By leaf and number of marks, best first."""
        ends = self._ends(level)
        plan, leaf = self._plans(ends)
        order = self.np.lexsort((leaf, plan, -ends.weight))
        masses = ends.weight * ends.number.astype(float)
        for one, last, mass in zip(*(part[order].tolist() for part in (plan, leaf, masses))):
            yield ((one, (2 << last) - 1, self.binding(one)),), mass
