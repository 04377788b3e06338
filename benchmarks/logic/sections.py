"""One family of benchmarks when it was measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .bounds import Bound
from .figures import Figure, Skipped


@dataclass(frozen=True, slots=True)
class Section:
    """One family's figures, the lines on which answers differ, and its promises."""

    name: str
    title: str
    timed: str
    found: tuple[Figure | Skipped, ...]
    differing: Mapping[str, str]  # by task
    promises: tuple[Bound, ...]
    broken: bool = False  # a benchmark of casper itself failed

    @property
    def figures(self) -> list[Figure]:
        """What was measured."""
        return [x for x in self.found if isinstance(x, Figure)]
