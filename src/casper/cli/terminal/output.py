"""What the printers of the commands share: JSON lines, a console, bars."""

from __future__ import annotations

import json
from typing import Any

from rich.console import Console

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Term, Variable, as_term, predication


def console() -> Console:
    """The terminal; plain text when it is none."""
    return Console(highlight=False, soft_wrap=True)


def print_json(data: dict[str, Any]) -> None:
    """One JSON object on one line, at once."""
    print(json.dumps(data, ensure_ascii=False), flush=True)


def json_value(term: Term) -> Any:
    """A term as a JSON value: numbers and atoms as they are, compound terms as text, what may be anything as null."""
    if isinstance(term, Variable):
        return None
    if isinstance(term, tuple):
        return term_text(as_term(predication(term)))
    return term


def bar(share: float, width: int = 10) -> str:
    """A share from 0 to 1 as a bar of blocks, exact to an eighth of a cell."""
    eighths = round(max(0.0, min(1.0, share)) * width * 8)
    full, rest = divmod(eighths, 8)
    return ("█" * full + (" ▏▎▍▌▋▊▉"[rest] if rest else "")).ljust(width)
