"""Methods compiled to items: what stands in a grammar, as states hold it."""

from __future__ import annotations

from typing import Any, NamedTuple

from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    OPT,
    PAR,
    REP,
    SEQ,
    Row,
    Slot,
    inward,
    slot,
)
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Variable
from casper.plans.networks.grammar import Call, Group, Item
from casper.plans.trees.nodes import Action, Condition


class Compiled(NamedTuple):
    """A method: how many slots it has, its head, its row of items, and whether its arguments are slots 0, 1, …"""

    slots: int
    head: tuple[Any, ...]
    body: Row
    is_plain: bool


def indicator(term: Any) -> Indicator:
    """Name and arity of a term."""
    return term[0], len(term) - 1


def left_of(items: Row, before: tuple[int, ...], at: int, rest: Row) -> Row:
    """What is left of a group when an item has begun: those before it are over."""
    over = before[at] | (0 if rest else 1 << at)
    stay = [number for number in range(len(items)) if not over >> number & 1]
    left = [as_item(rest) if number == at else items[number] for number in stay]
    if len(left) <= 1:
        return tuple(left) if not left or left[0][0] is not SEQ else left[0][1]
    masks = tuple([sum(1 << new for new, old in enumerate(stay) if before[number] >> old & 1) for number in stay])
    return ((PAR, tuple(left), masks),)


def compiled(head: Any, body: Item) -> Compiled:
    """A method of the grammar."""
    slots: dict[Variable, Slot] = {}
    ours = inward(head, slots)
    is_plain = ours[1:] == tuple(map(slot, range(len(ours) - 1)))
    row = compiled_row(body, slots)
    return Compiled(len(slots), ours, row, is_plain)


def compiled_row(item: Item, slots: dict[Variable, Slot]) -> Row:
    """An item of the grammar as a row of items."""
    if isinstance(item, Group) and item.kind == "sequence":
        return tuple([each for part in item.items for each in compiled_row(part, slots)])
    return (_item(item, slots),)


def _item(item: Item, slots: dict[Variable, Slot]) -> Any:
    if isinstance(item, Action):
        return (ACT, inward(item.term, slots), None if item.by is None else inward(item.by, slots))
    if isinstance(item, Call):
        return (CALL, inward(item.term, slots))
    if isinstance(item, Condition):
        return (COND, inward(item.term, slots))
    rows = [compiled_row(each, slots) for each in item.items]
    if item.kind == "optional":
        return (OPT, tuple([each for row in rows for each in row]))
    if item.kind == "repeat":
        return (REP, as_item(rows[0]), item.least, item.most)
    if item.kind == "choice":
        return (ALT, tuple(map(as_item, rows)))
    if item.kind == "sequence":
        return (SEQ, tuple([each for row in rows for each in row]))
    return (PAR, tuple(map(as_item, rows)), _before(len(rows), item.order))


def as_item(row: Row) -> Any:
    """A row as one item."""
    return row[0] if len(row) == 1 else (SEQ, row)


def _before(count: int, order: Any) -> tuple[int, ...]:
    """By item the mask of all that come before it; items stand in an order that fits."""
    masks = [0] * count
    for first, then in sorted(order, key=lambda pair: pair[1]):
        masks[then] |= masks[first] | 1 << first
    return tuple(masks)
