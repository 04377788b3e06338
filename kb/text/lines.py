"""Printed lines: text in spans, each with the role it plays.

Printers make them of objects. ``print(object)`` shows their text; a terminal shows the same text and may colour roles,
a notebook shows what is `Shown` as HTML or as a picture.

    >>> text_of([line(Span("✔", "good"), " eat(ann, meal) is valid")])
    '✔ eat(ann, meal) is valid'
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Iterator
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


_MISLEADING = frozenset(
    "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"  # turn the direction of writing
    "\u2028\u2029"
    "\ufffe\uffff"  # no characters: no page may have them
)


def visible(text: str, keep: str = "\n") -> str:
    r"""The text with what a terminal or a page obeys instead of showing it spelt out: escape becomes ``\x1b``."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(c if c in keep or not _is_obeyed(c) else spelt(c) for c in text)


def _is_obeyed(character: str) -> bool:
    return character in _MISLEADING or unicodedata.category(character) in ("Cc", "Cs")


def spelt(character: str) -> str:
    """A character by its code."""
    return character.encode("unicode_escape").decode("ascii")


MOST_LINES = 300  # that a notebook prints of one thing
Form: TypeAlias = Literal["html", "svg"]
_shows: list[Callable[[object, Form], str | None]] = []


def show_with(shows: Callable[[object, Form], str | None]) -> None:
    """Say who shows things in a form other than text; the package does, when it is imported (`casper.notebook`)."""
    _shows[:] = [shows]


class Shown:
    """What a notebook shows as more than text.

    The thing itself knows nothing of HTML: whoever is registered by `show_with` is asked, when a notebook asks.
    """

    __slots__ = ()

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        """Where there is text only, what ``print`` shows; one line of what is very long."""
        text = str(self)
        return {"text/plain": text if text.count("\n") < MOST_LINES else repr(self)}

    def _repr_html_(self) -> str | None:
        """HTML for a notebook; None where nobody shows it so."""
        return _shows[0](self, "html") if _shows else None

    def _repr_svg_(self) -> str | None:
        """A picture for a notebook; None of what is none."""
        return _shows[0](self, "svg") if _shows else None
