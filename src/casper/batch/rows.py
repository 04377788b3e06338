"""Rows to be worked on: a number, what is given, and what is wrong with it, if anything is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from casper.kb.errors import CasperError, Place

Given: TypeAlias = Mapping[str, Any]
Rows: TypeAlias = "Iterable[Mapping[str, Any] | Sequence[str] | str] | str | Path"


@dataclass(frozen=True, slots=True)
class Row:
    """One row; ``number`` counts from 1. With a ``mistake`` there is nothing to work on."""

    number: int
    given: Given = field(default_factory=dict)
    mistake: str = ""


def texts_of(value: Any, key: str) -> list[str]:
    """A list of texts: as it is, or one text with its parts between semicolons.

    Raises:
        CasperError: it is neither.
    """
    if isinstance(value, str):
        return [part for part in map(str.strip, value.split(";")) if part]
    if isinstance(value, Iterable) and not isinstance(value, Mapping):
        found = list(value)
        if all(isinstance(part, str) for part in found):
            return found
    raise CasperError(f"{key} is a list of texts, or one text with semicolons between them, not {_shown(value)}")


def text_of(value: Any, key: str) -> str:
    """One text.

    Raises:
        CasperError: it is none.
    """
    if not isinstance(value, str) or not value.strip():
        raise CasperError(f"{key} is a text, not {_shown(value)}")
    return value.strip()


def wanted(row: Row, key: str) -> Any:
    """What a row must have.

    Raises:
        CasperError: it has not.
    """
    if key not in row.given:
        there = ", ".join(map(str, row.given)) or "nothing"
        raise CasperError(f"the row has no {key}; it has {there}")
    return row.given[key]


def others(row: Row, key: str, results: Iterable[str]) -> Iterator[tuple[str, Any]]:
    """What else a row has, which is carried over: an identifier, a label. Names of results are not."""
    taken = {key, "row", *results}
    return ((str(name), value) for name, value in row.given.items() if name not in taken)


def at(file: Path, line: int) -> str:
    """The place of a row in a file, for a sentence."""
    return str(Place(str(file), line))


def _shown(value: Any) -> str:
    return repr(value) if len(repr(value)) < 60 else f"{repr(value)[:57]}…"
