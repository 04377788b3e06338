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
from casper.kb.terms.operators import STANDARD, Operators
from casper.kb.text.parsing.places import excerpt
from casper.kb.text.parsing.tokens import OTHERS, STOP, WITHIN
from casper.kb.text.reader import Told, read_text

_PIECE = re.compile(rf"{WITHIN}|/\*[\s\S]*|{OTHERS}|({STOP})|[\s\S]")
_BLOCK = 200  # clauses read at once, as long as all of them can be read
_HEAD = re.compile(r"(?:\s|%[^\n]*\n|/\*.*?\*/)*([a-z][A-Za-z0-9_]*)", re.DOTALL)


@dataclass
class Recovered:
    """What could be read of a text, what could not, and which predicates the unreadable clauses seem to be about."""

    sentences: list[Sentence] = field(default_factory=list)
    mistakes: list[ReadError] = field(default_factory=list)
    half_read: set[str] = field(default_factory=set)


def read_tolerantly(
    text: str, file: str = "<text>", operators: Operators | None = None, told: Told | None = None
) -> Recovered:
    """Read every clause that can be read; never raises. The arguments are those of `read_text`."""
    table = STANDARD.copy() if operators is None else operators
    before, text = table.copy(), text.removeprefix("\ufeff")
    try:
        return Recovered(read_text(text, file, table, told))
    except ReadError as mistake:
        if mistake.place is None or "nested too deeply" in mistake.sentence:
            return Recovered(mistakes=[mistake])
    table.become(before)
    reading = _Reading(text, file, table, told)
    reading.all()
    return reading.found


@dataclass
class _Reading:
    """The reading of a text piece by piece; the arguments are those of `read_text`."""

    text: str
    file: str
    operators: Operators
    told: Told | None
    found: Recovered = field(default_factory=Recovered)

    def all(self) -> None:
        """Read block by block; a block with a mistake clause by clause."""
        pieces = list(_pieces(self.text))
        for at in range(0, len(pieces), _BLOCK):
            block = pieces[at : at + _BLOCK]
            before = self.operators.copy()
            try:
                self.found.sentences.extend(self.part(block[0][0], block[-1][1]))
            except ReadError:
                self.operators.become(before)
                for start, end in block:
                    self.piece(start, end)

    def part(self, start: int, end: int) -> list[Sentence]:
        """What stands in a part of the text.

        Raises:
            ReadError: as `read_text`.
        """
        return read_text(_alone(self.text, start, end), self.file, self.operators, self.told)

    def piece(self, start: int, end: int) -> None:
        """Read one clause; where its full stop is missing, what follows it as well."""
        at: int | None = start
        while at is not None:
            begin, at = at, None
            try:
                self.found.sentences.extend(self.part(begin, end))
            except ReadError as mistake:
                at = _missing_stop(self.text, begin, end, mistake)
                if at is not None:
                    self.found.sentences.extend(self.head(begin, at))
                elif (head := _HEAD.match(self.text, begin, end)) is not None:
                    self.found.half_read.add(head[1])
                self.found.mistakes.append(_shown(mistake, self.text))

    def head(self, start: int, cut: int) -> list[Sentence]:
        """The clause before a missing full stop, read as if it were there."""
        try:
            return read_text(f"{_alone(self.text, start, cut)}\n.", self.file, self.operators, self.told)
        except ReadError:
            return []


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


def _offset(text: str, line: int) -> int:
    at = 0
    for _ in range(line - 1):
        at = text.find("\n", at) + 1
    return at


def _shown(mistake: ReadError, text: str) -> ReadError:
    """The mistake with its whole line under it: the piece was read without what stands before it."""
    place = mistake.place or Place()
    return ReadError(mistake.sentence, place, excerpt(text, place.line, place.column))
