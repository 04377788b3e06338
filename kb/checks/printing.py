"""How findings are shown to a person: place, severity and sentence, the line in question, and how many there are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from casper.kb.errors import Place
from casper.kb.text.files import read_utf8
from casper.kb.text.lines import Line, Role, Span, line

_ROLES: dict[str, Role] = {"error": "error", "warning": "warning", "note": "note"}  # of severities, the worst first


def finding_line(place: Place, severity: str, message: str, file: str | None = None) -> Line:
    """``file:line: severity: message``; ``file`` is what the file is called from where one is."""
    where = place.file if file is None else file
    told = Span(severity, _ROLES[severity])
    return line(f"{where}:{place.line}: " if place.line else f"{where}: ", told, f": {message}")


def excerpt_lines(place: Place) -> Iterator[Line]:
    """The line of the file, with a caret under the column; nothing where it cannot be read."""
    try:
        lines = read_utf8(Path(place.file)).split("\n")
    except (OSError, ValueError):
        return
    if not 0 < place.line <= len(lines):
        return
    shown = "".join(c if c.isprintable() else " " for c in lines[place.line - 1])
    yield line(Span(f"    {shown}", "faint"))
    if place.column:
        yield line(Span(f"    {' ' * (place.column - 1)}^", "faint"))


def tally(severities: Iterable[str]) -> str:
    """How many there are of each: ``1 error, 2 notes``."""
    found = Counter(severities)
    counts = ((kind, found[kind]) for kind in _ROLES)
    told = [f"{count} {kind}{'s' if count != 1 else ''}" for kind, count in counts if count]
    return ", ".join(told) or "nothing to find fault with"
