"""Findings: what ``casper check`` has to say about a text, as data; every check yields them, a printer shows them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from casper.kb.checks.printing import finding_line
from casper.kb.errors import CasperError, Place
from casper.kb.terms.clauses import NOWHERE
from casper.kb.text.lines import text_of


class Severity(StrEnum):
    """How bad it is.

    An error keeps the text from being loaded, or from meaning anything; a warning is most likely a mistake; a note is
    worth a look.
    """

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Finding:
    """One mistake: where, how bad, and a sentence that says what it is and what to do."""

    place: Place
    severity: Severity
    message: str

    def to_json(self) -> dict[str, Any]:
        """``{"file": …, "line": n, "column": n, "severity": …, "message": …}``; line 0 is the file as a whole."""
        place = self.place
        return {
            "file": place.file,
            "line": place.line,
            "column": place.column,
            "severity": str(self.severity),
            "message": self.message,
        }

    def __str__(self) -> str:
        return text_of([finding_line(self.place, self.severity, self.message)])


def error(place: Place, message: str) -> Finding:
    """A mistake that keeps the text from being loaded, or from meaning anything."""
    return Finding(place, Severity.ERROR, message)


def warning(place: Place, message: str) -> Finding:
    """Most likely a mistake."""
    return Finding(place, Severity.WARNING, message)


def note(place: Place, message: str) -> Finding:
    """Worth a look."""
    return Finding(place, Severity.NOTE, message)


def finding_of(mistake: CasperError, otherwise: Place = NOWHERE) -> Finding:
    """An exception as a finding; one without a place stands at ``otherwise``."""
    return error(mistake.place or otherwise, mistake.sentence)


def sorted_findings(findings: Iterable[Finding]) -> list[Finding]:
    """Each finding once, by file, line, column, and the worst first."""
    order = list(Severity)
    places = {f: (f.place.file, f.place.line, f.place.column, order.index(f.severity)) for f in findings}
    return sorted(places, key=lambda finding: (*places[finding], finding.message))
