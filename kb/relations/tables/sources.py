"""Rows of constants from whatever holds a table: rows, numpy, pandas, Arrow, and files of CSV and Parquet.

Nothing is dropped on the way: what cannot be a constant is told with its row and column.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from datetime import date, time
from itertools import chain
from operator import eq
from pathlib import Path
from typing import Any

from casper.kb.errors import Place, ProgramError, ReadError
from casper.kb.relations.relation import Row
from casper.kb.relations.tables.csv_rows import csv_rows
from casper.kb.relations.tables.libraries import needed
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import is_ground

_PLAIN = frozenset((str, int))
_NUMBERS = frozenset((str, int, float))  # among which something may be "not a number"


def rows_of(source: Any, header: bool = True) -> tuple[Iterable[Row], int | None]:
    """The rows of a source, and how many columns it has where it says so itself.

    Truth values become the atoms ``true`` and ``false``, dates and times atoms in ISO 8601.

    Raises:
        ReadError: a file that cannot be read, with its line.
        ProgramError: a value that is no constant (nothing, not a number, a list, an open term …), with row and column.
        CasperError: the library that reads it is not installed.
    """
    if isinstance(source, (str, Path)):
        return _of_file(Path(source), header)
    if _is(source, "numpy", "ndarray"):
        return _of_array(source)
    if _is(source, "pandas", "DataFrame"):
        columns = [source.iloc[:, at].tolist() for at in range(source.shape[1])]
        return _of_columns(list(map(str, source.columns)), columns)
    if _is(source, "pyarrow", "Table") or _is(source, "pyarrow", "RecordBatch"):
        return _of_arrow(source)
    return _of_rows(source), None


def _is(source: Any, library: str, kind: str) -> bool:
    """Whether the source is of a library's class; one that nobody has imported made none."""
    module = sys.modules.get(library)
    return module is not None and isinstance(source, getattr(module, kind))


def _of_rows(rows: Iterable[Iterable[Any]]) -> Sequence[Row]:
    found = list(map(tuple, rows))
    kinds = set(map(type, chain.from_iterable(found)))
    if kinds <= _PLAIN or (kinds <= _NUMBERS and all(map(eq, chain.from_iterable(found), chain.from_iterable(found)))):
        return found
    return [tuple([_constant(v, str(at), row) for at, v in enumerate(values)]) for row, values in enumerate(found, 1)]


def _of_file(path: Path, header: bool) -> tuple[Sequence[Row], int]:
    if path.suffix in (".csv", ".tsv"):
        return csv_rows(path, header)
    if path.suffix != ".parquet":
        raise ReadError("facts are read from .csv, .tsv and .parquet; read this file yourself", Place(str(path)))
    needed("pyarrow")
    try:
        table = needed("pyarrow.parquet").read_table(path)
    except (OSError, ValueError) as mistake:  # Arrow's own mistakes are among these
        raise ReadError(f"this file cannot be read ({mistake})", Place(str(path))) from None
    return _of_arrow(table)


def _of_arrow(table: Any) -> tuple[Sequence[Row], int]:
    return _of_columns(list(table.schema.names), [column.to_pylist() for column in table.columns])


def _of_array(array: Any) -> tuple[Sequence[Row], int]:
    if array.dtype.names:
        return _of_columns(list(array.dtype.names), [array[name].tolist() for name in array.dtype.names])
    if array.ndim not in (1, 2):
        raise ProgramError(f"an array of facts has one or two dimensions, not {array.ndim}")
    columns = [array] if array.ndim == 1 else list(array.T)
    return _of_columns([str(at) for at in range(len(columns))], [column.tolist() for column in columns])


def _of_columns(names: Sequence[str], columns: Sequence[list[Any]]) -> tuple[Sequence[Row], int]:
    return list(zip(*(_constants(name, values) for name, values in zip(names, columns)))), len(columns)


def _constants(name: str, values: list[Any]) -> list[Term]:
    if set(map(type, values)) <= _PLAIN:
        return values
    return [_constant(value, name, row) for row, value in enumerate(values, 1)]


def _constant(value: Any, name: str, row: int) -> Term:
    if _is(value, "numpy", "generic"):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, int, float)) and value == value:
        return value
    if isinstance(value, Compound) and is_ground(value):
        return value
    if isinstance(value, (date, time)) and value == value:
        return value.isoformat()
    what = "nothing" if value is None or value != value else f"{value!r}"
    raise ProgramError(f"row {row} has {what} in column {name}: a fact needs an atom or a number there")
