"""Facts in bulk: a run of lines ``name(value, value).`` becomes rows, predicate by predicate, with no clause for each.

A value is a name or a number without a sign. What the expression matches is what the parser would read.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from casper.kb.errors import Place
from casper.kb.terms.clauses import SYSTEM, Indicator
from casper.kb.terms.origins import FactBlock
from casper.kb.terms.terms import Term
from casper.kb.text.bulk.terms import Terms
from casper.kb.text.parsing.tokens import COMMENT

_NAME = r"[a-z][A-Za-z0-9_]*+"
_VALUE = rf"(?:{_NAME}|[0-9]{{1,15}}+(?:\.[0-9]{{1,15}}+)?)"
_RUN = re.compile(rf"(?:\s++|{COMMENT})*+((?:{_NAME}\({_VALUE}(?:, ?{_VALUE})*+\)\.\n)++)")
_LEAST = 1_000  # characters of a run that is worth a block
_RESERVED = frozenset(name for name, _ in SYSTEM)


@dataclass
class BlockReader:
    """Collects the runs of facts of one text."""

    text: str
    file: str
    _terms: Terms = field(default_factory=Terms)
    _rows: dict[Indicator, list[tuple[Term, ...]]] = field(default_factory=lambda: defaultdict(list))
    _spans: dict[Indicator, list[tuple[int, int]]] = field(default_factory=lambda: defaultdict(list))

    def run(self, at: int) -> int | None:
        """Take the run of facts that starts at an offset; where it ends, or None when there is none worth it."""
        found = _RUN.match(self.text, at)
        if found is None or found.end() - found.start(1) < _LEAST:
            return None
        by_predicate: dict[Indicator, list[str]] = defaultdict(list)
        for line in found[1].replace(", ", ",")[:-3].split(").\n"):
            name, _, arguments = line.partition("(")
            by_predicate[name, arguments.count(",") + 1].append(arguments)
        if any(name in _RESERVED for name, _ in by_predicate):
            return None
        for indicator, lines in by_predicate.items():
            values = map(self._terms.__getitem__, ",".join(lines).split(","))
            self._rows[indicator].extend(zip(*[values] * indicator[1]))
            self._spans[indicator].append(found.span(1))
        return found.end()

    def blocks(self) -> list[FactBlock]:
        """What was collected: a block for each predicate."""
        return [FactBlock(i, rows, self._locator(i)) for i, rows in self._rows.items()]

    def _locator(self, indicator: Indicator) -> Callable[[], Mapping[tuple[Term, ...], Place]]:
        rows, spans = self._rows[indicator], self._spans[indicator]
        return lambda: _located(self.text, self.file, indicator, rows, spans)


def _located(
    text: str, file: str, indicator: Indicator, rows: Sequence[tuple[Term, ...]], spans: Sequence[tuple[int, int]]
) -> Mapping[tuple[Term, ...], Place]:
    found: dict[tuple[Term, ...], Place] = {}
    for row, place in zip(rows, _places(text, file, indicator, spans)):
        found.setdefault(row, place)
    return found


def _places(text: str, file: str, indicator: Indicator, spans: Sequence[tuple[int, int]]) -> Iterator[Place]:
    """The places of a predicate's facts, in order."""
    name, arity = indicator
    for begin, end in spans:
        line, column = text.count("\n", 0, begin) + 1, begin - text.rfind("\n", 0, begin)
        for number, fact in enumerate(text[begin : end - 1].split("\n"), line):
            if fact.startswith(f"{name}(") and fact.count(",") == arity - 1:
                yield Place(file, number, column if number == line else 1)
