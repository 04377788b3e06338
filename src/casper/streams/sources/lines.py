"""Lines of JSON, of bounded length, from a stream of text that need not be any."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import BinaryIO, TextIO

from casper.kb.errors import WorldStateError
from casper.streams.items import Line

LONGEST = 10_000_000  # characters of a line


def text_of(stream: BinaryIO) -> TextIO:
    """A stream of bytes as text; bytes of no character are kept, to be told of where they are."""
    return io.TextIOWrapper(stream, encoding="utf-8-sig", errors="surrogateescape", newline="\n")


def lines_of(stream: TextIO, file: str = "") -> Iterator[Line]:
    """The lines of a stream that are not empty; of one that is too long the beginning, so that it can be refused."""
    number = 0
    while text := stream.readline(LONGEST + 2):
        number += 1
        rest = text
        while rest and not rest.endswith("\n"):
            rest = stream.readline(LONGEST)
        if text.strip():
            yield Line(text, number, file, text.endswith("\n") or len(text) > LONGEST)


def check_line(text: str) -> None:
    """Refuse a line that is too long to be read, or that held bytes of no character.

    Raises:
        WorldStateError: it is one of these.
    """
    if len(text) > LONGEST and len(text.rstrip("\n")) > LONGEST:
        raise WorldStateError(f"it is longer than {LONGEST:,} characters")
    if text.isascii():
        return
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as mistake:
        byte = ord(text[mistake.start]) & 0xFF
        sentence = f"it is not UTF-8 (byte 0x{byte:02x} at column {mistake.start + 1}); send JSON in UTF-8"
        raise WorldStateError(sentence) from None
