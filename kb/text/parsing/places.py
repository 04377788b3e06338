"""Places in a text: offsets as lines and columns, and mistakes with the line under them."""

from __future__ import annotations

from casper.kb.errors import Place, ReadError


class Places:
    """Offsets of a text as places, counted on from the last one asked for."""

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file
        self._seen, self._line, self._line_start = 0, 1, 0

    def of(self, at: int) -> Place:
        """The place of an offset."""
        if at < self._seen:
            self._seen, self._line, self._line_start = 0, 1, 0
        new_lines = self.text.count("\n", self._seen, at)
        if new_lines:
            self._line += new_lines
            self._line_start = self.text.rfind("\n", self._seen, at) + 1
        self._seen = at
        return Place(self.file, self._line, at - self._line_start + 1)


def excerpt(text: str, line: int, column: int) -> str:
    """A line of the text with a caret under the column."""
    lines = text.split("\n")  # no other character ends a line
    shown = "".join(c if c.isprintable() else " " for c in lines[min(line, len(lines)) - 1])
    return f"    {shown}\n    {' ' * (column - 1)}^"


def mistake_at(text: str, file: str, at: int, sentence: str, quoted: str = "") -> ReadError:
    """A mistake at an offset of the text, with its line; ``quoted`` is what the sentence repeats of it."""
    line, column = text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)
    return ReadError(sentence, Place(file, line, column), excerpt(text, line, column), quoted)
