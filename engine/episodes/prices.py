"""What it costs to believe that a partner begins, drops, adds or skips something: settings with defaults.

    setting(plans, begin, 0.05).     setting(plans, abandon, 0.003).     setting(plans, needless, 0.01).
    setting(plans, missed, 0.15).     setting(plans, helping, 0.02).     setting(plans, settled, 0.1).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from difflib import get_close_matches
from typing import Any

from casper.engine.settings import Rows, read_settings, require
from casper.kb.errors import CasperError, DomainError, Place

SECTION = "plans"
_OTHERS = ("recursion",)  # what else is set of plans, and read elsewhere


@dataclass(frozen=True, slots=True)
class Prices:
    """Factors on the weight of a hypothesis, each above 0 and below 1.

    begin: that the next action begins a goal while another is open. abandon: that a goal is given up. needless: one
    action that serves no goal. missed: one action of a plan that was done and not seen. helping: that an action serves
    a goal which somebody else began. settled: that a thing which nothing has settled so far, a parameter of a plan or
    an argument of a needless action, is the one that is seen.
    """

    begin: float = 0.05
    abandon: float = 0.003
    needless: float = 0.01
    missed: float = 0.15
    helping: float = 0.02
    settled: float = 0.1

    def __post_init__(self) -> None:
        for field in fields(self):
            price: Any = getattr(self, field.name)
            fits = isinstance(price, (int, float)) and not isinstance(price, bool) and 0 < price < 1
            require(fits, f"setting({SECTION}, {field.name}, {price}): a price is a number above 0 and below 1")


def prices_of(rows: Rows, place: Callable[[str], Place | None] = lambda name: None, **given: float | None) -> Prices:
    """The prices that a domain states, those that are given instead, and the defaults elsewhere.

    Args:
        rows: what the domain says (`casper.engine.settings`).
        place: where the price of a name is stated, for mistakes.
        given: prices by name; None leaves one as it is.

    Raises:
        DomainError: a price that is none, two prices for one thing, or a name that nothing is set by.
    """
    for name in _stated(rows):
        _known(name, place)
    try:
        stated = read_settings(Prices, _without_others(rows), SECTION)
    except CasperError as mistake:
        raise DomainError(mistake.sentence, mistake.place or _first(rows, mistake.sentence, place)) from None
    return replace(stated, **{name: price for name, price in given.items() if price is not None})


def _stated(rows: Rows) -> Iterator[str]:
    return (str(name) for section, name, _ in rows("setting", 3) if section == SECTION)


def _known(name: str, place: Callable[[str], Place | None]) -> None:
    known = sorted([*(field.name for field in fields(Prices)), *_OTHERS])
    if name not in known:
        close = get_close_matches(name, known, n=1)
        hint = f"did you mean {close[0]}?" if close else f"{SECTION} has {', '.join(known)}"
        raise DomainError(f"setting({SECTION}, {name}, …) is unknown; {hint}", place(name))


def _without_others(rows: Rows) -> Rows:
    return lambda name, arity: (row for row in rows(name, arity) if row[:1] != (SECTION,) or row[1] not in _OTHERS)


def _first(rows: Rows, sentence: str, place: Callable[[str], Place | None]) -> Place | None:
    return next((place(name) for name in _stated(rows) if f"({SECTION}, {name}, " in sentence), None)
