"""The bound on what is derived."""

from __future__ import annotations

from casper.kb.errors import BudgetExceeded
from casper.kb.terms.clauses import Indicator

MOST_ROWS = 20_000_000


def check_size(sizes: dict[Indicator, int], most_rows: int) -> None:
    """Refuse a program that derives without end before it eats the memory.

    Raises:
        BudgetExceeded: there are more rows than that; the sentence names the largest predicate.
    """
    if sum(sizes.values()) > most_rows:
        name, arity = max(sizes, key=lambda indicator: sizes[indicator])
        raise BudgetExceeded(f"there are more than {most_rows} facts; {name}/{arity} has most of them")
