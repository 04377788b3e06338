"""Counts of explanations on pairs of states of many chains, as blocks (numpy): `noisy_pairs` sums them.

A state is a plan's beginning or one of its leaves. T_q[x, y] is symmetric, and other than zero only between beginnings
and leaves whose names were seen, so it is kept as *blocks* T[a, b], one for each two names seen so far; beginnings go
by the name `BEGIN`. An observation of o adds to the rows and the columns of o, so it writes these blocks anew and
shares all others with the level before. What it adds to a row, D_q[x, :], is the sum of the rows T_{q-1}[x', :] left of
x in x's plan: per plan one running sum, that goes on from one leaf of the name to the next.

Where i of the q marked observations are steps of the first plan there are C(k, q) C(q, i) C(n_p, i) C(n_q, q - i) ways
at most, if all leaves have one name. Libraries of several names come to far less; so each observation takes the
narrowest integers that hold (2 n + 1) times the largest count so far, n being the most leaves of a plan: D sums up to n
rows, and T gets D and its transpose. Above 64 bits they are Python's.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import comb
from typing import Any, TypeAlias

from casper.engine.recognition.arrays import Array
from casper.plans.trees.plan import Plan

BEGIN = ""  # no action's name
Blocks: TypeAlias = Mapping[tuple[str, str], Array]  # shapes (states of a, marked observations from 1, states of b)


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
    """All states, by names. Shapes: (states,)."""

    def __init__(self, np: Any, plans: Sequence[Plan]) -> None:
        rows: dict[str, list[tuple[int, int]]] = {BEGIN: [(plan, -1) for plan in range(len(plans))]}
        steps: dict[str, list[Step]] = {}
        for number, plan in enumerate(plans):
            for step, name, leaf in _steps(number, plan, {name: len(found) for name, found in rows.items()}):
                steps.setdefault(name, []).append(step)
                rows.setdefault(name, []).append((number, leaf))
        found = np.array([state for name in rows for state in rows[name]])
        self.lengths = np.array([len(plan.leaves) for plan in plans])
        self.longest = int(self.lengths.max())
        self.plan, self.closed = found[:, 0], found[:, 1] + 1
        self.right = self.lengths[self.plan] - self.closed
        self.code = np.repeat(np.arange(len(rows)), [len(states) for states in rows.values()])
        at = np.split(np.arange(len(found)), np.flatnonzero(np.diff(self.code)) + 1)
        self.named = {name: Named(part, steps.get(name, [])) for name, part in zip(rows, at)}


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


class PairCounts:
    """T after some observations; never changed once made.

    Memory: an observation keeps its rows and columns, two numbers for each of its states, each state seen so far and
    each number of marked observations; all else is shared with the level before.
    """

    __slots__ = ("_differ", "_np", "_states", "blocks", "largest", "marked", "seen")

    def __init__(self, np: Any, states: States, differ: Array) -> None:
        self._np, self._states = np, states
        self._differ = differ  # whether two plans have different goals. Shape (plans, plans)
        self.blocks: Blocks = {}
        self.seen: tuple[str, ...] = ()  # names, in the order of their first observation
        self.marked = 0  # no more observations were ever marked
        self.largest = 1

    def columns(self) -> Array:
        """The states of all names seen so far, in the order of the rows that an observation adds."""
        return self._np.concatenate([self._states.named[name].at for name in self.seen])

    def moved(self, name: str) -> tuple[PairCounts, Array, Array]:
        """What follows on an observation: T, its rows of the name, and D, both without the beginnings.

        Shape of these: (states of the name, marked observations from 1, `columns` of what follows).
        """
        after = PairCounts(self._np, self._states, self._differ)
        after.seen = self.seen if name in self.seen else (*self.seen, name)
        added, parts = self._added(name, after.seen)
        counts = added.copy()
        after.marked = max(self.marked, added.shape[1])
        after.blocks = self._written(name, counts, parts)
        after.largest = max(self.largest, int(counts.max()))
        begins = parts[BEGIN].stop
        return after, counts[:, :, begins:], added[:, :, begins:]

    def _added(self, name: str, seen: Sequence[str]) -> tuple[Array, dict[str, slice]]:
        """D, and which of its columns are which name's."""
        here, parts, end = self._states.named[name], dict[str, slice](), 0
        for other in (BEGIN, *seen):
            parts[other] = slice(end, end := end + len(self._states.named[other].at))
        found = self._np.empty((len(here.at), self.marked + 1, end), self._kind())
        for other, part in parts.items():
            self._sum(here, other, found[:, :, part])
        least = max((block.shape[1] for (row, _), block in self.blocks.items() if row == name), default=1)
        rows = found.shape[1]
        while rows > least and not found[:, rows - 1].any():
            rows -= 1
        return found[:, :rows], parts

    def _sum(self, here: Named, other: str, found: Array) -> None:
        """Into ``found``: per leaf of a name the sums over what lies left of it in its plan, by state of the other."""
        blocks = {name: self.blocks[name, other] for name in (BEGIN, *self.seen) if (name, other) in self.blocks}
        begin = blocks.get(BEGIN)
        found[:, 0] = self._differ[self._states.plan[here.at]] if other == BEGIN else 0
        for step in here.steps:
            sums = found[step.row, 1:]
            if step.before >= 0:
                sums[:] = found[step.before, 1:]
            else:
                sums[:] = 0
                if begin is not None:
                    sums[: begin.shape[1]] = begin[step.plan]
            for name, row in step.between:
                if name in blocks:
                    left = blocks[name][row]
                    sums[: len(left)] += left

    def _written(self, name: str, counts: Array, parts: Mapping[str, slice]) -> Blocks:
        """All blocks, the rows and columns of the name anew; what is added to its rows becomes all that they hold."""
        own = counts[:, :, parts[name]]
        own += own.transpose(2, 1, 0).copy()
        for other, part in parts.items():
            earlier = self.blocks.get((name, other))
            if earlier is not None:
                counts[:, : earlier.shape[1], part] += earlier
        turned = self._np.ascontiguousarray(counts.transpose(2, 1, 0))
        blocks = dict(self.blocks)
        for other, part in parts.items():
            blocks[other, name] = turned[part]
            blocks[name, other] = counts[:, :, part]
        return blocks

    def furthest(self, here: Array, columns: Array, rows: Array) -> Ends:
        """Of rows of T, per two states the ends that mark most; two leaves of one name come once."""
        np, plan, code = self._np, self._states.plan, self._states.code
        # what ends in two leaves and marks more than two can do without its first mark of one plan: no gaps from 2 on
        marked = (rows > 0).view(np.int8).sum(axis=1, dtype=np.int16)
        twice = np.flatnonzero(code[columns] == code[here[0]])
        marked[:, twice] *= plan[here][:, None] < plan[columns[twice]]
        row, column = np.nonzero(marked)
        most = marked[row, column].astype(np.int64)
        return Ends(here[row], columns[column], most + 1, wide(np, rows[row, most, column]))

    def ends(self) -> Ends:
        """All ends of explanations of two goals."""
        np, states, found = self._np, self._states, [no_ends(self._np)]
        for at, name in enumerate(self.seen):
            for other in self.seen[: at + 1]:
                block = self.blocks[name, other]
                row, marked, column = np.nonzero(block)
                number = wide(np, block[row, marked, column])
                ends = Ends(states.named[name].at[row], states.named[other].at[column], marked + 1, number)
                found.append(ends if name != other else ends.where(states.plan[ends.x] < states.plan[ends.y]))
        return Ends.joined(np, found)

    def _kind(self) -> str:
        largest = self.largest * (2 * self._states.longest + 1)
        return next((f"u{size}" for size in (2, 4, 8) if largest < 1 << 8 * size), "O")


def wide(np: Any, counts: Array) -> Array:
    """Unsigned, and wide enough to be joined with any others."""
    return counts if counts.dtype == object else counts.astype(np.uint64)



def memory(plans: Sequence[Plan], observations: int) -> int:
    """About how many bytes so many observations take, each of a name that is as common as the commonest."""
    lengths = sorted(len(plan.leaves) for plan in plans)
    names = Counter(leaf.functor for plan in plans for leaf in plan.leaves)
    most, leaves = max(names.values()), sum(lengths)
    longest, next_longest = lengths[-1], lengths[-2] if len(lengths) > 1 else 0
    found = 0
    for k in range(1, observations + 1):
        columns = len(plans) + min(leaves, k * most)
        found += 2 * most * columns * k * _size(k, longest, next_longest, most / leaves) + 8 * len(plans) ** 2
    return found


def _size(k: int, n: int, others: int, share: float) -> int:
    """How many bytes hold the counts of k observations, if that share of the leaves has each one's name.

    Single counts are far above the mean where leaves of a name stand close together: hence the square.
    """
    ways = [sum(comb(q, i) * comb(n, i) * comb(others, q - i) for i in range(q + 1)) for q in range(k + 1)]
    largest = (2 * n + 1) ** 2 * max(comb(k, q) * number * share**q for q, number in enumerate(ways))
    return next((size for size in (2, 4, 8) if largest < 1 << 8 * size), 40)  # about forty for Python's integers
