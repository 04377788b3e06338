"""What an entry of the timeline is made of: what agents are called, its time in the margin, and lines under it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.engine.events.telling import Telling
from casper.kb.reasons.says import SILENT, Words
from casper.kb.text.lines import Line, Span, line

Data: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Names:
    """What the two agents are called, and the author's words."""

    partner: str = "the partner"
    robot: str = "the robot"
    words: Words = SILENT  # in which goals, statements and steps are told

    @property
    def tell(self) -> Telling:
        """What tells them."""
        return Telling(self.words, self.partner)


NAMES = Names()


def at(t: float, *parts: str | Span) -> Line:
    """A line with its time (seconds) in the margin."""
    return line(Span(f"{t:6.1f}", "faint"), "  ", *parts)


def under(*parts: str | Span) -> Line:
    """A line under one with a time."""
    return line("        ", *parts)
