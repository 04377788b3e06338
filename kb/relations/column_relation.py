"""A relation that a columnar fixpoint left behind: its columns, turned into Python rows when somebody needs them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from casper.kb.relations.columns import Ids, Interner, Table, code
from casper.kb.relations.relation import Relation, Row
from casper.kb.terms.terms import Term


class ColumnRelation(Relation):
    """Rows in a table of interned constants.

    Size and membership are answered on the columns. Any other use (a lookup by some columns, a change, a proof) first
    decodes all rows, once, after which the table is let go and this is an ordinary relation.
    """

    def __init__(self, name: str, arity: int, table: Table, interner: Interner) -> None:
        self._table: Table | None = table
        self._interner = interner
        super().__init__(name, arity)

    @property
    def rows(self) -> dict[Row, int]:
        """The rows with their rounds, decoded when first asked for."""
        table = self._table
        if table is not None:  # of two threads that come here each decodes, to equal rows
            self._decoded = self._decode(table)
            self._table = None
        return self._decoded

    @rows.setter
    def rows(self, rows: dict[Row, int]) -> None:
        self._decoded = rows

    def interned(self) -> tuple[list[Ids], list[Term]] | None:
        """The columns of numbers, with the constants they stand for; None once the rows were decoded."""
        table = self._table
        return None if table is None else (table.all_rows(), self._interner.constants)

    def _decode(self, table: Table) -> dict[Row, int]:
        constants = self._interner.constants
        rows: dict[Row, int] = {}
        for run in sorted(table.runs, key=lambda run: int(run.rounds.min())):
            columns = [[constants[number] for number in column.tolist()] for column in run.columns]
            rows.update(zip(zip(*columns), run.rounds.tolist()))
        return rows

    def __contains__(self, row: object) -> bool:
        table = self._table
        if table is None:
            return row in self._decoded
        numbers = [self._interner.number(constant) for constant in row]  # type: ignore[attr-defined]
        if any(number is None or number >= table.base for number in numbers):  # others may use the interner, too
            return False
        columns = [np.array([number], np.int64) for number in numbers]
        return bool(table.has(code(columns, table.base, 1))[0])

    def __len__(self) -> int:
        table = self._table
        return len(table) if table is not None else len(self._decoded)

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)
