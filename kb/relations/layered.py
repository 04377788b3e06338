"""A relation laid over another one that stays as it is: what an assumption adds and takes away."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from casper.kb.relations.relation import Columns, Relation, Row


class LayeredRelation(Relation):
    """The rows below, less those that are gone, with those that were added."""

    def __init__(self, below: Relation) -> None:
        super().__init__(below.name, below.arity)
        self.below = below
        self.undefined = below.undefined
        self.gone: set[Row] = set()

    def add(self, row: Row, round_: int = 0) -> bool:
        """Add a row to this layer; False when it is there already."""
        if row in self:
            return False
        self.gone.discard(row)
        # A row that comes back may rest on new premises: it belongs to this layer with its new round.
        if row in self.below:
            self.gone.add(row)
        return super().add(row, round_)

    def remove(self, row: Row) -> bool:
        """Take a row away in this layer."""
        if super().remove(row):
            return True
        if row in self.below and row not in self.gone:
            self.gone.add(row)
            self.coded = None
            return True
        return False

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        """The matching rows of both layers."""
        below = self.below.matching(columns, key)
        if self.gone:
            below = [row for row in below if row not in self.gone]
        if not self.rows:
            return below
        above: Collection[Row]
        if columns and len(columns) == self.arity:
            above = (key,) if key in self.rows else ()
        else:
            above = super().matching(columns, key)
        return [*below, *above] if above else below

    def round_of(self, row: Row) -> int:
        """The round in which a row appeared, in whichever layer."""
        found = self.rows.get(row)
        return self.below.round_of(row) if found is None else found

    def __contains__(self, row: object) -> bool:
        return row in self.rows or (row not in self.gone and row in self.below)

    def __iter__(self) -> Iterator[Row]:
        yield from (row for row in self.below if row not in self.gone)
        yield from self.rows

    def __len__(self) -> int:
        return len(self.below) - len(self.gone) + len(self.rows)
