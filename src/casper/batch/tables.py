"""Tables in and out: CSV, JSON lines and Parquet, chosen by the file's name.

In JSON lines and Parquet lists and objects are what they are; in CSV a list of texts has semicolons between them, any
other value that is no text or number is JSON. A row that cannot be read is a row with its mistake.
"""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from casper.batch.rows import Row, Rows, at
from casper.kb.errors import CasperError

csv.field_size_limit(1 << 24)


def rows_of(source: Rows, key: str) -> list[Row]:
    """The rows of a table's file (`read_table`), or of Python values.

    A value that is no mapping is taken for the one thing that is worked on: ``{key: value}``.

    Raises:
        CasperError: a file that is no table, or cannot be read.
    """
    if isinstance(source, (str, Path)):
        return list(read_table(Path(source)))
    return [Row(number, dict(one) if isinstance(one, Mapping) else {key: one}) for number, one in enumerate(source, 1)]


def read_table(file: Path) -> Iterator[Row]:
    """The rows of a file, numbered from 1.

    Raises:
        CasperError: no such kind of table, the file cannot be read, or has no header.
    """
    reader = _table(file, _READERS)
    try:
        yield from reader(file)
    except OSError as mistake:
        raise CasperError(f"cannot read {file} ({mistake.strerror or mistake})") from None
    except UnicodeDecodeError as mistake:
        raise CasperError(f"{file} is no UTF-8: byte {mistake.start + 1} of a block is wrong") from None


def write_table(file: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows; the file is whole or not there at all. Columns are those of any row, in the order of the first.

    Raises:
        CasperError: no such kind of table, or the file cannot be written.
    """
    writer, beside = _table(file, _WRITERS), file.with_name(f".{file.name}.part")
    names = list(dict.fromkeys(name for row in rows for name in row))
    try:
        writer(beside, names, rows)
        os.replace(beside, file)
    except OSError as mistake:
        raise CasperError(f"cannot write {file} ({mistake.strerror or mistake})") from None


def check_table(file: Path) -> None:
    """Refuse a file that no table can be written to.

    Raises:
        CasperError: see `write_table`.
    """
    _table(file, _WRITERS)
    if not file.parent.is_dir():
        raise CasperError(f"cannot write {file}: there is no folder {file.parent}")


def _table(file: Path, kinds: Mapping[str, Callable[..., Any]]) -> Callable[..., Any]:
    if file.suffix not in kinds:
        raise CasperError(f"{file} is no table that is known here: the name ends in {', '.join(kinds)}")
    return kinds[file.suffix]


def _csv_rows(file: Path) -> Iterator[Row]:
    with file.open(newline="", encoding="utf-8-sig") as text:
        reader = csv.reader(text, strict=True)
        try:
            header = next(reader, None)
        except csv.Error as mistake:
            raise CasperError(f"{at(file, 1)}: the header is no CSV: {mistake}") from None
        if not header or len(set(header)) < len(header):
            raise CasperError(f"{at(file, 1)}: the first line names the columns, each once")
        yield from _csv_body(file, reader, header)


def _csv_body(file: Path, reader: Any, header: Sequence[str]) -> Iterator[Row]:
    number = 0
    while True:
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error as mistake:
            number += 1
            yield Row(number, mistake=f"{at(file, reader.line_num)}: no CSV: {mistake}")
            continue
        if not cells:
            continue
        number += 1
        if len(cells) != len(header):
            told = f"{len(cells)} {'cell' if len(cells) == 1 else 'cells'} under {len(header)} columns"
            yield Row(number, mistake=f"{at(file, reader.line_num)}: {told}")
        else:
            yield Row(number, dict(zip(header, cells)))


def _json_rows(file: Path) -> Iterator[Row]:
    number = 0
    with file.open("rb") as lines:
        for place, line in enumerate(lines, 1):
            if not line.strip():
                continue
            number += 1
            try:
                value = json.loads(line.decode("utf-8-sig" if place == 1 else "utf-8"))
            except (ValueError, RecursionError) as mistake:
                yield Row(number, mistake=f"{at(file, place)}: no JSON: {mistake}")
                continue
            if isinstance(value, dict):
                yield Row(number, value)
            else:
                yield Row(number, mistake=f"{at(file, place)}: a row is an object, such as {{\"actions\": [\"eat\"]}}")


def _parquet_rows(file: Path) -> Iterator[Row]:
    arrow = _parquet()
    try:
        table = arrow.ParquetFile(str(file))
        number = 0
        for batch in table.iter_batches():
            for value in batch.to_pylist():
                number += 1
                yield Row(number, value)
    except (ValueError, OSError) as mistake:
        if isinstance(mistake, FileNotFoundError):
            raise
        raise CasperError(f"{file} is no Parquet file: {str(mistake).splitlines()[0]}") from None


def _parquet() -> Any:
    try:
        import pyarrow.parquet
    except ImportError:
        raise CasperError("Parquet needs pyarrow: pip install 'casper-hri[tables]'") from None
    return pyarrow.parquet


def _write_csv(file: Path, names: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> None:
    with file.open("w", newline="", encoding="utf-8") as text:
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(names)
        for row in rows:
            writer.writerow([_cell(row.get(name)) for name in names])


def _cell(value: Any) -> Any:
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, list) and value and all(isinstance(part, str) and ";" not in part for part in value):
        return "; ".join(value)
    return json.dumps(value, ensure_ascii=False)


def _write_json(file: Path, names: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> None:
    with file.open("w", encoding="utf-8") as text:
        for row in rows:
            text.write(json.dumps(dict(row), ensure_ascii=False) + "\n")


def _write_parquet(file: Path, names: Sequence[str], rows: Sequence[Mapping[str, Any]]) -> None:
    parquet = _parquet()
    import pyarrow

    columns = {name: [row.get(name) for row in rows] for name in names}
    try:
        table = pyarrow.table(columns)
    except (pyarrow.ArrowInvalid, pyarrow.ArrowTypeError):  # a column of mixed kinds: as JSON where it is no text
        table = pyarrow.table({name: _one_kind(values) for name, values in columns.items()})
    parquet.write_table(table, str(file))


def _one_kind(values: Sequence[Any]) -> Sequence[Any]:
    kinds = {type(value) for value in values if value is not None}
    if len(kinds) <= 1 and not kinds & {dict, list}:
        return values
    return [v if v is None or isinstance(v, str) else json.dumps(v, ensure_ascii=False) for v in values]


_READERS = {".csv": _csv_rows, ".jsonl": _json_rows, ".parquet": _parquet_rows}
_WRITERS = {".csv": _write_csv, ".jsonl": _write_json, ".parquet": _write_parquet}
