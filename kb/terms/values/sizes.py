"""How large a term is as a tree, told without going through it as one: shared parts double with every level.

What is hashed, evaluated or printed is gone through as a tree, so a term that is too large as one is refused before.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from casper.kb.errors import BudgetExceeded
from casper.kb.terms.terms import Term
from casper.kb.terms.values.effort import SMALL

MOST_PARTS = 1 << 22  # compound parts of a term as a tree: some 400 MB


def check_size(terms: Iterable[Any]) -> None:
    """Refuse terms that would be too large as trees, in the time that their parts take when each is looked at once.

    Raises:
        BudgetExceeded: one has more than ``MOST_PARTS`` compound parts, each counted as often as it occurs.
    """
    sizes: dict[int, int] = {}
    waiting = [term for term in map(_value, terms) if isinstance(term, tuple)]
    while waiting:
        term = waiting[-1]
        parts = [part for part in map(_value, term) if isinstance(part, tuple)]
        inner = [part for part in parts if id(part) not in sizes]
        if inner and id(term) not in sizes:
            waiting.extend(inner)
            continue
        waiting.pop()
        sizes[id(term)] = size = 1 + sum(sizes[id(part)] for part in parts)
        if size > MOST_PARTS:
            raise too_large()


def check_large(term: Term) -> None:
    """`check_size` of a term that is to be looked at as a tree, hashed or evaluated; a small one is seen to be small.

    Raises:
        BudgetExceeded: as `check_size`.
    """
    waiting, seen = [term], 0
    while waiting:
        for part in waiting.pop():
            if isinstance(part, tuple):
                seen += 1
                if seen > SMALL:
                    check_size([term])
                    return
                waiting.append(part)


def too_large() -> BudgetExceeded:
    """What is raised where a term has too many parts."""
    return BudgetExceeded(f"the search met a term of more than {MOST_PARTS:,} parts: the answer is unknown")


def _value(term: Any) -> Any:
    """What a part stands for while a search runs: a cell is a list of its value and its age."""
    while type(term) is list:
        term = term[0]
    return term
