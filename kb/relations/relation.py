"""A relation: a set of ground rows with a lazily built hash index for every pattern of bound columns.

An index, once built, is kept up as rows come and go, so a lookup touches only rows that match on every bound column.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from operator import itemgetter
from typing import Any, TypeAlias

from casper.kb.terms.terms import Term

Row: TypeAlias = tuple[Term, ...]
Columns: TypeAlias = tuple[int, ...]
Index: TypeAlias = dict[Row, dict[Row, None]]


class Relation:
    """Rows of one predicate, in order of insertion, each with the round of the fixpoint in which it appeared."""

    def __init__(self, name: str, arity: int, rows: Iterable[Row] = ()) -> None:
        self.name, self.arity = name, arity
        self.rows: dict[Row, int] = dict.fromkeys(rows, 0)
        self._indexes: dict[Columns, Index] = {}
        self.undefined: Relation | None = None  # rows that are neither true nor false; none is an empty relation
        self.coded: Any = None  # the rows as columns of numbers (`kb.relations.coded`), until one comes or goes
        self.touched = 0  # rows handed out by lookups: the measure of work that tests count

    def add(self, row: Row, round_: int = 0) -> bool:
        """Add a row; False when it was there already (its round then stays)."""
        if row in self.rows:
            return False
        self.rows[row] = round_
        self.coded = None
        for columns, index in self._indexes.items():
            key = tuple([row[c] for c in columns])
            bucket = index.get(key)
            if bucket is None:
                index[key] = {row: None}
            else:
                bucket[row] = None
        return True

    def remove(self, row: Row) -> bool:
        """Take a row out; False when it was not there."""
        if self.rows.pop(row, None) is None:
            return False
        self.coded = None
        for columns, index in self._indexes.items():
            key = tuple([row[c] for c in columns])
            bucket = index[key]
            del bucket[row]
            if not bucket:
                del index[key]
        return True

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        """The rows whose bound columns equal the key; with no column bound, all of them.

        What comes back may be a view: add and remove rows only after it has been read.
        """
        if not columns:
            found: Collection[Row] = self.rows
        elif len(columns) == self.arity:
            found = (key,) if key in self else ()
        else:
            index = self._indexes.get(columns)
            found = (self._build(columns) if index is None else index).get(key, ())
        self.touched += len(found)
        return found

    def _build(self, columns: Columns) -> Index:
        index: Index = {}
        picked = map(itemgetter(*columns), self.rows)
        for key, row in zip(picked if len(columns) > 1 else zip(picked), self.rows):
            bucket = index.get(key)
            if bucket is None:
                index[key] = {row: None}
            else:
                bucket[row] = None
        self._indexes[columns] = index
        return index

    def round_of(self, row: Row) -> int:
        """The round in which a row appeared."""
        return self.rows[row]

    def __contains__(self, row: object) -> bool:
        return row in self.rows

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<{self.name}/{self.arity}: {len(self)} rows>"


def copied(relation: Relation) -> Relation:
    """A plain relation of the same rows and rounds; what is undefined is never changed in place, so both have it."""
    found = Relation(relation.name, relation.arity)
    found.rows = {row: relation.round_of(row) for row in relation}
    found.undefined = relation.undefined
    return found
