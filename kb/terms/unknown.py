"""What could not be worked out: a value that may be equal to anything, and the mark of a doubtful solution."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from casper.kb.terms.terms import Compound, Term, Variable


class Unknown:
    """The one value ``UNKNOWN``; never part of a row that holds."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "?"

    def __reduce__(self) -> str:
        return "UNKNOWN"


UNKNOWN: Final = Unknown()

DOUBT: Final = Variable("\0doubt")  # bound to a sentence in a substitution that holds only if what is undefined does


def has_unknown(term: Term) -> bool:
    """Whether some part of the term is unknown."""
    if not isinstance(term, tuple):
        return term is UNKNOWN
    waiting = list(term)
    while waiting:
        part = waiting.pop()
        if part is UNKNOWN:
            return True
        if isinstance(part, tuple):
            waiting.extend(part)
    return False


def may_equal(left: Term, right: Term) -> bool:
    """Whether two ground terms are equal for some value of what is unknown in them."""
    waiting = [(left, right)]
    while waiting:
        left, right = waiting.pop()
        if left is right or left is UNKNOWN or right is UNKNOWN:
            continue
        if isinstance(left, tuple) and isinstance(right, tuple) and len(left) == len(right):
            waiting.extend(zip(left, right))
        elif left != right:
            return False
    return True


def opened(term: Term, count: Iterator[int]) -> Term:
    """The term with a variable of its own for each unknown value."""
    if term is UNKNOWN:
        return Variable("Unknown", next(count))
    if isinstance(term, Compound) and has_unknown(term):
        return Compound([opened(part, count) for part in term])
    return term


def closed(term: Term) -> Term:
    """The term with every variable unknown."""
    if isinstance(term, Variable):
        return UNKNOWN
    if isinstance(term, Compound):
        return Compound([closed(part) for part in term])
    return term
