"""The bound on what is derived."""

from __future__ import annotations

from collections.abc import Mapping, Sized
from dataclasses import dataclass

from casper.kb.errors import BudgetExceeded
from casper.kb.terms.clauses import Indicator

MOST_ROWS = 20_000_000
ROWS_A_STEP = 2  # a step that is charged for a large value stands for some 500 bytes


@dataclass
class Room:
    """Counts rows as they come, so that a program that derives without end is refused before it eats the memory.

    Args:
        most_rows: how many there may be.
        relations: what they go to.
    """

    most_rows: int
    relations: Mapping[Indicator, Sized]

    def __post_init__(self) -> None:
        self.taken = sum(map(len, self.relations.values()))

    @property
    def left(self) -> int:
        """How many more there may be."""
        return self.most_rows - self.taken

    def spend(self, steps: int) -> None:
        """Count large values as the rows that would be as much work and memory.

        Raises:
            BudgetExceeded: as `take`.
        """
        self.take(ROWS_A_STEP * steps)

    def take(self, new: int, of: Indicator | None = None) -> None:
        """Count some new rows, perhaps all of one predicate.

        Raises:
            BudgetExceeded: there are more rows than that; the sentence names the largest predicate.
        """
        self.taken += new
        if self.taken > self.most_rows:
            name, arity = of or max(self.relations, key=lambda indicator: len(self.relations[indicator]))
            raise BudgetExceeded(f"there are more than {self.most_rows} facts; {name}/{arity} has most of them")
