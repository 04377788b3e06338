"""What all answers of a goal amount to: count, sum, min, max, bag and set, as in SWI's ``aggregate_all/3``."""

from __future__ import annotations

from collections.abc import Sequence

from casper.kb.errors import Place, ProgramError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, make_list
from casper.kb.terms.unification import Bindings, substitute
from casper.kb.terms.values.arithmetic import Number, evaluate
from casper.kb.terms.values.ordering import standard_key

WAYS = (("sum", 1), ("min", 1), ("max", 1), ("min", 2), ("max", 2), ("bag", 1), ("set", 1))


def is_way(what: Term) -> bool:
    """Whether a term says how answers are put together: ``count``, ``sum(E)`` …"""
    return what == "count" or (isinstance(what, Compound) and what.indicator in WAYS)


def check_way(what: Term, place: Place | None) -> None:
    """Refuse what is no way to put answers together.

    Raises:
        ProgramError: with those that there are.
    """
    if not is_way(what):
        ways = "count, sum(E), min(E), max(E), min(E, W), max(E, W), bag(T) or set(T)"
        raise ProgramError(f"aggregate_all cannot work out {term_text(what)}; write {ways}", place)


def aggregate(what: Term, answers: Sequence[Bindings]) -> Term | None:
    """What the answers amount to; None for the least or greatest of none.

    Bags and sets come in the standard order of terms; of equal extremes the first witness in that order counts.

    Raises:
        EvaluationFailed: an expression of some answer has no value.
    """
    if what == "count":
        return len(answers)
    assert isinstance(what, Compound)
    if what.arity == 1:
        return of_values(what.functor, [substitute(what[1], each) for each in answers])
    return _witnessed(what, answers)


def of_values(way: str, values: Sequence[Term]) -> Term | None:
    """What the values that the answers have amount to, as `aggregate`: ``way`` is sum, min, max, bag or set.

    Raises:
        EvaluationFailed: an expression has no value.
    """
    if way in ("bag", "set"):
        items = sorted(values, key=standard_key)
        return make_list(items if way == "bag" else dict.fromkeys(items))
    are_whole = set(map(type, values)) <= {int}
    numbers: Sequence[Number] = values if are_whole else list(map(evaluate, values))
    if way == "sum":
        return sum(numbers) if are_whole else _sum(numbers)
    return (min if way == "min" else max)(numbers, default=None)


def _sum(values: Sequence[Number]) -> Number:
    """The exact sum where that is an integer; floats are added in order of size: any order of answers agrees."""
    total: Number = 0
    for value in sorted(values):
        total = evaluate(Compound(("+", total, value)))
    return total


def _witnessed(what: Compound, answers: Sequence[Bindings]) -> Term | None:
    """The least or greatest with its witness."""
    found = [(evaluate(substitute(what[1], each)), substitute(what[2], each)) for each in answers]
    if not found:
        return None
    best = (min if what.functor == "min" else max)(value for value, _ in found)
    witness = min((witness for value, witness in found if value == best), key=standard_key)
    return Compound((what.functor, best, witness))
