"""Reading large texts: plain facts by one regular expression, everything else by the grammar.

A knowledge base of 85,000 facts is mostly ``name(atom, 12).`` lines, for which a general parser is fifty times too
slow. What the expression matches is exactly what the grammar would read; a text with a mistake in it is handed to the
grammar as a whole, so that the mistake is told in its own words and place.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator

from casper.kb.clauses import Clause, Sentence
from casper.kb.errors import Place, ReadError
from casper.kb.terms import Compound

Parse = Callable[[str], list[Sentence]]

_ARGUMENT = r"(?:[a-z][A-Za-z0-9_]*|\d{1,18}(?![\d.eE]))"
_FACT = re.compile(rf"([a-z][A-Za-z0-9_]*)\(\s*({_ARGUMENT}(?:\s*,\s*{_ARGUMENT})*)\s*\)\s*\.(?=\s|%|\Z)")
_BLANK = re.compile(r"(?:\s+|%[^\n]*\n?|/\*(?:.|\n)*?\*/)*")
# Up to the full stop of a sentence; a full stop within these tokens ends nothing (grammar.lark).
_SENTENCE = re.compile(
    r"""(?:[^%/'".\d]+|%[^\n]*|/\*(?:.|\n)*?\*/|/|'(?:[^'\\\n]|\\[^\n]|'')*'|"(?:[^"\\\n]|\\[^\n]|"")*"|\d+(?:\.\d+)?"""
    r"""|\.(?!\s|%|\Z))*\.(?=\s|%|\Z)"""
)
_MOST_SENTENCES = 400  # handed to the grammar at once


def read_large(text: str, file: str, parse: Parse) -> list[Sentence]:
    """Every sentence of a large text, as ``parse(text)`` would give them.

    Args:
        text: what to read.
        file: its name, for places.
        parse: the grammar's reader; it is given parts of the text, padded so that places come out right.

    Raises:
        ReadError: from the grammar, for the text as a whole.
    """
    try:
        return list(_sentences(text, file, parse))
    except ReadError:
        return parse(text)


def _sentences(text: str, file: str, parse: Parse) -> Iterator[Sentence]:
    position = _Position(text)
    at, waiting, begin = _blank_end(text, 0), 0, 0
    while at < len(text):
        fact = _FACT.match(text, at)
        if fact is not None:
            if waiting:
                yield from parse(position.padded(begin, at))
                waiting = 0
            yield _clause(fact, Place(file, *position.of(at)))
            end = fact.end()
        else:
            sentence = _SENTENCE.match(text, at)
            if sentence is None:
                raise ReadError("no full stop follows", Place(file, *position.of(at)))
            begin = begin if waiting else at
            waiting += 1
            end = sentence.end()
            if waiting >= _MOST_SENTENCES:
                yield from parse(position.padded(begin, end))
                waiting = 0
        at = _blank_end(text, end)
    if waiting:
        yield from parse(position.padded(begin, len(text)))


def _clause(fact: re.Match[str], place: Place) -> Clause:
    arguments = [part.strip() for part in fact[2].split(",")]
    values = [int(part) if part[0].isdigit() else sys.intern(part) for part in arguments]
    return Clause(Compound((sys.intern(fact[1]), *values)), (), place)


def _blank_end(text: str, at: int) -> int:
    blank = _BLANK.match(text, at)
    return at if blank is None else blank.end()


class _Position:
    """Line and column of growing offsets into a text."""

    def __init__(self, text: str) -> None:
        self.text, self.seen, self.line = text, 0, 1

    def of(self, at: int) -> tuple[int, int]:
        """Line and column, from 1, of an offset that is not before the last one asked for."""
        self.line += self.text.count("\n", self.seen, at)
        self.seen = at
        return self.line, at - self.text.rfind("\n", 0, at)

    def padded(self, begin: int, end: int) -> str:
        """A part of the text behind as many blank lines and columns as stand before it."""
        line, column = self.text.count("\n", 0, begin) + 1, begin - self.text.rfind("\n", 0, begin)
        return "\n" * (line - 1) + " " * (column - 1) + self.text[begin:end]
