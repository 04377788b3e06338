"""Counts of explanations on pairs of states of many chains, as blocks (numpy): `pairs` sums them.

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

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from casper.engine.recognition.arrays.pair_states import BEGIN, Ends, Named, States, no_ends, wide
from casper.engine.recognition.arrays.shared import Array, narrowest

Blocks: TypeAlias = Mapping[tuple[str, str], Array]  # shapes (states of a, marked observations, states of b)


@dataclass(frozen=True, slots=True)
class PairCounts:
    """T after some observations.

    Memory: an observation keeps its rows and columns, two numbers for each of its states, each state seen so far and
    each number of marked observations; all else is shared with the level before.
    """

    _np: Any
    _states: States
    _differ: Array  # whether two plans have different goals. Shape (plans, plans)
    blocks: Blocks = field(default_factory=dict)
    seen: tuple[str, ...] = ()  # names, in the order of their first observation
    marked: int = 0  # no more observations were ever marked
    largest: int = 1

    def columns(self) -> Array:
        """The states of all names seen so far, in the order of the rows that an observation adds."""
        return self._np.concatenate([self._states.named[name].at for name in self.seen])

    def moved(self, name: str) -> tuple[PairCounts, Array, Array]:
        """What follows on an observation: T, its rows of the name, and D, both without the beginnings.

        Shape of these: (states of the name, marked observations from 1, `columns` of what follows).
        """
        seen = self.seen if name in self.seen else (*self.seen, name)
        added, parts = self._added(name, seen)
        counts, begins = added.copy(), parts[BEGIN].stop
        blocks = self._written(name, counts, parts)
        marked, largest = max(self.marked, added.shape[1]), max(self.largest, int(counts.max()))
        after = PairCounts(self._np, self._states, self._differ, blocks, seen, marked, largest)
        return after, counts[:, :, begins:], added[:, :, begins:]

    def _added(self, name: str, seen: Sequence[str]) -> tuple[Array, dict[str, slice]]:
        """D, and which of its columns are which name's."""
        here, parts, end = self._states.named[name], dict[str, slice](), 0
        for other in (BEGIN, *seen):
            parts[other] = slice(end, end := end + len(self._states.named[other].at))
        kind = narrowest(self.largest * (2 * self._states.longest + 1))
        found = self._np.empty((len(here.at), self.marked + 1, end), kind)
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
        return Ends(*map(np.concatenate, zip(*found)))
