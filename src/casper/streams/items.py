"""What flows in a stream: lines, what they hold, and sentences about what is wrong with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from casper.engine.events.records import setters
from casper.engine.live import Message


@dataclass(frozen=True, slots=True, init=False)
class Line:
    """A line of a stream, counted from 1; ``file`` is empty for a stream without a name.

    ``is_whole`` is False for a last line that nothing ended.
    """

    text: str
    number: int
    file: str = ""
    is_whole: bool = True

    def __init__(self, text: str, number: int, file: str = "", is_whole: bool = True) -> None:
        _text(self, text)
        _number(self, number)
        _file(self, file)
        _is_whole(self, is_whole)

    @property
    def where(self) -> str:
        """Its place, for a sentence: ``line 5``, or ``seen.jsonl:5``."""
        return place(self.number, self.file)


_text, _number, _file, _is_whole = setters(Line)


@dataclass(frozen=True, slots=True, init=False)
class Given:
    """What a line holds."""

    message: Message
    number: int
    file: str = ""

    def __init__(self, message: Message, number: int, file: str = "") -> None:
        _message(self, message)
        _given_number(self, number)
        _given_file(self, file)

    @property
    def where(self) -> str:
        """As `Line.where`."""
        return place(self.number, self.file)


_message, _given_number, _given_file = setters(Given)


@dataclass(frozen=True, slots=True)
class Note:
    """A sentence about the stream, which goes on (``is_end``: which ends here, too soon)."""

    sentence: str
    is_end: bool = False


Item: TypeAlias = Given | Note


def place(number: int, file: str) -> str:
    """Where a line stands."""
    return f"{file}:{number}" if file else f"line {number}"
