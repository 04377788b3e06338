"""The reader: text becomes clauses, productions and directives, or one sentence saying where it does not."""

from __future__ import annotations

from pathlib import Path

from casper.kb.errors import DomainError, Place, ReadError
from casper.kb.terms.clauses import Literal, Sentence
from casper.kb.terms.operators import HIGHEST, STANDARD, Operators
from casper.kb.terms.origins import FactBlock
from casper.kb.terms.terms import Compound, Term
from casper.kb.text.bulk.facts import BlockReader
from casper.kb.text.bulk.reader import read_large
from casper.kb.text.citations import MARK, with_citations
from casper.kb.text.files import read_utf8
from casper.kb.text.parsing.conditions import ConditionParser
from casper.kb.text.parsing.places import Places, excerpt
from casper.kb.text.parsing.tokens import NOTHING, Tokens, sentences_of
from casper.kb.text.sentences import Told as Told
from casper.kb.text.sentences import alternatives, sentences_read

LARGE = 20_000  # characters from which plain sentences are read by an expression of their own


def read_text(
    text: str, file: str = "<text>", operators: Operators | None = None, told: Told | None = None
) -> list[Sentence]:
    """Every sentence of the text, in order.

    Args:
        text: what to read.
        file: its name, for places.
        operators: the table in force, which ``:- op(P, T, Name).`` changes; the standard one if None.
        told: called with every other directive when it is reached; what it adds to the operators is in force after it.

    Raises:
        ReadError: with file, line, column and a caret under the first thing that is not of the language.
    """
    text = text.removeprefix("\ufeff")
    sentences = _read(text, file, STANDARD.copy() if operators is None else operators, told, None)
    return with_citations(sentences, text) if MARK in text else sentences


def read_blocks(text: str, file: str = "<text>") -> tuple[list[Sentence], list[FactBlock]]:
    """As `read_text`, with the long runs of plain facts of a large text as blocks of rows, not as sentences."""
    if MARK in text:  # what cites something needs a clause that says so
        return read_text(text, file), []
    text = text.removeprefix("\ufeff")
    reader = BlockReader(text, file)
    return _read(text, file, STANDARD.copy(), None, reader), reader.blocks()


def _read(
    text: str, file: str, table: Operators, told: Told | None, blocks: BlockReader | None
) -> list[Sentence]:
    if len(text) < LARGE:
        return read_plainly(text, file, table, told)
    before = table.copy()
    return read_large(
        text, file, lambda part: read_plainly(part, file, table, told), lambda: table.become(before), blocks
    )


def read_plainly(
    text: str, file: str = "<text>", operators: Operators | None = None, told: Told | None = None
) -> list[Sentence]:
    """As `read_text`, sentence by sentence with the parser, however many there are."""
    operators = STANDARD.copy() if operators is None else operators
    places = Places(text, file)
    found: list[Sentence] = []
    for tokens in sentences_of(text):
        try:
            found += sentences_read(ConditionParser(text, file, tokens, operators), places, told)
        except RecursionError:
            place = places.of(tokens.starts[0])
            shown = excerpt(text, place.line, place.column)
            raise ReadError("this clause is nested too deeply to be read", place, shown) from None
    return found


def read_file(path: Path, operators: Operators | None = None, told: Told | None = None) -> list[Sentence]:
    """Every sentence of a file.

    Raises:
        DomainError: the file cannot be read, is no regular one, or is too large (`kb.text.files`).
        ReadError: as `read_text`.
    """
    try:
        text = read_utf8(path)
    except OSError as mistake:
        raise DomainError(f"cannot read {path} ({mistake})") from None
    return read_text(text, str(path), operators, told)


def read_query(text: str) -> tuple[tuple[Literal, ...], ...]:
    """The alternatives of a query such as ``eat(A, T, D), \\+ A = tiago``: each a conjunction of literals."""
    file, text = "<query>", text.removeprefix("\ufeff")
    sentences = sentences_of(text)
    parser = ConditionParser(text, file, next(sentences, None) or _no_tokens(text), STANDARD)
    try:
        body = parser.body()
        if parser.kinds[parser.at] != NOTHING:
            parser.stop("','")
            following = next(sentences, None)
            if following is not None:
                ConditionParser(text, file, following, STANDARD).unexpected("the end of the question")
        places = Places(text, file)
        return tuple(tuple(literals) for literals in alternatives(body, places, parser))
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place(file, 1, 1)) from None


def read_statement(text: str) -> Compound:
    """One atom, such as ``eat(human, biscuits, plate)``; variables and ``_`` are its unknown parts.

    Raises:
        ReadError: when the text is not a single atom.
    """
    bodies = read_query(text)
    if len(bodies) != 1 or len(bodies[0]) != 1:
        raise ReadError("one statement is needed here, not several", Place("<query>", 1, 1), excerpt(text, 1, 1))
    literal = bodies[0][0]
    if literal.negated or literal.is_comparison:
        raise ReadError("a plain statement is needed here", Place("<query>", 1, 1), excerpt(text, 1, 1))
    return literal.atom


def read_term(text: str, operators: Operators | None = None) -> Term:
    """One term, with or without its full stop.

    Raises:
        ReadError: when the text is not a single term.
    """
    text = text.removeprefix("\ufeff")
    sentences = sentences_of(text)
    parser = ConditionParser(text, "<term>", next(sentences, None) or _no_tokens(text), operators or STANDARD)
    try:
        term = parser.term(HIGHEST)
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place("<term>", 1, 1)) from None
    if parser.kinds[parser.at] != NOTHING:
        parser.stop()
    if (following := next(sentences, None)) is not None:
        ConditionParser(text, "<term>", following, STANDARD).unexpected("the end of the text")
    return term


def _no_tokens(text: str) -> Tokens:
    tokens = Tokens()
    tokens.close(text)
    return tokens
