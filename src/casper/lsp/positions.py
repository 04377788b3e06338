"""Lines and columns of an editor, which counts units of an encoding, and offsets of a text, which counts characters."""

from __future__ import annotations

import re
from bisect import bisect_right

_ENDS = re.compile(r"\r\n|\n|\r")


class Lines:
    """Where the lines of a text begin; ``encoding`` is ``utf-8``, ``utf-16`` or ``utf-32``: what a column counts."""

    def __init__(self, text: str, encoding: str = "utf-16") -> None:
        self.text, self.encoding = text, encoding
        self.starts = [0, *(found.end() for found in _ENDS.finditer(text))]

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column, from 0, of an offset; of one that is beyond the text its end."""
        offset = max(0, min(offset, len(self.text)))
        line = bisect_right(self.starts, offset) - 1
        return line, self._units(self.text[self.starts[line] : offset])

    def offset(self, line: int, column: int) -> int:
        """The offset of a line and a column; what is beyond a line's end is its end."""
        if line >= len(self.starts):
            return len(self.text)
        start = self.starts[max(line, 0)]
        end = self.starts[line + 1] if line + 1 < len(self.starts) else len(self.text)
        content = self.text[start:end].rstrip("\r\n")
        if self.encoding == "utf-32" or content.isascii():
            return start + max(0, min(column, len(content)))
        units = 0
        for at, character in enumerate(content):
            if units >= column:
                return start + at
            units += self._units(character)
        return start + len(content)

    def of_place(self, line: int, column: int) -> int:
        """The offset of a `Place`, whose lines and columns count characters from 1 (0: unknown)."""
        if not 0 < line <= len(self.starts):
            return 0
        return min(self.starts[line - 1] + max(column - 1, 0), len(self.text))

    def _units(self, text: str) -> int:
        if text.isascii() or self.encoding == "utf-32":
            return len(text)
        if self.encoding == "utf-8":
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text) + sum(character > "\uffff" for character in text)
