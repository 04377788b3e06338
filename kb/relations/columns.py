"""Tables of interned constants: numpy columns in sorted runs, for relations too large for Python rows.

A table keeps its rows in runs of about doubling size (a log-structured merge), so growing it round by round, looking
rows up by any columns, and testing for duplicates all stay near-linear in the rows ever added.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.kb.terms.terms import Term

Ids: TypeAlias = NDArray[np.int64]
MOST_CODES = 1 << 62  # rows are coded as one integer: constants ** arity must stay below
MOST_DIRECT = 1 << 20  # constants up to which an index by one column has an entry for each
BITMAP = 1 << 26  # up to so many possible rows a table keeps a bitmap of those it has


class Interner:
    """Constants as numbers from 0, in order of first appearance; equal ones (``1`` and ``1.0``) share theirs."""

    def __init__(self) -> None:
        self.numbers: dict[Term, int] = {}
        self.constants: list[Term] = []

    def intern(self, constant: Term) -> int:
        """The number of a constant, a new one if need be."""
        number = self.numbers.setdefault(constant, len(self.constants))
        if number == len(self.constants):
            self.constants.append(constant)
        return number

    def number(self, constant: Term) -> int | None:
        """The number of a constant, or None when it never appeared."""
        return self.numbers.get(constant)

    def columns(self, rows: Iterable[Sequence[Term]], arity: int) -> list[Ids]:
        """Rows as columns of numbers."""
        flat = list(chain.from_iterable(rows))
        fresh = [constant for constant in dict.fromkeys(flat) if constant not in self.numbers]
        self.numbers.update(zip(fresh, range(len(self.constants), len(self.constants) + len(fresh))))
        self.constants.extend(fresh)
        numbers = np.fromiter(map(self.numbers.__getitem__, flat), np.int64, len(flat))
        return list(numbers.reshape(-1, arity).T.copy()) if arity else []

    def __len__(self) -> int:
        return len(self.constants)


class Run:
    """Rows that no longer change, with an index for every pattern of columns that was asked for."""

    __slots__ = ("_indexes", "columns", "rounds", "size")

    def __init__(self, columns: list[Ids], rounds: Ids) -> None:
        self.columns, self.rounds, self.size = columns, rounds, len(rounds)
        self._indexes: dict[tuple[int, ...], tuple[Ids, Ids]] = {}

    def spans(self, columns: tuple[int, ...], base: int, keys: Ids) -> tuple[Ids, Ids, Ids]:
        """For each key the rows that have it on some columns: where they begin, how many; and the order they are in."""
        found = self._indexes.get(columns)
        if found is None:
            found = self._indexes[columns] = self._index(columns, base)
        directory, order = found
        if _is_direct(columns, base):  # the directory says where each constant's rows begin
            low = directory[keys]
            return low, directory[keys + 1] - low, order
        low = np.searchsorted(directory, keys, "left")
        return low, np.searchsorted(directory, keys, "right") - low, order

    def _index(self, columns: tuple[int, ...], base: int) -> tuple[Ids, Ids]:
        keys = code([self.columns[c] for c in columns], base, self.size)
        order = np.argsort(keys, kind="stable")
        if _is_direct(columns, base):
            begins = np.zeros(base + 1, np.int64)
            np.cumsum(np.bincount(keys, minlength=base), out=begins[1:])
            return begins, order
        return keys[order], order


def _is_direct(columns: tuple[int, ...], base: int) -> bool:
    """Whether an index has an entry for every constant: by one column, of not too many constants."""
    return len(columns) == 1 and base <= MOST_DIRECT


class Table:
    """The growing rows of one predicate.

    Args:
        arity: columns.
        base: how many constants there are, at most; the radix of row codes.
    """

    def __init__(self, arity: int, base: int) -> None:
        self.arity, self.base, self.runs = arity, max(base, 1), list[Run]()
        self._bitmap = np.zeros(self.base**arity, dtype=bool) if self.base**arity <= BITMAP else None

    def __len__(self) -> int:
        return sum(run.size for run in self.runs)

    def add(self, columns: list[Ids], round_: int) -> list[Ids]:
        """Add rows; the ones that were new, each once, as columns."""
        codes = self.new(code(columns, self.base, len(columns[0]) if columns else 0))
        if not len(codes):
            return [np.empty(0, np.int64)] * self.arity
        if self._bitmap is not None:
            self._bitmap[codes] = True
        new = decode(codes, self.base, self.arity)
        self._push(Run(new, np.full(len(codes), round_, np.int64)))
        return new

    def new(self, codes: Ids) -> Ids:
        """Of some row codes those that are not there, each once, in order."""
        if self._bitmap is None:
            codes = _distinct(codes)
            return codes[~self.has(codes)]
        return _distinct(codes[~self._bitmap[codes]])  # most that is found again is known: that leaves little to sort

    def fill(self, codes: Ids, rounds: Ids) -> None:
        """Put distinct rows into an empty table, each with its round."""
        if len(codes):
            if self._bitmap is not None:
                self._bitmap[codes] = True
            self._push(Run(decode(codes, self.base, self.arity), rounds))

    def has(self, codes: Ids) -> NDArray[np.bool_]:
        """Which of the row codes are there."""
        if self._bitmap is not None:
            return self._bitmap[codes]
        return self.any_match(tuple(range(self.arity)), codes)

    def _push(self, run: Run) -> None:
        """Append a run, merging it with its neighbours while they are not much larger."""
        while self.runs and self.runs[-1].size <= 2 * run.size:
            other = self.runs.pop()
            columns = [np.concatenate(pair) for pair in zip(other.columns, run.columns)]
            run = Run(columns, np.concatenate((other.rounds, run.rounds)))
        self.runs.append(run)

    def join(
        self, columns: tuple[int, ...], keys: Ids, most: int = sys.maxsize
    ) -> Iterator[tuple[Ids, list[Ids]]]:
        """Rows matching each key on the columns: (the key's number for every match, the matches as columns).

        In one block, or in several of at most ``most`` matches where there are more.
        """
        spans = [run.spans(columns, self.base, keys) for run in self.runs]
        few = sum(int(counts.sum()) for _, counts, _ in spans) <= most
        blocks = ((run, *found) for run, span in zip(self.runs, spans) for found in matches(*span, most))
        for together in [list(blocks)] if few else ([block] for block in blocks):
            if together:
                which = np.concatenate([which for _, which, _ in together])
                found = [[run.columns[c][at] for run, _, at in together] for c in range(self.arity)]
                yield which, [np.concatenate(parts) for parts in found]

    def any_match(self, columns: tuple[int, ...], keys: Ids) -> NDArray[np.bool_]:
        """For each key whether some row has it on the columns."""
        found = np.zeros(len(keys), dtype=bool)
        for run in self.runs:
            _, counts, _ = run.spans(columns, self.base, keys)
            found |= counts > 0
        return found

    def all_rows(self) -> list[Ids]:
        """Every row, as columns."""
        if not self.runs:
            return [np.empty(0, np.int64)] * self.arity
        return [np.concatenate([run.columns[c] for run in self.runs]) for c in range(self.arity)]


def matches(low: Ids, counts: Ids, order: Ids, most: int) -> Iterator[tuple[Ids, Ids]]:
    """The matches that spans say (`Run.spans`): the key's number and the row's for each, at most so many at once."""
    ends = np.cumsum(counts)
    total = int(ends[-1]) if len(ends) else 0
    for begin in range(0, total, most):
        end = min(begin + most, total)
        first, last = np.searchsorted(ends, [begin, end - 1], "right").tolist()
        here = slice(first, last + 1)
        starts = ends[here] - counts[here]  # where the matches of each key begin
        taken = np.minimum(ends[here], end) - np.maximum(starts, begin)
        which = np.repeat(np.arange(first, last + 1), taken)
        yield which, order[np.repeat(low[here] - starts, taken) + np.arange(begin, end)]


def _distinct(codes: Ids) -> Ids:
    """Each code once, in order. (Sorting beats numpy's hashing ``unique`` on integers by far.)"""
    ordered = np.sort(codes)
    keep = np.ones(len(ordered), dtype=bool)
    keep[1:] = ordered[1:] != ordered[:-1]
    return ordered[keep]


def code(columns: Sequence[Ids], base: int, size: int) -> Ids:
    """Several columns as one number a row, in the radix ``base``; no column gives zeros."""
    result = np.zeros(size, dtype=np.int64)
    for column in columns:
        result = result * base + column
    return result


def decode(codes: Ids, base: int, arity: int) -> list[Ids]:
    """The inverse of `code`."""
    columns: list[Ids] = []
    for _ in range(arity):
        codes, column = np.divmod(codes, base)
        columns.append(column)
    return columns[::-1]
