"""Counting by names, for small libraries of plans whose actions simply follow one another: plain Python, a few µs.

Between two observations a and b a plan's counts only move from its leaves named a to its leaves named b. So a *table*
is made once for each ordered pair of names that occurs: how many of the plan's a-leaves lie left of each b-leaf. With
the counts kept as running sums, an update is one look-up for each b-leaf, and the sum of a plan's scores is

    k/n^2 * sum_i C[i] * (right[i] + k)        right[i]: the leaves right of the i-th b-leaf

`counting` is the specification.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from casper.engine.recognition.levels import positions_of
from casper.engine.recognition.replay import Replay
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.verification.matching import Binding, Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

Row: TypeAlias = tuple[int, int, tuple[tuple[int, int], ...]]
"""Plan, the square of its length; for each of its leaves of this name: how many leaves of the last name lie left of
it, and how many leaves of any name right."""
Standings: TypeAlias = list[tuple[int, float, int, int, int]]
"""For each plan that explains the observations: plan, sum of scores, count, leaves right of the best explanation's
last marked leaf, how many explanations are as good."""
Level: TypeAlias = tuple[str | None, dict[int, list[int]], Standings, float]
"""The last name, each plan's counts as running sums over its leaves of that name, what follows from them, and the sum
of all scores, weighed by priors."""


class Chains(Replay):
    """Counts for chains, by names. Interface: `replay.Replay`."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        super().__init__(plans, matcher, priors)
        self._positions = [positions_of(plan) for plan in plans]
        self._squares = [len(plan.leaves) ** 2 for plan in plans]
        self._tables: dict[tuple[str | None, str], list[Row]] = {}
        self._is_simple = self.evenly and len(set(self.labels)) == len(plans)
        self._nothing = dict.fromkeys(self.labels, 0.0)
        begin: Standings = [(plan, 0.0, 1, len(plans[plan].leaves), 1) for plan in range(len(plans))]
        self._levels: list[Level] = [(None, {plan: [0, 1] for plan in range(len(plans))}, begin, 0.0)]
        self._first: dict[str, Level] = {}  # by action: the level after it alone

    def observe(self, seen: Seen) -> None:
        """Advance every plan that has the action."""
        action = seen.action
        if self.observations:
            level = self._advanced(action)
        else:  # all counts are one: nothing depends on what was before
            known = self._first.get(action)
            level = self._first[action] = self._advanced(action) if known is None else known
        self._levels.append(level)
        self.observations.append(seen)

    def _advanced(self, action: str) -> Level:
        last, before, _, _ = self._levels[-1]
        rows = self._tables.get((last, action))
        if rows is None:
            rows = self._table(last, action)
        k, whole, priors = len(self.observations) + 1, 0.0, self.priors
        running: dict[int, list[int]] = {}
        standings: Standings = []
        for plan, square, moves in rows:
            old = before.get(plan)
            if old is not None:
                sums = [0]
                count = total = left = ties = 0
                for cut, right in moves:
                    here = old[cut]
                    if here:
                        if not count:
                            left, ties = right, here
                        count += here
                        total += here * right
                    sums.append(count)
                if count:
                    running[plan] = sums
                    scores = k * (total + k * count) / square
                    standings.append((plan, scores, count, left, ties))
                    whole += priors[plan] * scores
        return action, running, standings, whole

    def _table(self, last: str | None, action: str) -> list[Row]:
        rows: list[Row] = []
        for plan, positions in enumerate(self._positions):
            here = positions.get(action)
            earlier = [-1] if last is None else positions.get(last, [])
            if here and earlier:
                leaves = len(self.plans[plan].leaves)
                moves = tuple((sum(other < leaf for other in earlier), leaves - leaf - 1) for leaf in here)
                rows.append((plan, leaves * leaves, moves))
        self._tables[last, action] = rows
        return rows

    def undo(self) -> None:
        """Take back the last observation."""
        super().undo()
        self._levels.pop()

    def fork(self) -> Chains:
        """A copy that goes its own way; tables are shared."""
        other = super().fork()
        assert isinstance(other, Chains)
        other._levels = list(self._levels)
        return other

    def alive(self, level: int) -> set[int]:
        """The plans that explain the first so many observations."""
        return set(self._levels[level][1])

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return sum([count for _, _, count, _, _ in self._levels[-1][2]])

    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""
        found = [0.0] * len(self.plans)
        for plan, total, _, _, _ in self._levels[-1][2]:
            found[plan] = total
        return found

    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of the sum of all scores, weighed by its prior."""
        if not self._is_simple:
            return super().posterior()
        shares, labels = self._nothing.copy(), self.labels
        _, _, standings, whole = self._levels[-1]
        if whole:
            for plan, total, _, _, _ in standings:
                shares[labels[plan]] = total / whole
        return shares

    def total(self) -> float:
        """The sum of all scores, weighed by priors."""
        return self._levels[-1][3]

    def best(self) -> tuple[float, int, int, int] | None:
        """The best explanation: weight, plan, leaves right of its last marked one; how many of the plan are as good."""
        k, squares, priors = len(self.observations), self._squares, self.priors
        top, best = -1.0, None
        for standing in self._levels[-1][2]:
            plan = standing[0]
            weight = priors[plan] * (k * (standing[3] + k) / squares[plan])
            if weight > top:
                top, best = weight, standing
        return None if best is None else (top, best[0], best[3], best[4])

    def tops(self) -> list[tuple[float, int, int, int]]:
        """Per plan that explains the observations: weight of its best explanation, plan, leaves right of it, ties."""
        k, squares, priors = len(self.observations), self._squares, self.priors
        return [
            (priors[plan] * (k * (left + k) / squares[plan]), plan, left, ties)
            for plan, _, _, left, ties in self._levels[-1][2]
        ]

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: (plan, mask of closed leaves, binding), and the share of all scores."""
        action, running, _, whole = self._levels[-1]
        k = len(self.observations)
        if action is None:
            return
        for plan, sums in running.items():
            leaves, binding = len(self.plans[plan].leaves), self._binding(plan)
            for at, leaf in enumerate(self._positions[plan][action]):
                count = sums[at + 1] - sums[at]
                if count:
                    score = k * (leaves - leaf - 1 + k) / self._squares[plan]
                    yield ((plan, (2 << leaf) - 1, binding),), self.priors[plan] * count * score / whole

    def standing(self) -> Standing | None:
        """The best explanation and its rivals."""
        best = self.best()
        if best is None:
            return None
        weight, plan, _, _ = best
        label, labels, k = self.labels[plan], self.labels, len(self.observations)
        least = least_tie(weight)
        equal = [top for top in self.tops() if top[0] >= least]
        missed = min([len(self.plans[p].leaves) - left - k for _, p, left, _ in equal if labels[p] == label])
        rivals = sum([ties for _, p, _, ties in equal if labels[p] != label])
        return Standing(self.count, label, missed, rivals, sum([ties for _, _, _, ties in equal]))
