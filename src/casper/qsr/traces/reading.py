"""Traces from rows, CSV, Parquet and pandas, and back: one row for each thing at each time.

Columns are ``t``, ``name``, ``x``, ``y``, and where there are any ``z``, ``heading`` (radians), ``holding``, ``width``,
``depth`` and ``height`` (full extents along x, y and z). A thing that has no row at a time is absent then; so is one
whose ``x`` and ``y`` are both empty.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from casper.kb.errors import TraceError
from casper.qsr.traces.trace import Trace

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("t", "name", "x", "y", "z", "heading", "holding", "width", "depth", "height")
_SIZES = ("width", "depth", "height")
Row = Mapping[str, Any]


def from_rows(rows: Iterable[Row], places: Iterable[str] | None = None) -> Trace:
    """A trace from rows in any order; what a row does not say may be missing, None, empty or (not x, y alone) NaN.

    Args:
        rows: mappings with the columns above.
        places: what to call each row in a sentence about it; by default its number, from 1.

    Raises:
        TraceError: a row without time or name, with half a place, or with what is no number; a thing twice at one time.
    """
    cells: dict[tuple[float, str], Row] = {}
    told = iter(places) if places is not None else (f"row {n}" for n in count(1))
    for row, place in zip(rows, told):
        t, name = _time(row, place), row.get("name")
        if not isinstance(name, str) or not name:
            raise TraceError(f"{place} has no name")
        if (t, name) in cells:
            raise TraceError(f"{place}: {name} is there twice at t={t:g}")
        cells[t, name] = _numbers(row, place, name)
    return _trace(cells)


def read_csv(file: str | Path) -> Trace:
    """A trace from a CSV file with a heading.

    Raises:
        TraceError: it cannot be read, or has a mistake; the sentence has file and line.
    """
    try:
        with Path(file).open(newline="", encoding="utf-8-sig") as text:
            table = csv.DictReader(text)
            _check_columns(table.fieldnames or (), str(file))
            return from_rows(table, _lines(table, str(file)))
    except (OSError, UnicodeDecodeError, csv.Error) as mistake:
        raise TraceError(f"{file} cannot be read as CSV: {mistake}") from None


def _lines(table: csv.DictReader[str], file: str) -> Iterator[str]:
    while True:
        yield f"{file}:{table.line_num}"


def read_parquet(file: str | Path) -> Trace:
    """A trace from a Parquet file (needs ``casper-hri[tables]``).

    Raises:
        TraceError: pyarrow is missing, the file cannot be read, or has a mistake.
    """
    try:
        import pyarrow.parquet as parquet
    except ImportError:
        raise TraceError("to read Parquet, install casper-hri[tables]") from None
    try:
        table = parquet.read_table(file)
    except (OSError, ValueError) as mistake:
        raise TraceError(f"{file} cannot be read as Parquet: {str(mistake).splitlines()[0]}") from None
    _check_columns(table.column_names, str(file))
    columns = table.to_pydict()
    return from_rows(_rows_of(columns), (f"{file}, row {n}" for n in range(1, table.num_rows + 1)))


def from_pandas(frame: pd.DataFrame) -> Trace:
    """A trace from a data frame with the columns above.

    Raises:
        TraceError: a mistake in it; the sentence has the row.
    """
    _check_columns(frame.columns, "the data frame")
    columns = {str(name): frame[name].tolist() for name in frame.columns}
    return from_rows(_rows_of(columns), (f"row {label}" for label in frame.index))


def to_rows(trace: Trace) -> Iterator[dict[str, Any]]:
    """One row for each thing at each time at which it is present; what is unknown is left out."""
    for at, t in enumerate(trace.t.tolist()):
        for i, name in enumerate(trace.names):
            if trace.present is not None and not trace.present[i, at]:
                continue
            row: dict[str, Any] = {"t": t, "name": name}
            row |= {letter: float(rows[i, at]) for letter, rows in zip("xyz", trace.where)}
            if trace.heading is not None:
                row["heading"] = float(trace.heading[i, at])
            if trace.sizes is not None:
                row |= {letter: float(rows[i, at]) for letter, rows in zip(_SIZES, trace.sizes)}
            if trace.held is not None and trace.held[i, at] >= 0:
                row["holding"] = trace.names[trace.held[i, at]]
            yield {key: value for key, value in row.items() if value == value}


def to_pandas(trace: Trace) -> pd.DataFrame:
    """The same as a data frame (needs ``casper-hri[tables]``)."""
    import pandas as pd

    rows = list(to_rows(trace))
    used = [column for column in COLUMNS if any(column in row for row in rows)]
    return pd.DataFrame(rows, columns=used)


def write_csv(trace: Trace, file: str | Path) -> None:
    """The same as a CSV file, with every digit of every number."""
    with Path(file).open("w", newline="", encoding="utf-8") as text:
        table = csv.DictWriter(text, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(to_rows(trace))


def _check_columns(columns: Iterable[Any], what: str) -> None:
    given = [str(column) for column in columns]
    missing = [column for column in ("t", "name", "x", "y") if column not in given]
    if missing:
        raise TraceError(
            f"{what} has no column {missing[0]}; a trace has t, name, x, y and may have {', '.join(COLUMNS[4:])}"
        )


def _rows_of(columns: Mapping[str, list[Any]]) -> Iterator[Row]:
    names = tuple(columns)
    for values in zip(*columns.values(), strict=True):
        yield dict(zip(names, values, strict=True))


def _time(row: Row, place: str) -> float:
    t = _number(row.get("t"), "t", place)
    if t is None or not math.isfinite(t):
        raise TraceError(f"{place} has no finite time")
    return t


def _numbers(row: Row, place: str, name: str) -> dict[str, Any]:
    """The cells of a row: floats, None where there is none; ``holding`` is a name."""
    cells: dict[str, Any] = {}
    for column in COLUMNS[2:]:
        value = row.get(column)
        cells[column] = _held(value, place) if column == "holding" else _number(value, column, place)
    if (cells["x"] is None) != (cells["y"] is None):
        raise TraceError(f"{place}: {name} has an x or a y only")
    for column in ("x", "y", "z"):
        if cells[column] is not None and math.isinf(cells[column]):
            raise TraceError(f"{place}: {name} has {cells[column]:g} as its {column}; coordinates are finite numbers")
    return cells


def _number(value: Any, column: str, place: str) -> float | None:
    if value is None or value == "" or value != value:
        return None
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise TraceError(f"{place} has {value!r:.40} under {column}, which is no number") from None
    if math.isnan(number):
        raise TraceError(f"{place} has {value!r:.40} under {column}; leave the cell empty where nothing was seen")
    return number


def _held(value: Any, place: str) -> str | None:
    if value is None or value == "" or value != value:
        return None
    if not isinstance(value, str):
        raise TraceError(f"{place} has {value!r:.40} under holding, which is no name")
    return value


def _trace(cells: Mapping[tuple[float, str], Row]) -> Trace:
    times = sorted({t for t, _ in cells})
    names = list(dict.fromkeys(name for _, name in cells))
    at, of = {t: n for n, t in enumerate(times)}, {name: n for n, name in enumerate(names)}
    values = {column: np.full((len(times), len(names)), np.nan) for column in COLUMNS[2:] if column != "holding"}
    holding: list[list[str | None]] = [[None] * len(names) for _ in times]
    used: set[str] = set()
    for (t, name), row in cells.items():
        for column, value in row.items():
            if value is None:
                continue
            used.add(column)
            if column == "holding":
                holding[at[t]][of[name]] = value
            else:
                values[column][at[t], of[name]] = value
    axes = ["x", "y", "z"] if "z" in used else ["x", "y"]
    sides = _SIZES if "height" in used else _SIZES[:2]
    return Trace.of(
        times,
        names,
        np.stack([values[axis] for axis in axes], axis=2),
        present=~np.isnan(values["x"]),
        headings=values["heading"] if "heading" in used else None,
        sizes=np.stack([values[side] for side in sides], axis=2) if used & set(_SIZES) else None,
        holding=holding if "holding" in used else None,
    )
