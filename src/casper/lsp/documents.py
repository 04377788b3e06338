"""One text, clause by clause: what each clause says, what is wrong with it by itself, which names it has.

A clause that did not change is not looked at again, wherever it has moved to.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from casper.kb.checks.finding import Finding, finding_of
from casper.kb.checks.names import own_mistakes, single_variables
from casper.kb.checks.says import mistake_of
from casper.kb.errors import CasperError, Place
from casper.kb.program.control import plain_clauses
from casper.kb.program.declarations import declaration
from casper.kb.reasons.says import is_say
from casper.kb.terms.clauses import Clause, Directive, Indicator, Literal, Production, Sentence, is_auxiliary
from casper.kb.terms.operators import STANDARD
from casper.kb.text.directives import OP
from casper.kb.text.parsing.tokens import sentences_of
from casper.kb.text.reader import read_text
from casper.kb.text.recovery import read_tolerantly
from casper.lsp.names import Name, names_of
from casper.lsp.positions import Lines

MOST_KEPT = 20_000  # clauses
NOWHERE = "<clause>"
_OF_PLANS: tuple[Indicator, ...] = (("goal", 1), ("setting", 3))


@dataclass(frozen=True, eq=False)
class Piece:
    """A clause's text, by itself: places count from its start.

    ``needs`` are the conditions whose predicate somebody has to define; ``defines`` what the clause defines.
    """

    text: str
    sentences: tuple[Sentence, ...]
    findings: tuple[Finding, ...]
    names: tuple[Name, ...]
    needs: tuple[tuple[Indicator, Literal], ...]
    defines: tuple[Indicator, ...]
    is_half_read: bool

    @property
    def of_plans(self) -> bool:
        """Whether it is a production, or says what is a goal or how plans are dealt with."""
        said = any(each in _OF_PLANS for each in self.defines)
        return said or any(isinstance(sentence, Production) for sentence in self.sentences)


@dataclass(frozen=True, eq=False)
class Document:
    """A text with its clauses, each with the offset at which it begins."""

    path: Path
    text: str
    lines: Lines
    pieces: tuple[tuple[int, Piece], ...]

    def names(self) -> Iterator[tuple[int, Name]]:
        """Every name, with the offset of its clause."""
        for start, piece in self.pieces:
            for name in piece.names:
                yield start, name

    def piece_at(self, offset: int) -> tuple[int, Piece] | None:
        """The clause at an offset, its full stop included."""
        found = None
        for start, piece in self.pieces:
            if start > offset:
                break
            found = start, piece
        return found if found is not None and offset <= found[0] + len(found[1].text) else None

    def name_at(self, offset: int) -> tuple[int, Name] | None:
        """The name at an offset, or one that ends there."""
        found = self.piece_at(offset)
        for name in () if found is None else found[1].names:
            if found is not None and name.start <= offset - found[0] <= name.end:
                return found[0], name
        return None

    def moved(self, finding: Finding, start: int) -> Finding:
        """A finding of a clause, where the clause stands in the text."""
        line, column = self._line(start)
        place = finding.place
        moved = Place(str(self.path), place.line + line, place.column + (column if place.line == 1 else 0))
        return replace(finding, place=moved if place.line else Place(str(self.path), line + 1))

    def _line(self, offset: int) -> tuple[int, int]:
        """Line and column, from 0, in characters: lines as the checks count them."""
        return self.text.count("\n", 0, offset), offset - (self.text.rfind("\n", 0, offset) + 1)


def document(path: Path, text: str, encoding: str = "utf-16") -> Document:
    """Analyse a text; whatever it is, it never raises."""
    spans = _spans(text)
    declared = ""
    if any(":- op(" in text[start:end] or ":-op(" in text[start:end] for start, end in spans):
        declared = "\n".join(text[s:e] for s, e in spans if text[s:e].lstrip().startswith(":-") and "op(" in text[s:e])
    pieces = tuple((start, piece_of(text[start:end], declared)) for start, end in spans)
    return Document(path, text, Lines(text, encoding), pieces)


def _spans(text: str) -> list[tuple[int, int]]:
    """Start and end of every clause, without what stands between them."""
    found = []
    for tokens in sentences_of(text):
        last = max((at for at, kind in enumerate(tokens.kinds) if kind != "nothing"), default=None)
        if last is not None:
            found.append((tokens.starts[0], tokens.end(last)))
    return found


@lru_cache(maxsize=MOST_KEPT)
def piece_of(text: str, operators: str = "") -> Piece:
    """Analyse one clause, with the operators that its text declares."""
    table = STANDARD.copy()
    if operators:
        try:
            read_text(operators, NOWHERE, table)
        except CasperError:
            table = STANDARD.copy()
    try:
        read = read_tolerantly(text, NOWHERE, table)
    except RecursionError:
        return Piece(text, (), (), (), (), (), True)
    findings = [finding_of(mistake) for mistake in read.mistakes]
    needs: list[tuple[Indicator, Literal]] = []
    for clause in (s for s in read.sentences if isinstance(s, Clause)):
        needs += _needs(clause, findings)
    findings += single_variables(read.sentences)
    names = [name for tokens in sentences_of(text) for name in names_of(tokens)]
    defined = [each for sentence in read.sentences for each in _defined(sentence, findings)]
    unread = bool(read.mistakes)
    return Piece(text, tuple(read.sentences), tuple(findings), tuple(names), tuple(needs), tuple(defined), unread)


def _needs(clause: Clause, findings: list[Finding]) -> list[tuple[Indicator, Literal]]:
    """The conditions of a clause that somebody has to define; what is wrong with it goes to the findings."""
    try:
        parts = list(plain_clauses([clause], "0 "))
    except CasperError as mistake:
        findings.append(finding_of(mistake, clause.place))
        return []
    findings += own_mistakes(parts)
    if is_say(clause) and (wrong := mistake_of(clause)) is not None:
        findings.append(finding_of(CasperError(wrong, clause.place)))
    literals = (x for part in parts for x in part.body if x.needed is not None)
    return [(x.needed, x) for x in literals if x.needed is not None and not is_auxiliary(x.needed)]


def _defined(sentence: Sentence, findings: list[Finding]) -> Sequence[Indicator]:
    if isinstance(sentence, Clause):
        return (sentence.head.indicator,)
    if isinstance(sentence, Directive):
        if sentence.term.indicator in (("include", 1), ("use", 2), OP):
            return ()
        try:
            return tuple(declaration(sentence).dynamic)
        except CasperError as mistake:
            findings.append(finding_of(mistake, sentence.place))
    return ()
