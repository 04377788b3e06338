"""Facts in bulk: a run of lines ``name(value, value).`` becomes rows, predicate by predicate, with no clause for each.

A value is a constant: a name, a text in quotes or a number. What the expression matches is what the parser would read.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from casper.kb.errors import Place
from casper.kb.terms.clauses import SYSTEM, Indicator
from casper.kb.terms.control import CONTROL
from casper.kb.terms.origins import FactBlock
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.terms.terms import Term
from casper.kb.text.bulk.constants import NUMBER, QUOTED, Constants, name_expression
from casper.kb.text.parsing.tokens import COMMENT, Unreadable

_LEAST = 1_000  # characters of a run that is worth a block
_RESERVED = frozenset([*(name for name, _ in (*SYSTEM, *CONTROL)), *COMPARISONS, "call", ":"])  # no facts are of these


def _run_expression(text: str) -> re.Pattern[str]:
    """Runs of facts, each on its own line, in a text with these letters."""
    name = name_expression(text)
    value = rf"(?:{name}|{NUMBER}|{QUOTED})"
    return re.compile(rf"(?:\s++|{COMMENT})*+((?:(?:{name}|{QUOTED})\({value}(?:, ?{value})*+\)\.\n)++)")


@dataclass
class BlockReader:
    """Collects the runs of facts of one text."""

    text: str
    file: str
    _constants: Constants = field(default_factory=Constants)
    _rows: dict[Indicator, list[tuple[Term, ...]]] = field(default_factory=lambda: defaultdict(list))
    _spans: dict[Indicator, list[tuple[int, int]]] = field(default_factory=lambda: defaultdict(list))
    _looked_at: int = 0  # up to there is no run that is worth it

    def __post_init__(self) -> None:
        self._match = _run_expression(self.text).match

    def run(self, at: int) -> int | None:
        """Take the run of facts that starts at an offset; where it ends, or None when there is none worth it."""
        if at < self._looked_at or (found := self._match(self.text, at)) is None:
            return None
        if found.end() - found.start(1) < _LEAST or not self._take(*found.span(1)):
            self._looked_at = found.end()
            return None
        return found.end()

    def _take(self, begin: int, end: int) -> bool:
        """Add the rows of a run; False when there is something in it that the parser has to tell of."""
        by_predicate: dict[Indicator, list[str]] = defaultdict(list)
        try:
            for indicator, arguments in _facts(self.text[begin:end], self._constants):
                by_predicate[indicator].append(arguments)
        except Unreadable:
            return False
        if any(name in _RESERVED for name, _ in by_predicate):
            return False
        for indicator, lines in by_predicate.items():
            values = map(self._constants.__getitem__, ",".join(lines).split(","))
            self._rows[indicator].extend(zip(*[values] * indicator[1]))
            self._spans[indicator].append((begin, end))
        return True

    def blocks(self) -> list[FactBlock]:
        """What was collected: a block for each predicate."""
        return [FactBlock(i, rows, self._locator(i)) for i, rows in self._rows.items()]

    def _locator(self, indicator: Indicator) -> Callable[[], Mapping[tuple[Term, ...], Place]]:
        rows, spans = self._rows[indicator], self._spans[indicator]
        return lambda: _located(self.text, self.file, indicator, rows, spans)


def _facts(run: str, constants: Constants) -> Iterator[tuple[Indicator, str]]:
    """The predicate of each line of a run, and the texts of its arguments with commas between them.

    Raises:
        Unreadable: there is an escape that is none.
    """
    for line in constants.aside(run).replace(", ", ",")[:-3].split(").\n"):
        name, _, arguments = line.partition("(")
        yield (constants[name], arguments.count(",") + 1), arguments


def _located(
    text: str, file: str, indicator: Indicator, rows: Sequence[tuple[Term, ...]], spans: Sequence[tuple[int, int]]
) -> Mapping[tuple[Term, ...], Place]:
    found: dict[tuple[Term, ...], Place] = {}
    for row, place in zip(rows, _places(text, file, indicator, spans)):
        found.setdefault(row, place)
    return found


def _places(text: str, file: str, indicator: Indicator, spans: Sequence[tuple[int, int]]) -> Iterator[Place]:
    """The places of a predicate's facts, in order."""
    constants = Constants()
    for begin, end in spans:
        line, column = text.count("\n", 0, begin) + 1, begin - text.rfind("\n", 0, begin)
        for number, (stated, _) in enumerate(_facts(text[begin:end], constants), line):
            if stated == indicator:
                yield Place(file, number, column if number == line else 1)
