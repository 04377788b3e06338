"""The standard order of terms: numbers by value, then atoms by letters, then compounds by arity, name and arguments."""

from __future__ import annotations

from typing import Any

from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.values.moments import Moment


def standard_key(term: Term) -> tuple[Any, ...]:
    """A key that sorts terms in the standard order; variables come first."""
    if isinstance(term, Variable):
        return 0, term.name, term.serial
    if isinstance(term, (int, float)):
        return 1, term, 0 if isinstance(term, float) else 1
    if isinstance(term, Moment):  # a time without a clock stands behind all numbers
        return 1.5, term.number
    if isinstance(term, tuple):
        return 3, len(term), str(term[0]), *(standard_key(part) for part in term[1:])
    return 2, str(term)
