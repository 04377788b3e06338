"""Comparisons in a body: ``=``, ``\\=``, ``==``, ``\\==``, ``<``, ``>``, ``=<``, ``>=``, ``=:=``, ``=\\=`` and ``is``.

A comparison whose sides cannot be evaluated neither holds nor fails: it raises `EvaluationFailed`.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, unify
from casper.kb.terms.values.arithmetic import compiled, evaluate, unknown_functions
from casper.kb.terms.values.moments import are_same, differ

_ORDER: dict[str, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    ">": operator.gt,
    "=<": operator.le,
    ">=": operator.ge,
    "=:=": are_same,
    "=\\=": differ,
}
_SAME = {"=": True, "\\=": False, "\\==": False}  # where nothing is open: whether it holds of what is the same


def is_ready(literal: Literal, bindings: Bindings) -> bool:
    """Whether the comparison can be decided now: ``=`` always, ``is`` with a known right side, others when ground."""
    operator_, left, right = literal.atom
    if operator_ == "=" and not literal.negated:
        return True
    if operator_ == "is" and not literal.negated:
        return is_ground(substitute(right, bindings))
    return is_ground(substitute(left, bindings)) and is_ground(substitute(right, bindings))


def compare(literal: Literal, bindings: Bindings) -> Bindings | None:
    """The bindings under which a ready comparison holds, or None.

    Raises:
        EvaluationFailed: a side has no value; then the comparison is undefined, and so is its negation.
    """
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
    if operator_ == "is":
        return unify(left, evaluate(substitute(right, bindings)), bindings)
    values = evaluate(substitute(left, bindings)), evaluate(substitute(right, bindings))
    return bindings if _ORDER[operator_](*values) else None


def compiled_test(literal: Literal, slots: Mapping[Variable, int]) -> Callable[[Sequence[Term]], bool] | None:
    """`compare` in an environment, for an order of numbers or for whether a variable is the same as another or an atom.

    None for other conditions. All variables must be known.
    """
    operator_, left, right = literal.atom
    if operator_ in _SAME:
        return _compiled_sameness(left, right, slots, _SAME[operator_] is not literal.negated)
    if operator_ not in _ORDER:
        return None
    holds, one, other, wanted = _ORDER[operator_], compiled(left, slots), compiled(right, slots), not literal.negated
    return lambda environment: holds(one(environment), other(environment)) is wanted


def _compiled_sameness(
    left: Term, right: Term, slots: Mapping[Variable, int], wanted: bool
) -> Callable[[Sequence[Term]], bool] | None:
    """Whether a variable has the same value as another, or as an atom; names are compared without unification."""
    if not isinstance(left, Variable):
        left, right = right, left
    if not isinstance(left, Variable) or not isinstance(right, (Variable, str)):
        return None
    one, other = slots[left], slots[right] if isinstance(right, Variable) else None

    def test(environment: Sequence[Term]) -> bool:
        first, second = environment[one], right if other is None else environment[other]
        if type(first) is str and type(second) is str:
            return (first == second) is wanted
        return (unify(first, second, {}) is not None) is wanted

    return test


def misspelt(literal: Literal) -> Iterator[str]:
    """Functions and constants in the condition's expressions that nothing computes: ``foo/1``."""
    operator_, left, right = literal.atom
    if operator_ == "is":
        yield from unknown_functions(right)
    elif operator_ in _ORDER:
        yield from unknown_functions(left)
        yield from unknown_functions(right)
