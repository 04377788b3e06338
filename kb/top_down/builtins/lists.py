"""List predicates that a function computes: length, order, sums, membership once, an item by its number."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import Any

from casper.kb.terms.terms import Compound, Term, make_list
from casper.kb.terms.values.arithmetic import evaluate
from casper.kb.terms.values.effort import charge
from casper.kb.terms.values.sizes import MOST_PARTS, too_large
from casper.kb.top_down.builtins.builtin import (
    Builtin,
    Outcome,
    Values,
    always,
    has_end,
    is_ground,
    is_known,
    no_meaning,
    proper_items,
    walked_list,
)
from casper.kb.top_down.builtins.order import ordered, without_repeats
from casper.kb.top_down.compiled.cells import (
    Trail,
    deref,
    freeze,
    fresh_variable,
    open_cell,
    undo,
)
from casper.kb.top_down.compiled.unifying import unify


def runtime_list(items: list[Any], end: Any = "[]") -> Any:
    """A list while a search runs."""
    for item in reversed(items):
        end = (".", item, end)
    return end


def _length(whole: Any, number: Any) -> Outcome:
    items, end = walked_list(whole)
    if is_known(number) and type(number) is not int:
        raise no_meaning("length/2", "a whole number", number)
    if end == "[]":
        return None, len(items)
    if is_known(end):
        raise no_meaning("length/2", "a list", whole)
    if not is_known(number):
        return _lengths(len(items))
    if number < len(items):
        return None
    return runtime_list([*items, *_open_cells(number - len(items))]), None


def _open_cells(number: int) -> list[Any]:
    """So many open items of a list.

    Raises:
        BudgetExceeded: they are too many.
    """
    if number > MOST_PARTS:
        raise too_large()
    charge(number)
    return [open_cell() for _ in range(number)]


def _lengths(shortest: int) -> Iterator[Values]:
    for number in count(shortest):
        yield make_list(fresh_variable() for _ in range(number)), number


def _sorted(whole: Any, _: Any) -> Outcome:
    items = [freeze(item, {}) for item in proper_items("sort/2", whole)]
    return None, make_list(without_repeats(ordered(items)))


def _msorted(whole: Any, _: Any) -> Outcome:
    return None, make_list(ordered([freeze(item, {}) for item in proper_items("msort/2", whole)]))


def _numbers(name: str, whole: Any) -> list[int | float]:
    items: list[Term] = [deref(item) for item in proper_items(name, whole)]
    for item in items:
        if type(item) is not int and type(item) is not float:
            raise no_meaning(name, "numbers", item)
    return items


def _sum(whole: Any, _: Any) -> Outcome:
    total: int | float = 0
    for number in _numbers("sum_list/2", whole):
        total = evaluate(Compound(("+", total, number)))
    return None, total


def _least(whole: Any, _: Any) -> Outcome:
    numbers = _numbers("min_list/2", whole)
    return (None, min(numbers)) if numbers else None


def _greatest(whole: Any, _: Any) -> Outcome:
    numbers = _numbers("max_list/2", whole)
    return (None, max(numbers)) if numbers else None


def _memberchk(wanted: Any, whole: Any) -> Outcome:
    """The first item that the wanted one can be."""
    trail = Trail()
    items, _ = walked_list(whole)
    for item in items:
        fits = unify(wanted, item, trail, _EVERY)
        undo(trail, 0)
        if fits:
            return item, None
    return None


_EVERY = 1 << 62  # as the age of the newest choice point: every binding is noted on the trail


def _item(number: Any, whole: Any, _: Any) -> Outcome:
    items, end = walked_list(whole)
    if type(number) is not int:
        raise no_meaning("nth0/3", "a whole number", number)
    if 0 <= number < len(items):
        return None, None, items[number]
    if is_known(end) or number < 0:
        return None
    cells = _open_cells(number + 1 - len(items))
    return None, runtime_list([*items, *cells], open_cell()), cells[-1]


def _is_known(term: Any) -> Outcome:
    return (None,) if is_known(term) else None


def _is_open(term: Any) -> Outcome:
    return None if is_known(term) else (None,)


def _proper_and_ground(whole: Any, *_: Any) -> bool:
    return has_end(whole) and is_ground(whole)


def _ends(_: Any, whole: Any) -> bool:
    return has_end(whole)


LISTS = {
    ("length", 2): Builtin(_length, always),
    ("sort", 2): Builtin(_sorted, _proper_and_ground),
    ("msort", 2): Builtin(_msorted, _proper_and_ground),
    ("sum_list", 2): Builtin(_sum, _proper_and_ground),
    ("sumlist", 2): Builtin(_sum, _proper_and_ground),
    ("min_list", 2): Builtin(_least, _proper_and_ground),
    ("max_list", 2): Builtin(_greatest, _proper_and_ground),
    ("memberchk", 2): Builtin(_memberchk, _ends),
    ("$item", 3): Builtin(_item, always),
    ("$known", 1): Builtin(_is_known, always),
    ("$open", 1): Builtin(_is_open, always),
}
