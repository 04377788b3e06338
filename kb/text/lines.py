"""Printed lines: text in spans, each with the role it plays.

Printers make them of objects. ``print(object)`` shows their text; a terminal shows the same text and may colour roles.

    >>> text_of([line(Span("✔", "good"), " eat(ann, meal) is valid")])
    '✔ eat(ann, meal) is valid'
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple, TypeAlias

Role: TypeAlias = Literal[
    "plain", "strong", "faint", "share", "good", "bad", "outcome", "error", "warning", "note", "walk", "carry", "grasp"
]


class Span(NamedTuple):
    """A piece of a line. Its text is shown as it is: nothing in it is markup."""

    text: str
    role: Role = "plain"


Line: TypeAlias = tuple[Span, ...]


def line(*parts: str | Span) -> Line:
    """A line of spans; a string is a plain one."""
    return tuple(part if isinstance(part, Span) else Span(part) for part in parts)


def lines_of(text: str, role: Role = "plain") -> Iterator[Line]:
    """The lines of a text, all in one role."""
    return ((Span(part, role),) for part in text.split("\n"))


def indented(lines: Iterable[Line], by: str = "  ") -> Iterator[Line]:
    """The lines, further to the right."""
    return ((Span(by), *spans) for spans in lines)


def text_of(lines: Iterable[Line]) -> str:
    """What ``print`` shows."""
    return "\n".join("".join(span.text for span in spans) for spans in lines)


def one_line(text: str, most: int = 160) -> str:
    """What a ``repr`` says, in angle brackets: without line breaks, and cut where it is long."""
    shown = " ".join(text.splitlines())
    return f"<{shown}>" if len(shown) <= most else f"<{shown[: most - 1]}…>"


def bar(share: float, width: int = 10) -> Span:
    """A share from 0 to 1 as a bar of blocks, exact to an eighth of a cell."""
    eighths = round(max(0.0, min(1.0, share)) * width * 8)
    full, rest = divmod(eighths, 8)
    return Span(("█" * full + (" ▏▎▍▌▋▊▉"[rest] if rest else "")).ljust(width), "share")
