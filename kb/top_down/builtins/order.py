"""The standard order of ground terms: numbers, then atoms, then compounds by arity, name and arguments."""

from __future__ import annotations

from functools import cmp_to_key
from typing import Any

from casper.kb.terms.terms import Term
from casper.kb.terms.values.effort import SMALL, charge


def ordered(terms: list[Term]) -> list[Term]:
    """The terms in standard order; equal ones stay as they come."""
    if len(terms) > SMALL:
        charge(4 * len(terms))
    return sorted(terms, key=cmp_to_key(compared))


def without_repeats(terms: list[Term]) -> list[Term]:
    """Ordered terms, of identical ones the first."""
    return [term for at, term in enumerate(terms) if at == 0 or compared(terms[at - 1], term) != 0]


def compared(left: Term, right: Term) -> int:
    """Below zero, zero or above: as the left term stands before, with or behind the right one."""
    waiting = [(left, right)]
    seen = 0
    while waiting:
        seen += 1
        if seen % SMALL == 0:
            charge(SMALL)
        left, right = waiting.pop()
        if left is right:
            continue
        outcome = _sign(_rank(left), _rank(right)) or _within(left, right)
        if outcome:
            return outcome
        if isinstance(left, tuple):
            waiting.extend(reversed(list(zip(left[1:], right[1:]))))
    return 0


def _rank(term: Term) -> int:
    if isinstance(term, (int, float)):
        return 1
    return 3 if isinstance(term, tuple) else 2


def _within(left: Term, right: Term) -> int:
    """The order of two terms of one kind, as far as it shows without their arguments."""
    if isinstance(left, tuple):
        return _sign(len(left), len(right)) or _sign(str(left[0]), str(right[0]))
    if isinstance(left, (int, float)):  # by value; of equal ones a float comes first
        return _sign(left, right) or _sign(isinstance(left, int), isinstance(right, int))
    return _sign(str(left), str(right))


def _sign(left: Any, right: Any) -> int:
    return int(left > right) - int(left < right)
