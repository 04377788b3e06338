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

from casper.engine.recognition.kernels.kernel import Kernel, Leading, Marks, Parts, Plans, Top
from casper.engine.recognition.kernels.marks import leftmost
from casper.engine.recognition.kernels.moves import positions_of
from casper.engine.verification.matching import Matcher
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

Row: TypeAlias = tuple[int, int, tuple[tuple[int, int], ...]]
"""Plan, the square of its length; for each of its leaves of this name: how many leaves of the last name lie left of
it, and how many leaves of any name right."""
Standings: TypeAlias = list[tuple[int, float, int, int, int]]
"""For each plan that explains the observations: plan, sum of scores, count, leaves right of the best explanation's
last marked leaf, how many explanations are as good."""
Level: TypeAlias = tuple[int, str | None, dict[int, list[int]], Standings, float]
"""How many observations, the last name, each plan's counts as running sums over its leaves of that name, what follows
from them, and the sum of all scores, weighed by priors."""


class Chains(Kernel[Level]):
    """Counts for chains, by names."""

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, priors: Sequence[float] | None = None) -> None:
        super().__init__(plans, matcher, priors=priors)
        self._positions = [positions_of(plan) for plan in plans]
        self._squares = [len(plan.leaves) ** 2 for plan in plans]
        self._tables: dict[tuple[str | None, str], list[Row]] = {}
        self._own_goal = len(self.index) == len(plans)
        self._nothing = dict.fromkeys(self.labels, 0.0)
        self._first: dict[str, Level] = {}  # by action: the level after it alone

    def begin(self) -> Level:
        """Nothing was seen: every plan counts once."""
        standings: Standings = [(at, 0.0, 1, len(plan.leaves), 1) for at, plan in enumerate(self.plans)]
        return 0, None, {plan: [0, 1] for plan in range(len(self.plans))}, standings, 0.0

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """The plans that have the action go on."""
        action = seen.action
        if level[0]:
            return self._advanced(level, action)
        known = self._first.get(action)  # all counts are one: nothing depends on what was before
        if known is None:
            known = self._first[action] = self._advanced(level, action)
        return known

    def _advanced(self, level: Level, action: str) -> Level:
        k, last, before, _, _ = level
        rows = self._tables.get((last, action))
        if rows is None:
            rows = self._table(last, action)
        k, whole, priors = k + 1, 0.0, self.priors
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
        return k, action, running, standings, whole

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

    def count(self, level: Level) -> int:
        """The sum of the running sums' ends."""
        return sum([count for _, _, count, _, _ in level[3]])

    def alive(self, level: Level) -> set[int]:
        return set(level[2])

    def masses(self, level: Level) -> list[float]:
        found = [0.0] * len(self.plans)
        for plan, total, _, _, _ in level[3]:
            found[plan] = self.priors[plan] * total
        return found

    def posterior(self, level: Level) -> Mapping[str, float]:
        if not (self.evenly and self._own_goal):
            return super().posterior(level)
        shares, labels, whole = self._nothing.copy(), self.labels, level[4]
        if whole:
            for plan, total, _, _, _ in level[3]:
                shares[labels[plan]] = total / whole
        return shares

    def total(self, level: Level) -> float:
        return level[4]

    def best(self, level: Level) -> tuple[float, Plans] | None:
        """The best explanation ends furthest to the left in its plan."""
        k, squares, priors = level[0], self._squares, self.priors
        top, best = -1.0, -1
        for plan, _, _, left, _ in level[3]:
            weight = priors[plan] * (k * (left + k) / squares[plan])
            if weight > top:
                top, best = weight, plan
        return None if best < 0 else (top, (best,))

    def leading(self, level: Level) -> Leading | None:
        return self.leading_of(self._tops(level))

    def tops(self, level: Level) -> list[tuple[float, Plans]]:
        return [top[:2] for top in self._tops(level)]

    def _tops(self, level: Level) -> list[Top]:
        k, squares, priors, plans = level[0], self._squares, self.priors, self.plans
        return [
            (priors[plan] * (k * (left + k) / squares[plan]), (plan,), len(plans[plan].leaves) - left - k, ties)
            for plan, _, _, left, ties in level[3]
        ]

    def first_marks(self, level: Level, plan: int, seen: Sequence[Seen]) -> Marks:
        """Every observation is the first leaf that it can be."""
        return leftmost(self.plans[plan], seen)

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By leaf of the last name."""
        k, action, running, _, _ = level
        for plan, sums in running.items() if action is not None else ():
            leaves, binding = len(self.plans[plan].leaves), self.binding(plan)
            for at, leaf in enumerate(self._positions[plan][action or ""]):
                count = sums[at + 1] - sums[at]
                if count:
                    score = k * (leaves - leaf - 1 + k) / self._squares[plan]
                    yield ((plan, (2 << leaf) - 1, binding),), self.priors[plan] * count * score
