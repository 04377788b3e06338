"""Rows of a CSV file: a header or none, numbers as numbers, and a sentence with the line for whatever does not fit."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator
from pathlib import Path

from casper.kb.errors import Place, ReadError
from casper.kb.terms.terms import Term

_NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?")  # 007 and +1 would not print back: names


def csv_rows(path: Path, header: bool) -> tuple[list[tuple[Term, ...]], int]:
    """The rows of a file, and how many columns it has; ``.tsv`` is separated by tabs.

    A cell that is written as the language writes a number is one, every other cell an atom, an empty one too: ''.

    Raises:
        ReadError: the file cannot be read, a line has more or fewer cells than the first, a number is too large, or a
            header holds numbers, or one name twice.
    """
    lines = _lines(path)
    number, first = next(lines, (1, []))
    if not first:
        sentence = "there is nothing in the first line, so nobody knows how many columns there are"
        raise ReadError(sentence, Place(str(path), 1))
    rows: list[tuple[Term, ...]] = []
    if header:
        _check_header(first, Place(str(path), number))
    else:
        rows.append(_cells(first, Place(str(path), number)))
    for number, cells in lines:
        place = Place(str(path), number)
        if len(cells) != len(first):
            raise ReadError(f"this line has {_counted(len(cells))}, the first has {len(first)}", place)
        rows.append(_cells(cells, place))
    return rows, len(first)


def _counted(cells: int) -> str:
    return "no cell" if cells == 0 else f"{cells} cell{'' if cells == 1 else 's'}"


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Lines as cells, with the number of the line they end on; empty lines at the end are none."""
    blank: list[int] = []
    line = 0
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, delimiter="\t" if path.suffix == ".tsv" else ",", strict=True)
            for cells in reader:
                line = reader.line_num
                if not cells:
                    blank.append(line)
                    continue
                yield from ((empty, []) for empty in blank)
                blank.clear()
                yield line, cells
    except (OSError, UnicodeDecodeError, csv.Error) as mistake:
        raise ReadError(f"this file cannot be read any further ({mistake})", Place(str(path), line + 1)) from None


def _check_header(names: list[str], place: Place) -> None:
    numbers = [name for name in names if _NUMBER.fullmatch(name)]
    if numbers:
        raise ReadError(f"{numbers[0]} is no name of a column; without a header, say header=False", place)
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise ReadError(f"two columns are called {twice[0]!r}; without a header, say header=False", place)


def _cells(cells: list[str], place: Place) -> tuple[Term, ...]:
    return tuple([_value(cell, place) for cell in cells])


def _value(cell: str, place: Place) -> Term:
    if not _NUMBER.fullmatch(cell):
        return cell
    try:
        value = int(cell) if cell.lstrip("-").isdigit() else float(cell)
    except ValueError:  # more digits than Python reads
        value = math.inf
    if value in (math.inf, -math.inf):
        shown = cell if len(cell) < 40 else f"{cell[:20]}… ({len(cell)} digits)"
        raise ReadError(f"{shown} is too large for a number here; put it in another form, or make it a name", place)
    return value
