"""Numbers within bounds."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import Any

from casper.kb.top_down.builtins.builtin import Builtin, Outcome, Values, is_known, no_meaning

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


NUMBERS = {("between", 3): Builtin(_between, _bounds_known)}
