"""The states of many chains, by names, and how much it takes to count all pairs of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import comb
from typing import Any

from casper.engine.recognition.arrays.shared import Array
from casper.plans.trees.plan import Plan

BEGIN = ""  # no action's name


@dataclass(frozen=True, slots=True)
class Ends:
    """Where explanations of two goals end. Shapes: (ends,)."""

    x: Array  # state of one plan
    y: Array  # of the other
    marked: Array  # observations
    number: Array  # explanations

    def where(self, which: Array) -> Ends:
        """Some of them."""
        return Ends(self.x[which], self.y[which], self.marked[which], self.number[which])

    @staticmethod
    def joined(np: Any, parts: Sequence[Ends]) -> Ends:
        """All of them."""
        return Ends(*(np.concatenate([getattr(part, name) for part in parts]) for name in Ends.__slots__))


def no_ends(np: Any) -> Ends:
    """None."""
    none = np.zeros(0, np.int64)
    return Ends(none, none, none, none.astype(np.uint64))


def wide(np: Any, counts: Array) -> Array:
    """Unsigned, and wide enough to be joined with any others."""
    return counts if counts.dtype == object else counts.astype(np.uint64)


@dataclass(frozen=True, slots=True)
class Step:
    """A leaf of a name, and what lies left of it in its plan, as far as the leaf of the name before it."""

    row: int  # among the states of the name
    before: int  # the row of the leaf before it that has the name; -1 if there is none
    plan: int
    between: tuple[tuple[str, int], ...]  # names and rows from that leaf on


@dataclass(slots=True)
class Named:
    """The states of a name, plan after plan. Shape: (states of the name,)."""

    at: Array  # number among all states
    steps: list[Step] = field(default_factory=list)


class States:
    """All states: the leaves plan after plan, then the beginnings. Shapes: (states,), ``first`` (plans,)."""

    def __init__(self, np: Any, plans: Sequence[Plan]) -> None:
        rows: dict[str, list[tuple[int, int]]] = {BEGIN: [(plan, -1) for plan in range(len(plans))]}
        steps: dict[str, list[Step]] = {}
        for number, plan in enumerate(plans):
            for step, name, leaf in _steps(number, plan, {name: len(found) for name, found in rows.items()}):
                steps.setdefault(name, []).append(step)
                rows.setdefault(name, []).append((number, leaf))
        self.lengths = np.array([len(plan.leaves) for plan in plans])
        self.leaves, self.longest = int(self.lengths.sum()), int(self.lengths.max())
        self.first = np.cumsum(self.lengths) - self.lengths  # of each plan's leaves
        begun = np.arange(self.leaves) - np.repeat(self.first, self.lengths) + 1
        self.plan = np.concatenate((np.repeat(np.arange(len(plans)), self.lengths), np.arange(len(plans))))
        self.closed = np.concatenate((begun, np.zeros(len(plans), np.int64)))
        self.right = self.lengths[self.plan] - self.closed
        self.code, self.named = np.zeros(len(self.plan), np.int64), dict[str, Named]()  # code: the name, as a number
        for code, (name, states) in enumerate(rows.items()):
            plan, leaf = np.array(states).T
            at = np.where(leaf < 0, self.leaves + plan, self.first[plan] + leaf)
            self.named[name], self.code[at] = Named(at, steps.get(name, [])), code


def _steps(number: int, plan: Plan, sizes: Mapping[str, int]) -> Iterator[tuple[Step, str, int]]:
    """The steps of one plan, each with its name and leaf; ``sizes``: how many states of a name there are before it."""
    last: dict[str, int] = {}  # the last leaf of each name
    rows: list[tuple[str, int]] = []  # of the leaves so far
    for leaf, action in enumerate(plan.leaves):
        name = action.functor
        before = last.get(name, -1)
        row = rows[before][1] + 1 if before >= 0 else sizes.get(name, 0)
        yield Step(row, row - 1 if before >= 0 else -1, number, tuple(rows[max(before, 0) :])), name, leaf
        last[name] = leaf
        rows.append((name, row))


def fits(plans: Sequence[Plan], noisy: bool, most: int = 1_000_000_000) -> bool:
    """Whether sixteen observations of the commonest name take so few bytes."""
    return memory(plans, 16, noisy) <= most


def memory(plans: Sequence[Plan], observations: int, noisy: bool) -> int:
    """About how many bytes so many observations take, each of a name that is as common as the commonest."""
    lengths = sorted(len(plan.leaves) for plan in plans)
    names = Counter(leaf.functor for plan in plans for leaf in plan.leaves)
    most, leaves = max(names.values()), sum(lengths)
    longest, next_longest = lengths[-1], lengths[-2] if len(lengths) > 1 else 0
    found = 0
    for k in range(1, observations + 1):
        columns = len(plans) + min(leaves, k * most)
        size = _size(k, longest, next_longest, most / leaves)
        found += 2 * most * columns * (k if noisy else 1) * size + 8 * len(plans) ** 2
    return found


def _size(k: int, n: int, others: int, share: float) -> int:
    """How many bytes hold the counts of k observations, if that share of the leaves has each one's name.

    Single counts are far above the mean where leaves of a name stand close together: hence the square.
    """
    ways = [sum(comb(q, i) * comb(n, i) * comb(others, q - i) for i in range(q + 1)) for q in range(k + 1)]
    largest = (2 * n + 1) ** 2 * max(comb(k, q) * number * share**q for q, number in enumerate(ways))
    return next((size for size in (2, 4, 8) if largest < 1 << 8 * size), 40)  # about forty for Python's integers
