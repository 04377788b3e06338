"""Lines that are too long for the terminal, broken between words; what follows stands further to the right."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

NARROWEST = 30  # columns below which the terminal breaks lines as it likes
_BEFORE = re.compile(r"[\s│├└─╙╟╼]*(?:\d+\.\d\s+)?(?:[✔✘✗★●○◌?!▷]\s)?")  # branches, the time, a mark


def wrapped(text: Text, out: Console) -> Iterator[Text]:
    """The line as one or more that fit; as it is where nobody looks, or the terminal is too narrow."""
    width = out.width
    if out.soft_wrap or width < NARROWEST or cell_len(text.plain) <= width:
        yield text
        return
    if cell_len(text.plain.rstrip("─")) <= width:  # a rule that fills the line up ends there
        yield text[: width - cell_len(text.plain) + len(text.plain)]
        return
    before = _BEFORE.match(text.plain)
    hang = min(cell_len(before[0]) if before is not None else 0, width // 2) + 2
    first, rest = _cut(text, width)
    yield first
    while rest.plain:
        first, rest = _cut(rest, width - hang)
        yield Text(" " * hang).append_text(first)


def _cut(text: Text, width: int) -> tuple[Text, Text]:
    """What fits, up to the last blank, and the rest without the blanks between; a long word is cut within."""
    plain, at, cells, blank = text.plain, 0, 0, 0
    while at < len(plain):
        cells += cell_len(plain[at])
        if cells > width:
            break
        at += 1
        if at < len(plain) and plain[at] == " " and plain[:at].strip():
            blank = at
    if at == len(plain):
        return text, Text()
    end = blank or max(at, 1)
    start = end + len(plain[end:]) - len(plain[end:].lstrip(" "))
    return text[:end], text[start:]
