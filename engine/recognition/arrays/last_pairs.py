"""Counts on pairs of states of many chains where nothing is needless, as one array: what `pairs` sums then (numpy).

Every explanation marks all observations, so T is zero but in the rows and columns of the last name's leaves A, and only
the rows T[A, leaves] and T[A, beginnings] are kept. When the next observation has the leaves O,

    D[x, y] = sum of T[x', y] over the states x' of x's plan left of x, for x in O

is a sum along A, and for y in A one along the leaves that are not in A, plus the beginning of x's plan.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from casper.engine.recognition.arrays.pair_states import Ends, States, wide
from casper.engine.recognition.arrays.shared import EXACT_LEAVES, Array


@dataclass(frozen=True, slots=True)
class LastPairs:
    """T after some observations. Interface: `pair_counts.PairCounts`."""

    _np: Any
    _states: States
    _begins: Array  # T of the rows kept and all beginnings
    _counts: Array  # and all leaves
    _here: Array  # the states of the rows
    marked: int = 0

    @classmethod
    def start(cls, np: Any, states: States, differ: Array) -> LastPairs:
        """Everything stands at its beginning. ``differ``: whether two plans have different goals."""
        kind = np.int64 if 2 * states.longest <= EXACT_LEAVES else object
        counts, here = np.zeros((len(differ), states.leaves), kind), np.arange(len(differ)) + states.leaves
        return cls(np, states, differ.astype(kind), counts, here)

    def columns(self) -> Array:
        """All leaves."""
        return self._np.arange(self._states.leaves)

    def moved(self, name: str) -> tuple[LastPairs, Array, Array]:
        """What follows on an observation: T, its rows of the name, and D, both without the beginnings.

        Shape of these: (states of the name, 1, leaves).
        """
        np, states, there = self._np, self._states, self._states.named[name].at
        plan = states.plan[there]
        if not self.marked:
            begins, added = self._begins[plan], np.zeros((len(there), states.leaves), self._begins.dtype)
        else:
            first = states.first[plan]
            begins, added = (self._along_rows(counts, there, first) for counts in (self._begins, self._counts))
            added[:, self._here] += self._along_columns(there, first).T
        counts = added.copy()
        counts[:, there] += added[:, there].T
        return LastPairs(np, states, begins, counts, there, self.marked + 1), counts[:, None], added[:, None]

    def _along_rows(self, counts: Array, there: Array, first: Array) -> Array:
        """Per leaf of the next name, the sums of the rows left of it in its plan."""
        np = self._np
        running = np.zeros((len(counts) + 1, counts.shape[1]), counts.dtype)
        np.cumsum(counts, axis=0, out=running[1:])
        sums = running.take(np.searchsorted(self._here, there), axis=0)
        sums -= running.take(np.searchsorted(self._here, first), axis=0)
        return sums

    def _along_columns(self, there: Array, first: Array) -> Array:
        """Per row and leaf of the next name, the sums over what lies left of it in its plan and is no row."""
        np = self._np
        others = np.zeros((len(self._counts), self._states.leaves + 1), self._counts.dtype)
        others[:, 1:] = self._counts
        others[:, self._here + 1] = 0
        np.cumsum(others, axis=1, out=others)
        sums: Array = self._begins.take(self._states.plan[there], axis=1)
        sums += others.take(there, axis=1)
        sums -= others.take(first, axis=1)
        return sums

    def furthest(self, here: Array, columns: Array, rows: Array) -> Ends:
        """Of rows of T, per state and other plan the end that leaves most open: it scores best, all mark alike."""
        np, states = self._np, self._states
        some = self._once(here, rows)
        right = np.where(some, states.right[: states.leaves].astype(np.int32), -1)
        most = np.maximum.reduceat(right, states.first, axis=1)
        row, plan = np.nonzero(most >= 0)
        column = states.first[plan] + states.lengths[plan] - most[row, plan] - 1
        return self._ends(here, rows, row, column)

    def _once(self, here: Array, rows: Array) -> Array:
        """Where explanations end; of two leaves of one name only once."""
        plan, some = self._states.plan, rows[:, 0] > 0
        some[:, here] &= plan[here][:, None] < plan[here]
        return some

    def _ends(self, here: Array, rows: Array, row: Array, column: Array) -> Ends:
        marked = self._np.full(len(row), self.marked)
        return Ends(here[row], column, marked, wide(self._np, rows[row, 0, column]))

    def ends(self) -> Ends:
        """All ends of explanations of two goals."""
        here = self._here if self.marked else self._here[:0]
        rows = self._counts[: len(here), None]
        return self._ends(here, rows, *self._np.nonzero(self._once(here, rows)))
