"""A relation: a set of ground rows with a lazily built hash index for every pattern of bound columns.

An index, once built, is kept up as rows are added, so a lookup touches only rows that match on every bound column.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from casper.kb.terms import Term

Row: TypeAlias = tuple[Term, ...]
Columns: TypeAlias = tuple[int, ...]


class Relation:
    """Rows of one predicate, in order of insertion, each with the round of the fixpoint in which it appeared."""

    __slots__ = ("_indexes", "arity", "name", "rows", "touched")

    def __init__(self, name: str, arity: int, rows: Iterable[Row] = ()) -> None:
        self.name, self.arity = name, arity
        self.rows: dict[Row, int] = {}
        self._indexes: dict[Columns, dict[Row, list[Row]]] = {}
        self.touched = 0  # rows handed out by lookups: the measure of work that tests count
        for row in rows:
            self.add(row)

    def add(self, row: Row, round_: int = 0) -> bool:
        """Add a row; False when it was there already (its round then stays)."""
        if row in self.rows:
            return False
        self.rows[row] = round_
        for columns, index in self._indexes.items():
            index.setdefault(tuple([row[c] for c in columns]), []).append(row)
        return True

    def matching(self, columns: Columns, key: Row) -> Sequence[Row]:
        """The rows whose bound columns equal the key; with no column bound, all of them."""
        if not columns:
            found: Sequence[Row] = list(self.rows)
        elif len(columns) == self.arity:
            found = (key,) if key in self.rows else ()
        else:
            index = self._indexes.get(columns)
            found = (self._build(columns) if index is None else index).get(key, ())
        self.touched += len(found)
        return found

    def _build(self, columns: Columns) -> dict[Row, list[Row]]:
        index: dict[Row, list[Row]] = {}
        for row in self.rows:
            index.setdefault(tuple([row[c] for c in columns]), []).append(row)
        self._indexes[columns] = index
        return index

    def __contains__(self, row: Row) -> bool:
        return row in self.rows

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<{self.name}/{self.arity}: {len(self.rows)} rows>"
