"""The states of many chains, by names, and how much it takes to count all pairs of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from math import comb
from typing import Any, NamedTuple

from casper.engine.recognition.arrays.arrays import leaves_by_name
from casper.engine.recognition.arrays.shared import Array, narrowest
from casper.plans.trees.plan import Plan

BEGIN = ""  # no action's name
SIZES = {"u2": 2, "u4": 4, "u8": 8, "O": 40}  # bytes; of Python's integers about so many


class Ends(NamedTuple):
    """Where explanations of two goals end. Shapes: (ends,)."""

    x: Array  # state of one plan
    y: Array  # of the other
    marked: Array  # observations
    number: Array  # explanations

    def where(self, which: Array) -> Ends:
        """Some of them."""
        return Ends(*[part[which] for part in self])


def no_ends(np: Any) -> Ends:
    """None."""
    none = np.zeros(0, np.int64)
    return Ends(none, none, none, none.astype(np.uint64))


def wide(np: Any, counts: Array) -> Array:
    """Unsigned, and wide enough to be joined with any others."""
    return counts if counts.dtype == object else counts.astype(np.uint64)


class Step(NamedTuple):
    """A leaf of a name, and what lies left of it in its plan, as far as the leaf of the name before it."""

    row: int  # among the states of the name
    before: int  # the row of the leaf before it that has the name; -1 if there is none
    plan: int
    between: tuple[tuple[str, int], ...]  # names and rows from that leaf on


class Named(NamedTuple):
    """The states of a name, plan after plan. Shape: (states of the name,)."""

    at: Array  # number among all states
    steps: Sequence[Step]


class States:
    """All states: the leaves plan after plan, then the beginnings. Shapes: (states,), ``first`` (plans,)."""

    def __init__(self, np: Any, plans: Sequence[Plan]) -> None:
        self.lengths = np.array([len(plan.leaves) for plan in plans])
        self.leaves, self.longest = int(self.lengths.sum()), int(self.lengths.max())
        self.first = np.cumsum(self.lengths) - self.lengths  # of each plan's leaves
        begun = np.arange(self.leaves) - np.repeat(self.first, self.lengths) + 1
        self.plan = np.concatenate((np.repeat(np.arange(len(plans)), self.lengths), np.arange(len(plans))))
        self.closed = np.concatenate((begun, np.zeros(len(plans), np.int64)))
        self.right = self.lengths[self.plan] - self.closed
        steps = _steps(plans)
        self.named = {BEGIN: Named(np.arange(len(plans)) + self.leaves, ())}
        for name, found in leaves_by_name(np, plans, self.lengths).items():
            self.named[name] = Named(found.at, steps[name])
        self.code = np.zeros(len(self.plan), np.int64)  # the name, as a number
        for code, states in enumerate(self.named.values()):
            self.code[states.at] = code


def _steps(plans: Sequence[Plan]) -> dict[str, list[Step]]:
    """The steps of each name, plan after plan."""
    found: dict[str, list[Step]] = {}
    for number, plan in enumerate(plans):
        last: dict[str, int] = {}  # the last leaf of each name
        passed: list[tuple[str, int]] = []  # names and rows of the leaves so far
        for leaf, action in enumerate(plan.leaves):
            name = action.functor
            steps, before = found.setdefault(name, []), last.get(name)
            row = len(steps)
            steps.append(Step(row, -1 if before is None else row - 1, number, tuple(passed[before or 0 :])))
            passed.append((name, row))
            last[name] = leaf
    return found


def fits(plans: Sequence[Plan], noisy: bool, most: int = 1_000_000_000, observations: int = 16) -> bool:
    """Whether so many observations of the commonest name take about so few bytes.

    Single counts are far above the mean where leaves of a name stand close together: hence the square.
    """
    names = Counter(leaf.functor for plan in plans for leaf in plan.leaves)
    common, leaves, n = max(names.values()), sum(names.values()), max(len(plan.leaves) for plan in plans)
    found = 0
    for k in range(1, observations + 1):
        ways = [comb(k, q) * comb(q, q // 2) * comb(2 * n, q) * (common / leaves) ** q for q in range(k + 1)]
        size = SIZES[narrowest((2 * n + 1) ** 2 * max(ways))]
        columns = len(plans) + min(leaves, k * common)
        found += 2 * common * columns * (k if noisy else 1) * size + 8 * len(plans) ** 2
    return found <= most
