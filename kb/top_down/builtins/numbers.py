"""Numbers within bounds, and next to one another."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import Any

from casper.kb.terms.terms import make_list
from casper.kb.terms.values.effort import charge
from casper.kb.top_down.builtins.builtin import Builtin, Outcome, Values, is_known, no_meaning

MOST_LISTED = 1_000_000  # numbers that numlist/3 lists
_ENDLESS = ("inf", "infinite")


def _between(low: Any, high: Any, number: Any) -> Outcome:
    if type(low) is not int:
        raise no_meaning("between/3", "a whole number", low)
    if type(high) is not int and high not in _ENDLESS:
        raise no_meaning("between/3", "a whole number or inf", high)
    if not is_known(number):
        return _rows(low, high)
    if type(number) is not int:
        raise no_meaning("between/3", "a whole number", number)
    return (None, None, None) if low <= number and (high in _ENDLESS or number <= high) else None


def _rows(low: int, high: Any) -> Iterator[Values]:
    return ((None, None, number) for number in (count(low) if high in _ENDLESS else range(low, high + 1)))


def _bounds_known(low: Any, high: Any, _: Any) -> bool:
    return is_known(low) and is_known(high)


def _checked(name: str, *terms: Any) -> None:
    for term in terms:
        if is_known(term) and type(term) is not int:
            raise no_meaning(name, "whole numbers", term)


def _succ(number: Any, following: Any) -> Outcome:
    _checked("succ/2", number, following)
    for term in (number, following):
        if is_known(term) and term < 0:
            raise no_meaning("succ/2", "numbers from 0 on", term)
    if is_known(number):
        return None, number + 1
    return (following - 1, None) if following > 0 else None


def _plus(left: Any, right: Any, whole: Any) -> Outcome:
    _checked("plus/3", left, right, whole)
    if not is_known(left):
        return whole - right, None, None
    if not is_known(right):
        return None, whole - left, None
    return None, None, left + right


def _two_known(*terms: Any) -> bool:
    return sum(map(is_known, terms)) >= 2


def _numlist(low: Any, high: Any, _: Any) -> Outcome:
    _checked("numlist/3", low, high)
    if high - low > MOST_LISTED:
        raise no_meaning("numlist/3", f"at most {MOST_LISTED:,} numbers", high)
    if low > high:
        return None
    charge(high - low)
    return None, None, make_list(range(low, high + 1))


NUMBERS = {
    ("between", 3): Builtin(_between, _bounds_known),
    ("succ", 2): Builtin(_succ, lambda left, right: is_known(left) or is_known(right)),
    ("plus", 3): Builtin(_plus, _two_known),
    ("numlist", 3): Builtin(_numlist, _bounds_known),
}
