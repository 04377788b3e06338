"""How a verdict is told to a person: valid and what was filled in, or not and because of what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from casper.kb.reasons.says import SILENT, Words
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Span, line

_MARKS = {True: Span("✔", "good"), False: Span("✘", "bad"), None: Span("?", "warning")}
_WORDS = {True: "is valid", False: "is not valid", None: "is unknown"}
_PHRASES = {True: "valid", False: "not valid", None: "unknown"}


def verdict_lines(
    statement: Compound, valid: bool | None, completed: Compound, reasons: Sequence[str], words: Words = SILENT
) -> Iterator[Line]:
    """``✔ … is valid`` and what it is in full, ``✘ … is not valid`` or ``? … is unknown`` with every reason.

    Where the author words the statement it is told so, with the term behind it.
    """
    text, told = term_text(as_term(statement)), _told(statement, valid, words)
    yield (
        line(_MARKS[valid], f" {text} {_WORDS[valid]}")
        if told is None
        else line(_MARKS[valid], f" {told}   ", _term(text))
    )
    if valid and completed != statement:
        text, said = term_text(as_term(completed)), words.sentence(completed)
        yield line(f"  so it is {text}") if said is None else line(f"  {words.phrase('so', said)}   ", _term(text))
    for reason in reasons:
        yield line(f"  {words.phrase('because', reason)}")


def _told(statement: Compound, valid: bool | None, words: Words) -> str | None:
    """A verdict in the author's words; where nothing is said of what is not so, with a word of ours behind it."""
    denied = words.sentence(statement, denied=True, plainly=True) if valid is False else None
    said = denied or words.sentence(statement)
    if denied is not None or (said is None and not words.is_foreign):
        return denied
    return words.phrase(_PHRASES[valid], said or term_text(as_term(statement)))


def _term(text: str) -> Span:
    return Span(f"[{text}]", "faint")
