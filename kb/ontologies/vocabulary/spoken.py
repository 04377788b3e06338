"""What the language speaks: built-in conditions are tried out before a rule is made of them.

So an ontology never becomes a text that cannot be read, and nothing is listed as impossible that has become possible.
"""

from __future__ import annotations

from functools import cache

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError


@cache
def speaks(goal: str, answer: str | int | float | None = None) -> bool:
    """Whether the language answers a goal with ``R = answer`` (None: whether the goal holds)."""
    try:
        kb = KnowledgeBase.from_text(f"known(7). tried(R) :- known(_), {goal}.")
        found = [row["R"] for row in kb.query("tried(R)", 2)]
    except (CasperError, ArithmeticError, TypeError, ValueError):
        return False
    return found == [answer]
