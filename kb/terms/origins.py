"""Where a given row comes from: a clause, a block of facts in a large text, or nowhere (it was loaded in bulk)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.clauses import NOWHERE, Clause, Indicator
from casper.kb.terms.terms import Compound, Term

_Row: TypeAlias = tuple[Term, ...]


@dataclass(frozen=True, eq=False)
class FactBlock:
    """Ground facts of one predicate that a large text states: rows without a clause for each.

    ``locate`` reads the text once more, for the place of every row; it is asked at the first question only.
    """

    indicator: Indicator
    rows: Sequence[_Row]
    locate: Callable[[], Mapping[_Row, Place]]

    @cached_property
    def places(self) -> Mapping[_Row, Place]:
        """Where each row is stated first."""
        return self.locate()

    def clauses(self) -> list[Clause]:
        """The block as clauses, in its order."""
        name, _ = self.indicator
        return [Clause(Compound((name, *row)), (), self.places[row]) for row in self.rows]


Origin: TypeAlias = Clause | FactBlock | None


def clause_behind(head: Compound, origin: Origin) -> Clause:
    """The fact that states a row, with its place where it has one."""
    if isinstance(origin, Clause):
        return origin
    return Clause(head, (), NOWHERE if origin is None else origin.places[head.args])
