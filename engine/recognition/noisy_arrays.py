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

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop
from itertools import chain
from typing import Any

from casper.engine.explanation.explanation import Explanation
from casper.engine.recognition.arrays import Array, Shares
from casper.engine.recognition.blocks import Layout, Leaves, Table
from casper.engine.recognition.counting import Counting
from casper.engine.recognition.exact import exactly
from casper.engine.recognition.replay import Replay
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.recognition.states import NEEDLESS
from casper.engine.recognition.tracing import first_marks
from casper.engine.verification.matching import Binding, Matcher, NameMatcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

CLOSE = 1 - 1e-9  # weights this near to the best may be equal to it as floats, now or later


@dataclass(frozen=True, slots=True)
class Ends:
    """Where explanations end, each with what all of them share. Shapes: (ends,)."""

    at: Array  # leaf, as `Leaves.at`
    marked: Array  # observations
    number: Array  # explanations
    weight: Array  # of each of them


@dataclass(frozen=True, slots=True)
class Level:
    """What was counted after an observation. Memory: the counts of its own name, and a number for each plan."""

    counts: dict[str, Array]  # by name seen so far: D on its leaves. Shape (marked, leaves of the name)
    count: int
    most: int  # observations that an explanation marks: weights leave out the price of those that all take for needless
    mass: Array  # by column
    best: Ends  # nearly or quite


class NoisyArrays(Replay):
    """Counts for many chains, by names, where observations may be needless. Interface: `replay.Replay`.

    An observation keeps the counts of its own name, so `undo` is exact and `fork` copies a list. The table in which
    sums are made is one for all forks (as many rows as were ever marked, a number a leaf).

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

        super().__init__(plans, matcher, priors)
        self.np, self.noise = np, noise
        self._layout = Layout(np, plans)
        self._table = Table(self._layout)
        self._index = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}
        self._goal = np.array([self._index[label] for label in self.labels])
        self._prior = np.array(self.priors)[self._layout.order]
        self._powers = np.ones(1)
        none = np.zeros(0, np.int64)
        self._levels = [Level({}, 0, 0, np.zeros(len(plans)), Ends(none, none, none.astype(np.uint16), np.zeros(0)))]

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every plan that has the action; all others take it for needless."""
        before, here = self._levels[-1], self._layout.leaves(seen.action)
        counts = self._table.following(before.counts, here, len(self.observations) + 1)
        count = before.count + exactly(self.np, counts)
        most = max(before.most, len(counts))
        mass = self.noise ** (most - before.most) * before.mass + self._mass(here, counts, most)
        marked = _marked(self.np, counts)
        if seen.action in before.counts:
            earlier = before.counts[seen.action]
            counts[: len(earlier)] += earlier
        best = self._best(before.best, here, marked, counts, most)
        self._levels.append(Level({**before.counts, seen.action: counts}, count, most, mass, best))
        self.observations.append(seen)

    def undo(self) -> None:
        """Take back the last observation."""
        super().undo()
        self._levels.pop()

    def fork(self) -> NoisyArrays:
        """A copy that goes its own way; arrays are shared."""
        other = super().fork()
        assert isinstance(other, NoisyArrays)
        other._levels = list(self._levels)
        return other

    def _mass(self, here: Leaves, counts: Array, most: int) -> Array:
        """Sums of scores by column, of so many explanations that end in leaves of one name."""
        q = self.np.arange(1, len(counts) + 1)
        price = self._prices(q, most)
        once, twice = self.np.stack((price * q, price * q * q)) @ counts.astype(float)
        return self.np.bincount(here.column, (once * here.right + twice) / here.square, len(self.plans))

    def _prices(self, marked: Array, most: int) -> Array:
        """What the needless observations cost where so many were marked, but for those that all take for needless."""
        if len(self._powers) <= most:
            self._powers = self.np.array([self.noise**needless for needless in range(2 * most + 8)], float)
        return self._powers.take(most - marked)

    def _weights(self, column: Array, right: Array, square: Array, marked: Array, most: int) -> Array:
        scores = self._prices(marked, most) * (marked * (right + marked) / square)
        return scores if self.evenly else self._prior.take(column) * scores

    def _weights_at(self, at: Array, marked: Array, most: int) -> Array:
        column, place = self._layout.find(at)
        lengths = self._layout.lengths[column]
        return self._weights(column, lengths - place - 1, lengths * lengths, marked, most)

    def _best(self, before: Ends, here: Leaves, marked: Array, counts: Array, most: int) -> Ends:
        """The ends close to the best: of those before where nothing was marked, and of the leaves of this name."""
        np = self.np
        new = self._weights(here.column, here.right, here.square, marked, most)
        stay = np.flatnonzero(self._layout.codes[before.at] != here.code)
        old = self._weights_at(before.at[stay], before.marked[stay], most)
        least = CLOSE * max(new.max(initial=0.0), old.max(initial=0.0))
        kept, added = np.flatnonzero(old >= least), np.flatnonzero(new >= least)
        parts = (
            (before.at[stay[kept]], here.at[added]),
            (before.marked[stay[kept]], marked[added]),
            (before.number[stay[kept]], counts[marked[added] - 1, added]),
            (old[kept], new[added]),
        )
        return Ends(*map(np.concatenate, parts))

    # --- what the counts say ---------------------------------------------------------------------------------------

    def alive(self, level: int) -> set[int]:
        """The plans with an explanation of the first so many observations: those that have one of the names."""
        found = self.np.full(len(self.plans), not level)
        for name in self._levels[level].counts:
            found[self._layout.order[self._layout.leaves(name).column]] = True
        return set(self.np.flatnonzero(found).tolist())

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return self._levels[-1].count if self.observations else len(self.plans)

    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""
        sums, level = self.np.empty(len(self.plans)), self._levels[-1]
        sums[self._layout.order] = level.mass * self.noise ** (len(self.observations) - level.most)
        found: list[float] = sums.tolist()
        return found

    def total(self) -> float:
        """The sum of all weights."""
        return float((self._levels[-1].mass * self._prior).sum())

    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of the sum of all scores, weighed by its prior."""
        sums = self._levels[-1].mass * self._prior
        shares = self.np.bincount(self._goal[self._layout.order], sums, len(self._index))
        whole = shares.sum()
        return Shares(self._index, shares / whole if whole else shares)

    def _ends(self, furthest: bool = False) -> Ends:
        """Where explanations end, by leaf and number of marks; or only those of each leaf that mark most."""
        np, parts = self.np, [self._levels[0].best]
        for name, counts in self._levels[-1].counts.items():
            marks, leaves = np.nonzero(counts)
            if furthest:
                marks, leaves = _marked(np, counts) - 1, np.arange(counts.shape[1])
            at = self._layout.leaves(name).at[leaves]
            weights = self._weights_at(at, marks + 1, self._levels[-1].most)
            parts.append(Ends(at, marks + 1, counts[marks, leaves], weights))
        return Ends(*(np.concatenate([getattr(part, name) for part in parts]) for name in Ends.__slots__))

    def _plans(self, ends: Ends) -> tuple[Array, Array]:
        """The plans and leaves of ends."""
        column, leaf = self._layout.find(ends.at)
        return self._layout.order[column], leaf

    def _leading(self) -> tuple[Ends, int] | None:
        """The ends of the explanations that tie for the best, and which of them comes first."""
        np, ends = self.np, self._levels[-1].best
        if not len(ends.at):
            return None
        top = ends.weight.max()
        ties = np.flatnonzero(ends.weight >= least_tie(top))
        ends = Ends(ends.at[ties], ends.marked[ties], ends.number[ties], ends.weight[ties])
        plan, leaf = self._plans(ends)
        best = np.flatnonzero(ends.weight == top)
        return ends, int(best[(plan * self._layout.longest + leaf)[best].argmin()])

    def best(self) -> tuple[float, int, int, int] | None:
        """The best explanation: weight, plan, leaves right of its last marked one; how many of the library tie."""
        leading = self._leading()
        if leading is None:
            return None
        ends, first = leading
        plan, leaf = (int(found[first]) for found in self._plans(ends))
        right, ties = len(self.plans[plan].leaves) - leaf - 1, exactly(self.np, ends.number)
        return float(ends.weight[first]), plan, right, ties

    def standing(self) -> Standing | None:
        """The best explanation and its rivals; None when there is none, or nothing was observed."""
        leading = self._leading()
        if leading is None:
            return None
        ends, first = leading
        plan, leaf = self._plans(ends)
        goals = self._goal[plan]
        same = goals == goals[first]
        rivals, ties = exactly(self.np, ends.number[~same]), exactly(self.np, ends.number)
        missed = int((leaf + 1 - ends.marked)[same].min())
        return Standing(self.count, self.labels[plan[first]], missed, rivals, ties)

    def _groups(self) -> Iterator[tuple[int, int, float, int]]:
        """Where explanations end, best first: plan, leaf, weight of each of them, how many."""
        ends = self._ends()
        plan, leaf = self._plans(ends)
        order = self.np.lexsort((leaf, plan, -ends.weight))
        return zip(*(part[order].tolist() for part in (plan, leaf, ends.weight, ends.number)))

    def tops(self) -> list[tuple[float, int, int, int]]:
        """Per plan that explains the observations: weight of its best explanation, plan, leaves right of it, ties."""
        tops: dict[int, tuple[float, int, int, int]] = {}
        for plan, leaf, weight, number in self._groups():
            top = tops.get(plan, (weight, plan, len(self.plans[plan].leaves) - leaf - 1, 0))
            if top[0] == weight:
                tops[plan] = (*top[:3], top[3] + number)
        return list(tops.values())

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end, best first: (plan, mask of closed leaves, binding), and the share of all scores."""
        whole = self.total()
        for plan, leaf, weight, number in self._groups():
            share = weight * number / whole if whole else 0.0
            yield ((plan, (2 << leaf) - 1, self._binding(plan)),), share

    # --- single explanations ---------------------------------------------------------------------------------------

    def counting(self) -> Counting:
        """The same as a `Counting`, which takes uncertain observations too."""
        return self._counted(self.plans, self.matcher, self.priors)

    def _counted(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> Counting:
        counting = Counting(plans, matcher, self.noise, priors)
        for seen in self.observations:
            counting.observe(seen)
        return counting

    def first(self, goal: str | None = None) -> Explanation | None:
        """The best explanation, of all or of one goal; None when there is none."""
        if goal is not None:
            return self.first_of(goal)
        leading = self._leading()
        if leading is None:
            return None
        ends, first = leading
        plan, leaf = self._plans(ends)
        equal = self.np.flatnonzero((plan == plan[first]) & (ends.weight == ends.weight[first])).tolist()
        names, seen = [leaf[0] for leaf in self.plans[plan[first]].leaves], [seen.action for seen in self.observations]
        marks = min(first_marks(names, seen, int(leaf[at]), int(ends.marked[at])) for at in equal)
        return self._explanation(int(plan[first]), marks, self.total())

    def explanations(self) -> Iterator[Explanation]:
        """Every explanation, best first, lazily: by weight, then plan, then marked leaves."""
        best = self.best()
        if best is None:
            return
        whole, heap = self.total(), list[Any]()
        rest = self._alone(best[1], whole)
        yield next(rest)
        self._go_on(heap, best[1], rest)
        for weight, plan in chain(self._others(best[1]), [(-1.0, 0)]):  # nothing weighs as little as the last
            while heap and heap[0][:2] < (-weight / whole, plan):
                _, number, _, found, rest = heappop(heap)
                yield found
                self._go_on(heap, number, rest)
            if weight >= 0:
                self._go_on(heap, plan, self._alone(plan, whole))

    def _others(self, best: int) -> Iterator[tuple[float, int]]:
        """All plans but one with the weights of their best explanations, best first; sorted only when asked for."""
        ends, weights = self._ends(furthest=True), self.np.full(len(self.plans), -1.0)
        self.np.maximum.at(weights, self._plans(ends)[0], ends.weight)
        weights[best] = -1.0
        order = self.np.argsort(-weights, kind="stable")[: int((weights >= 0).sum())]
        return zip(weights[order].tolist(), order.tolist())

    def _alone(self, plan: int, whole: float) -> Iterator[Explanation]:
        """The explanations of one plan, best first."""
        alone = (self.plans[plan],)
        for found in self._counted(alone, NameMatcher(alone)).stream():
            yield self._explanation(plan, found.marks, whole)

    def _explanation(self, plan: int, marks: tuple[int, ...], whole: float) -> Explanation:
        leaves = tuple(leaf for leaf in marks if leaf != NEEDLESS)
        needless = tuple(at for at, leaf in enumerate(marks) if leaf == NEEDLESS)
        marked, length = len(leaves), len(self.plans[plan].leaves)
        score = marked * (length - leaves[-1] - 1 + marked) / (length * length)
        weight = self.priors[plan] * (self.noise ** (self._levels[-1].most - marked) * score)
        share = weight / whole if whole else 0.0
        priced = self.noise ** len(needless) * score if needless else score
        return Explanation(self.plans[plan], leaves, self._binding(plan), priced, share, needless)


def _marked(np: Any, counts: Array) -> Array:
    """By leaf, the most observations that an explanation marks which ends there."""
    return (counts > 0).view(np.int8).sum(axis=0, dtype=np.int32)
