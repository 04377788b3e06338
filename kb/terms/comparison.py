"""Comparisons in a body: ``=``, ``\\=``, ``==``, ``\\==``, ``<``, ``>``, ``=<``, ``>=`` and ``is``."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify

_ORDER: dict[str, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    ">": operator.gt,
    "=<": operator.le,
    ">=": operator.ge,
}
_ARITHMETIC: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_LARGEST = 10**18  # beyond it a number is refused: a derivation that counts up must not eat the memory


def is_ready(literal: Literal, bindings: Bindings) -> bool:
    """Whether the comparison can be decided now: ``=`` always, ``is`` with a known right side, others when ground."""
    operator_, left, right = literal.atom
    if operator_ == "=" and not literal.negated:
        return True
    if operator_ == "is" and not literal.negated:
        return is_ground(substitute(right, bindings))
    return is_ground(substitute(left, bindings)) and is_ground(substitute(right, bindings))


def compare(literal: Literal, bindings: Bindings) -> Bindings | None:
    """The bindings under which a ready comparison holds, or None; what is no number never compares as one."""
    operator_, left, right = literal.atom
    extended = _holds(str(operator_), left, right, bindings)
    if literal.negated:
        return bindings if extended is None else None
    return extended


def _holds(operator_: str, left: Term, right: Term, bindings: Bindings) -> Bindings | None:
    if operator_ == "=":
        return unify(left, right, bindings)
    if operator_ in ("\\=", "\\=="):
        return bindings if unify(left, right, bindings) is None else None
    if operator_ == "==":
        return bindings if substitute(left, bindings) == substitute(right, bindings) else None
    value = evaluate(substitute(right, bindings))
    if value is None:
        return None
    if operator_ == "is":
        return unify(left, value, bindings)
    other = evaluate(substitute(left, bindings))
    return bindings if other is not None and _ORDER[operator_](other, value) else None


def evaluate(term: Term) -> int | float | None:
    """The value of a ground arithmetic term, or None when it has none (not numbers, division by zero, too large)."""
    if isinstance(term, (int, float)):
        return term
    if isinstance(term, Compound) and term.arity == 2 and term.functor in _ARITHMETIC:
        left, right = evaluate(term[1]), evaluate(term[2])
        if left is None or right is None or (term.functor == "/" and right == 0):
            return None
        try:
            value: int | float = _ARITHMETIC[term.functor](left, right)
        except OverflowError:  # an integer too large to become a float
            return None
        return value if abs(value) <= _LARGEST else None
    return None
