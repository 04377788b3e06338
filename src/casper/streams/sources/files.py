"""Standard input, and files: plain ones, and ones that are compressed (``.gz``)."""

from __future__ import annotations

import gzip
import io
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from casper.kb.errors import CasperError
from casper.streams.items import Line, Note
from casper.streams.sources.lines import lines_of, text_of


class Standard:
    """Standard input, which is UTF-8 whatever the terminal speaks."""

    is_live = True
    lost = False

    def __init__(self, stream: TextIO) -> None:
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8-sig", errors="surrogateescape")
        self._stream = stream

    def items(self) -> Iterator[Line | Note]:
        """Its lines, to its end."""
        return lines_of(self._stream)


class File:
    """A file, or anything else that a file system names and that can be read from beginning to end."""

    is_live = False
    lost = False

    def __init__(self, path: Path) -> None:
        """Open it.

        Raises:
            CasperError: it is not there, a folder, or not to be read.
        """
        self.path = path
        try:
            plain = path.open("rb")
        except OSError as mistake:
            raise CasperError(f"cannot read {path} ({mistake.strerror or mistake})") from None
        self._plain = plain
        self._stream = text_of(gzip.GzipFile(fileobj=plain) if is_compressed(path) else plain)  # type: ignore[arg-type]

    def items(self) -> Iterator[Line | Note]:
        """Its lines; where it cannot be read on, a sentence is the last."""
        number = 0
        try:
            with self._plain, self._stream:
                for line in lines_of(self._stream, self.path.name):
                    number = line.number
                    yield line
        except (EOFError, zlib.error, OSError) as mistake:  # gzip tells a file that is none by an OSError
            because = "it is cut off" if isinstance(mistake, EOFError) else str(mistake) or type(mistake).__name__
            yield Note(f"{self.path.name} cannot be read behind line {number} ({because}); it ends here", is_end=True)


def is_compressed(path: Path) -> bool:
    """Whether a file of that name is compressed by gzip."""
    return path.suffix.lower() == ".gz"
