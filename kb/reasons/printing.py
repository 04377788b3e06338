"""How a verdict is told to a person: valid and what was filled in, or not and because of what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Span, line

_MARKS = {True: Span("✔", "good"), False: Span("✘", "bad"), None: Span("?", "warning")}
_WORDS = {True: "is valid", False: "is not valid", None: "is unknown"}


def verdict_lines(
    statement: Compound, valid: bool | None, completed: Compound, reasons: Sequence[str]
) -> Iterator[Line]:
    """``✔ … is valid`` and what it is in full, ``✘ … is not valid`` or ``? … is unknown`` with every reason."""
    yield line(_MARKS[valid], f" {term_text(as_term(statement))} {_WORDS[valid]}")
    if valid and completed != statement:
        yield line(f"  so it is {term_text(as_term(completed))}")
    for reason in reasons:
        yield line(f"  because {reason}")
