"""Counts of explanations on the leaves of many chains, as blocks (numpy): what `noisy_arrays` sums over.

Leaves lie by their place in the plan: all first ones, all second ones, those of longer plans first. So the leaves at
one place are one block, and a sum to the left is one pass of additions of whole blocks, in the narrowest integers that
hold a plan's counts (C(k, q) * C(n, q) at most; above 64 bits Python's).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import comb
from threading import Lock
from typing import Any

from casper.engine.recognition.arrays.shared import Array, narrowest
from casper.plans.trees.plan import Plan


@dataclass(frozen=True, slots=True)
class Leaves:
    """The leaves of one name, as they lie. Shapes: (leaves of the name,), ``spans``: (places + 1,)."""

    code: int  # of the name
    at: Array  # number among all leaves
    column: Array  # of its plan
    right: Array  # leaves right of it
    square: Array  # of its plan's number of leaves
    spans: list[int]  # where each place begins among them


class Layout:
    """Where leaves lie. A plan is a *column*, longer ones first, so that the leaves at one place are a block."""

    def __init__(self, np: Any, plans: Sequence[Plan]) -> None:
        lengths = np.array([len(plan.leaves) for plan in plans])
        self.np, self.order = np, np.argsort(-lengths, kind="stable")  # by column: its plan
        self.lengths = lengths[self.order]
        self.longest = int(lengths.max())
        widths = np.searchsorted(-self.lengths, -np.arange(self.longest))  # how many plans have such a place
        self.starts = np.concatenate(([0], np.cumsum(widths)))
        names = [leaf[0] for plan in self.order.tolist() for leaf in plans[plan].leaves]
        self._codes = {name: code for code, name in enumerate(dict.fromkeys(names))}
        columns = np.repeat(np.arange(len(plans)), self.lengths)
        place = np.arange(len(names)) - np.repeat(np.cumsum(self.lengths) - self.lengths, self.lengths)
        self.codes = np.empty(len(names), np.int64)  # by leaf: its name's
        self.codes[self.starts[place] + columns] = [self._codes[name] for name in names]
        self._by_code = np.argsort(self.codes, kind="stable")
        self._bounds = np.searchsorted(self.codes[self._by_code], np.arange(len(self._codes) + 1))
        self._leaves: dict[str, Leaves] = {}

    def leaves(self, name: str) -> Leaves:
        """The leaves of a name; none, if it is unknown."""
        if name not in self._leaves:
            code = self._codes.get(name, -1)
            at = self._by_code[self._bounds[code] : self._bounds[code + 1]] if code >= 0 else self._by_code[:0]
            column, place = self.find(at)
            lengths, spans = self.lengths[column], self.np.searchsorted(at, self.starts).tolist()
            self._leaves[name] = Leaves(code, at, column, lengths - place - 1, lengths * lengths, spans)
        return self._leaves[name]

    def find(self, at: Array) -> tuple[Array, Array]:
        """Columns and places of leaves."""
        place = self.np.searchsorted(self.starts, at, side="right") - 1
        return at - self.starts[place], place


class Table:
    """D on all leaves, as the fork that observed last sees it. One for all forks: what differs is written anew."""

    def __init__(self, layout: Layout) -> None:
        self.layout, self._np = layout, layout.np
        self._cells = self._np.zeros((4, len(layout.codes)), self._np.uint16)  # shape (marked, leaves)
        self._counts: Mapping[str, Array] = {}
        self._lock = Lock()  # forks may be used by several threads

    def following(self, counts: Mapping[str, Array], here: Leaves, observations: int) -> Array:
        """d of a name after these counts, without rows that are all zero. Shape (marked, leaves of the name)."""
        rows = max(map(len, counts.values()), default=0)
        with self._lock:
            self._hold(rows, observations)
            self._bring(counts)
            found = self._np.empty((rows + 1, len(here.at)), self._cells.dtype)
            found[0] = 1
            if rows:
                self._sum(here, found[1:])
        while len(found) and not found[-1].any():
            found = found[:-1]
        return found

    def _sum(self, here: Leaves, found: Array) -> None:
        """Into ``found``: per leaf of the name the sums over what lies left of it in its plan."""
        cells, rows = self._cells, len(found)
        sums = self._np.zeros((rows, len(self.layout.order)), cells.dtype)
        blocks, spans = pairwise(self.layout.starts.tolist()), pairwise(here.spans)
        for (begin, end), (first, last) in zip(blocks, spans):
            if first < last:
                found[:, first:last] = sums.take(here.column[first:last], axis=1)
            sums[:, : end - begin] += cells[:rows, begin:end]

    def _bring(self, counts: Mapping[str, Array]) -> None:
        """Write what these counts and those in the table do not share."""
        for name in self._counts.keys() | counts.keys():
            old, new = self._counts.get(name, ()), counts.get(name, ())
            if old is not new:
                at = self.layout.leaves(name).at
                for row in range(max(len(old), len(new))):
                    self._cells[row][at] = new[row] if row < len(new) else 0
        self._counts = counts

    def _hold(self, rows: int, observations: int) -> None:
        """Make room for so many rows, and for numbers as large as they can become."""
        np, cells = self._np, self._cells
        kind = np.promote_types(cells.dtype, narrowest(_largest(observations, self.layout.longest)))
        room = len(cells) if rows <= len(cells) else max(rows, 2 * len(cells))
        if room > len(cells) or kind != cells.dtype:
            self._cells = np.zeros((room, cells.shape[1]), kind)  # rows never used cost no memory
            self._cells[: len(cells)] = cells


@cache
def _largest(observations: int, leaves: int) -> int:
    """No more explanations of a plan mark the same number of observations."""
    return max(comb(observations, q) * comb(leaves, q) for q in range(min(observations, leaves) + 1))
