"""Reading on after a mistake: every clause that can be read, and one mistake for each that cannot.

The text is cut at its full stops. Where a full stop is missing at the end of a line, the clause is cut there, so that
what follows is not lost: a mistake should be told once, not also as everything that is undefined because of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from casper.kb.errors import Place, ReadError
from casper.kb.terms.clauses import Sentence
from casper.kb.text.reader import read_text

# The tokens within which a full stop ends nothing (grammar.lark), then the full stop, then anything else.
_PIECE = re.compile(
    r"""%[^\n]*|/\*.*?\*/|/\*.*|'(?:[^'\\\n]|\\[^\n]|'')*'|"(?:[^"\\\n]|\\[^\n]|"")*"|\d+\.\d+|(\.(?=\s|%|\Z))|.""",
    re.DOTALL,
)
_BLOCK = 200  # clauses read at once, as long as all of them can be read
_HEAD = re.compile(r"(?:\s|%[^\n]*\n|/\*.*?\*/)*([a-z][A-Za-z0-9_]*)", re.DOTALL)


@dataclass
class Recovered:
    """What could be read of a text, what could not, and which predicates the unreadable clauses seem to be about."""

    sentences: list[Sentence] = field(default_factory=list)
    mistakes: list[ReadError] = field(default_factory=list)
    half_read: set[str] = field(default_factory=set)


def read_tolerantly(text: str, file: str = "<text>") -> Recovered:
    """Read every clause that can be read; never raises."""
    try:
        return Recovered(read_text(text, file))
    except ReadError as mistake:
        if mistake.place is None or "nested too deeply" in mistake.sentence:
            return Recovered(mistakes=[mistake])
    found, pieces = Recovered(), list(_pieces(text))
    for at in range(0, len(pieces), _BLOCK):
        block = pieces[at : at + _BLOCK]
        try:
            found.sentences.extend(read_text(_alone(text, block[0][0], block[-1][1]), file))
        except ReadError:
            for start, end in block:
                _read_piece(text, start, end, file, found)
    return found


def _read_piece(text: str, start: int, end: int, file: str, found: Recovered) -> None:
    """Read one clause; where its full stop is missing, what follows it as well."""
    at: int | None = start
    while at is not None:
        begin, at = at, None
        try:
            found.sentences.extend(read_text(_alone(text, begin, end), file))
        except ReadError as mistake:
            at = _missing_stop(text, begin, end, mistake)
            if at is not None:
                found.sentences.extend(_head_of(text, begin, at, file))
            elif (head := _HEAD.match(text, begin, end)) is not None:
                found.half_read.add(head[1])
            found.mistakes.append(_shown(mistake, text))


def _pieces(text: str) -> Iterator[tuple[int, int]]:
    """Start and end of every clause, its full stop included; what follows the last one is a piece, too."""
    start = 0
    for piece in _PIECE.finditer(text):
        if piece[1] is not None:
            yield start, piece.end()
            start = piece.end()
    if text[start:].strip():
        yield start, len(text)


def _alone(text: str, start: int, end: int) -> str:
    """One piece of the text where it stands, with nothing but blank lines before it."""
    line_start = text.rfind("\n", 0, start) + 1
    return "\n" * text.count("\n", 0, start) + " " * (start - line_start) + text[start:end]


def _missing_stop(text: str, start: int, end: int, mistake: ReadError) -> int | None:
    """Where the next clause begins, if what is wrong is that the one before it has no full stop.

    That is so when the mistake stands at the very start of a line where a full stop would have done.
    """
    assert mistake.place is not None
    if mistake.place.column != 1 or "a full stop" not in mistake.sentence:
        return None
    at = _offset(text, mistake.place.line)
    return at if start < at < end else None


def _head_of(text: str, start: int, cut: int, file: str) -> list[Sentence]:
    """The clause before a missing full stop, read as if it were there."""
    try:
        return read_text(f"{_alone(text, start, cut)}\n.", file)
    except ReadError:
        return []


def _offset(text: str, line: int) -> int:
    at = 0
    for _ in range(line - 1):
        at = text.find("\n", at) + 1
    return at


def _shown(mistake: ReadError, text: str) -> ReadError:
    """The mistake with its whole line under it: the piece was read without what stands before it."""
    place = mistake.place or Place()
    lines = text.split("\n")
    line = "".join(c if c.isprintable() else " " for c in lines[min(place.line, len(lines)) - 1])
    return ReadError(mistake.sentence, place, f"    {line}\n    {' ' * (place.column - 1)}^")
