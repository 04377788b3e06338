"""Reading large texts: plain sentences by one regular expression, everything else by the parser.

A knowledge base of 85,000 facts is mostly ``name(atom, 12).`` lines, a library of 10,000 goals ``name(X) --> one(X),
two(X, cup).`` lines, for which a general parser is many times too slow. What the expression matches is exactly what
the parser would read; a mistake is told by the parser, in its own words and place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import TypeAlias

from casper.kb.errors import ReadError
from casper.kb.terms.clauses import Clause, Literal, Production, Sentence
from casper.kb.terms.terms import Compound, predication
from casper.kb.text.bulk.facts import BlockReader
from casper.kb.text.bulk.terms import TERM, TERMS, Terms, first_anonymous, numbered, part_matches, parts
from casper.kb.text.parsing.places import Places
from casper.kb.text.parsing.tokens import COMMENT, OTHERS, STOP, WITHIN

Parse = Callable[[str], list[Sentence]]
_Span: TypeAlias = tuple[int, int]

_BLANK = rf"(?:\s++|{COMMENT})*"
_BLANKS = re.compile(_BLANK)
_PLAIN = re.compile(rf"{_BLANK}({TERM})(?:\s*+(-->|:-)\s*+({TERMS}))?\s*+{STOP}")
# Up to the full stop of a sentence; a full stop within these tokens ends nothing. Each ends in one way only: where no
# full stop follows, the expression does not search for it long.
_SENTENCE = re.compile(rf"(?:{WITHIN}|\w++|\s++|{OTHERS})*+{STOP}")
_MOST_SENTENCES = 400  # handed to the parser at once


def _as_it_was() -> None:
    """Nothing to forget."""


def read_large(
    text: str,
    file: str,
    parse: Parse,
    restart: Callable[[], None] = _as_it_was,
    blocks: BlockReader | None = None,
) -> list[Sentence]:
    """Every sentence of a large text, as ``parse(text)`` would give them.

    Args:
        text: what to read.
        file: its name, for places.
        parse: reads any sentences; it is given parts of the text, padded so that places come out right.
        restart: makes ``parse`` forget the operators it was told of, before it reads from the start again.
        blocks: takes runs of facts, which are then no sentences; None: every fact is a clause.

    Raises:
        ReadError: from the parser, as for the text as a whole.
    """
    plain, others = _told_apart(text, file, blocks)
    with suppress(ReadError):
        read = [sentence for part in _in_parts(text, others) for sentence in parse(part)]
        return sorted([*plain, *read], key=_line_and_column) if read else plain
    restart()
    return _with_mistake(text, others, parse, restart)


def _line_and_column(sentence: Sentence) -> tuple[int, int]:
    return sentence.place.line, sentence.place.column


def _told_apart(text: str, file: str, blocks: BlockReader | None) -> tuple[list[Sentence], list[_Span]]:
    """The plain sentences, read, and where the others stand, each with the blanks and comments behind it."""
    reader, match, at = _PlainReader(text, file), _PLAIN.match, 0
    plain: list[Sentence] = []
    others: list[_Span] = []
    while True:
        if blocks is not None and (end := blocks.run(at)) is not None:
            at = end
        elif (found := match(text, at)) is not None:
            plain.append(reader.sentence(found))
            at = found.end()
        else:
            begin = _blank_end(text, at)
            if begin == len(text):
                return plain, others
            sentence = _SENTENCE.match(text, begin)
            at = len(text) if sentence is None else _blank_end(text, sentence.end())
            others.append((begin, at))


def _blank_end(text: str, at: int) -> int:
    blank = _BLANKS.match(text, at)
    return at if blank is None else blank.end()


class _PlainReader:
    """Makes sentences of what the expression for plain ones has found, one after the other."""

    def __init__(self, text: str, file: str) -> None:
        self._text, self._terms, self._place = text, Terms(), Places(text, file).of

    def sentence(self, found: re.Match[str]) -> Sentence:
        place = self._place(found.start(1))
        head, arrow, body = found.groups("")
        if "_" in found[0] and first_anonymous(found[0]):
            head, body = numbered(head, body)
        statement = self._terms.statement(head)
        if arrow == "-->":
            items = [self._terms[item] for item in parts(body)]
            return Production(statement, items[0] if len(items) == 1 else Compound((",", *items)), place)
        return Clause(statement, self._literals(body, found.span(3)) if arrow else (), place)

    def _literals(self, body: str, span: _Span) -> tuple[Literal, ...]:
        """The conditions of a rule, each with its place in the text."""
        places = [self._place(item.start()) for item in part_matches(self._text, *span)]
        atoms = [predication(self._terms[item]) for item in parts(body)]
        return tuple(Literal(atom, False, place) for atom, place in zip(atoms, places))


def _in_parts(text: str, spans: Sequence[_Span]) -> Iterator[str]:
    return (_alone(text, spans[at : at + _MOST_SENTENCES]) for at in range(0, len(spans), _MOST_SENTENCES))


def _alone(text: str, spans: Sequence[_Span]) -> str:
    """The spans of the text at their lines and columns, with blanks in the place of everything before and between."""
    padded, seen = [], 0
    for begin, end in spans:
        line_start = max(text.rfind("\n", seen, begin) + 1, seen)
        padded += ["\n" * text.count("\n", seen, begin), " " * (begin - line_start), text[begin:end]]
        seen = end
    return "".join(padded)


def _with_mistake(
    text: str, others: Sequence[_Span], parse: Parse, restart: Callable[[], None]
) -> list[Sentence]:
    """Have the parser tell the mistake: of the sentences that are not plain, for the others have none.

    Only the line that is shown along with it can come out differently; then the parser has to read the whole text.
    """
    alone = _alone(text, others)
    try:
        parse(alone)
    except ReadError as mistake:
        line = mistake.place.line
        if alone.split("\n")[line - 1 : line] == text.split("\n")[line - 1 : line]:
            raise
    restart()
    return parse(text)
