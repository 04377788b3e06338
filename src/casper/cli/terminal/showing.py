"""Printed lines on the terminal: the one place where roles become colours, and where text meets rich."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from rich.console import Console
from rich.text import Text

from casper.cli.terminal.plain import visible
from casper.cli.terminal.wrapping import wrapped
from casper.kb.text.lines import Line, Role, Span, lines_of

STYLES: dict[Role, str] = {
    "plain": "",
    "strong": "bold",
    "faint": "dim",
    "share": "cyan",
    "good": "green",
    "bad": "red",
    "outcome": "bold green",
    "error": "bold red",
    "warning": "yellow",
    "note": "cyan",
    "walk": "blue",
    "carry": "magenta",
    "grasp": "yellow",
}


def show(out: Console, lines: Iterable[Line]) -> None:
    """Print lines as they come, in colours where the terminal has them.

    A line that does not fit a terminal is broken between words. No text is taken for markup, and no control character
    of a domain's text reaches the terminal: it is spelled out.
    """
    for spans in lines:
        for part in wrapped(Text.assemble(*map(_styled, spans)), out):
            out.print(part, soft_wrap=True)


def say(out: Console, text: str) -> None:
    """Print plain text."""
    show(out, lines_of(text))


def complain(text: str) -> None:
    """Print a sentence on standard error, with our name in front; in a terminal broken between words."""
    if not sys.stderr.isatty():
        print(f"casper: {visible(text)}", file=sys.stderr)
        return
    say(Console(stderr=True, highlight=False, soft_wrap=False, emoji=False, markup=False), f"casper: {text}")


def _styled(span: Span) -> tuple[str, str]:
    return visible(span.text), STYLES[span.role]
