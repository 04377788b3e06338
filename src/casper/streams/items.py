"""What flows in a stream: lines, what they hold, and sentences about what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from casper.engine.live import Message


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a stream, counted from 1; ``file`` is empty for a stream without a name.

    ``is_whole`` is False for a last line that nothing ended.
    """

    text: str
    number: int
    file: str = ""
    is_whole: bool = True

    @property
    def where(self) -> str:
        """Its place, for a sentence: ``line 5``, or ``seen.jsonl:5``."""
        return place(self.number, self.file)


@dataclass(frozen=True, slots=True)
class Given:
    """What a line holds."""

    message: Message
    number: int
    file: str = ""

    @property
    def where(self) -> str:
        """As `Line.where`."""
        return place(self.number, self.file)


@dataclass(frozen=True, slots=True)
class Note:
    """A sentence about the stream, which goes on (``is_end``: which ends here, too soon)."""

    sentence: str
    is_end: bool = False


Item: TypeAlias = Given | Note


def place(number: int, file: str) -> str:
    """Where a line stands."""
    return f"{file}:{number}" if file else f"line {number}"
