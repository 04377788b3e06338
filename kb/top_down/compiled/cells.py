"""Terms while a search runs: variables are cells that are written and, on the way back, wiped.

A cell is a Python list ``[value, stamp]`` (a list is never a term, so its type tells it apart). The stamp is the serial
number of the newest choice point when the cell was made: a younger choice point must wipe it, so its binding is noted
on the trail; a binding of a cell younger than every choice point is not, and can be collected as soon as it is unused.
A compound term built here is a plain tuple; a `Compound` is known to have no cell in it.
"""

from __future__ import annotations

import sys
from collections.abc import Hashable, Iterable
from itertools import count
from typing import Any, TypeAlias

from casper.kb.terms.terms import Compound, Rigid, Term, Variable
from casper.kb.terms.values.effort import SMALL, charge
from casper.kb.terms.values.sizes import check_size

Cell: TypeAlias = list[Any]
MANY = 1 << 16  # compound parts from which it is looked at how many there are: shared ones double with every level
_LITTLE = 2  # parts along last arguments that are not charged for; most of a large term lies on longer ways
UNBOUND: Any = type("Unbound", (), {"__slots__": (), "__repr__": lambda _: "unbound"})()
NO_TERM: Any = type("NoTerm", (), {"__slots__": (), "__eq__": lambda a, b: False, "__hash__": lambda _: 0})()
serials = count(1)  # shared by all searches: one may hand its variables to another, through valid/1
_STRUCTURE, _ITEM, _HOLE = object(), object(), object()
_CONSTANTS = frozenset((str, int, float))
_NOT_GROUND = frozenset((Variable, Rigid, tuple))  # types of what is not ground in a term that is frozen


class Trail(list[Cell]):
    """Cells in the order in which they were bound."""

    __slots__ = ()


def fresh_variable() -> Variable:
    """A variable that occurs nowhere else."""
    return Variable("_G", next(serials))


def open_cell() -> Cell:
    """An unbound cell as old as the search: every choice point wipes what it is bound to."""
    return [UNBOUND, 0]


def deref(term: Any) -> Any:
    """What a term stands for: a value, or the unbound cell at the end of a chain."""
    while type(term) is list:
        value = term[0]
        if value is UNBOUND:
            return term
        term = value
    return term


def undo(trail: Trail, mark: int) -> None:
    """Wipe what was bound since the trail was ``mark`` long."""
    for cell in trail[mark:]:
        cell[0] = UNBOUND
    del trail[mark:]


def freeze(term: Any, holes: dict[int, Variable], kind: type[tuple[Term, ...]] = tuple) -> Term:
    """The term as it is now, without cells: a `Compound` where it is ground, else a plain tuple with variables.

    ``holes`` names the unbound cells, by identity; those it does not know yet are given fresh variables. With
    `Compound` as ``kind`` every compound is one: that is how the rest of the system knows terms.

    Raises:
        BudgetExceeded: it has too many parts; a part that is shared counts as often as it occurs.
    """
    term = deref(term)
    if type(term) is tuple:
        room = _Room()
        try:
            frozen = _frozen(term, holes, kind, room)
        except _Full:
            return _frozen_once(term, holes, kind)
        if room.left < MANY - SMALL:
            charge(MANY - room.left)
        return frozen
    return _hole(term, holes) if type(term) is list else term


def _frozen(term: Any, holes: dict[int, Variable], kind: type[tuple[Term, ...]], room: _Room) -> Term:
    """As `freeze`, of a compound term with cells that is part of one; ``room`` is for the parts of that one."""
    spine: list[list[Any]] = []  # the last argument is followed in a loop: a list is as deep as it is long
    while type(term) is tuple:
        parts = list(term)
        term = deref(parts.pop())
        for at, part in enumerate(parts):
            if type(part) is list:
                part = deref(part)
                parts[at] = _hole(part, holes) if type(part) is list else part
            if type(part) is tuple:
                parts[at] = _frozen(part, holes, kind, room)
        spine.append(parts)
    room.left -= len(spine)
    if room.left < 0:
        raise _Full
    if type(term) is list:
        term = _hole(term, holes)
    for parts in reversed(spine):
        parts.append(term)
        if kind is Compound:
            term = Compound(parts)
            continue
        for part in parts:
            if type(part) in _NOT_GROUND:
                term = tuple(parts)
                break
        else:
            term = Compound(parts)
    return term


def _frozen_once(term: Any, holes: dict[int, Variable], kind: type[tuple[Term, ...]]) -> Term:
    """As `_frozen`, of a term with many parts: what is shared is copied once, and shared in the copy."""
    check_size([term])
    known: dict[int, Term] = {}
    waiting = [term]
    while waiting:
        whole = waiting[-1]
        parts = [deref(part) for part in whole]
        inner = [part for part in parts if type(part) is tuple and id(part) not in known]
        if inner and id(whole) not in known:
            waiting.extend(inner)
            continue
        waiting.pop()
        if id(whole) not in known:
            parts = [known[id(p)] if type(p) is tuple else _hole(p, holes) if type(p) is list else p for p in parts]
            is_open = kind is not Compound and any(type(part) in _NOT_GROUND for part in parts)
            known[id(whole)] = tuple(parts) if is_open else Compound(parts)
    charge(len(known))
    return known[id(term)]


def _hole(cell: Cell, holes: dict[int, Variable]) -> Variable:
    """What an unbound cell is called."""
    found = holes.get(id(cell))
    if found is None:
        found = holes[id(cell)] = fresh_variable()
    return found


class _Room:
    """How many parts of a term may be copied before it is looked at which of them are shared."""

    __slots__ = ("left",)

    def __init__(self) -> None:
        self.left = MANY


class _Full(Exception):
    """There are more parts than that."""


def frozen_is_ground(term: Term) -> bool:
    """Whether a term that `freeze` gave has no variable."""
    return type(term) not in _NOT_GROUND


def has_rigid(term: Term) -> bool:
    """Whether a term that `freeze` gave has a rigid variable."""
    waiting = [term]
    while waiting:
        term = waiting.pop()
        if type(term) is Rigid:
            return True
        if type(term) is tuple:
            waiting.extend(term)
    return False


def rigid(term: Term) -> Term:
    """A term of the rest of the system as the machine takes it, all its variables rigid."""
    if isinstance(term, Variable):
        return Rigid(term.name, term.serial)
    if not isinstance(term, tuple):
        return term
    parts = [rigid(part) for part in term]
    return tuple(parts) if any(type(part) in _NOT_GROUND for part in parts) else Compound(parts)


def thaw(term: Term, cells: dict[Variable, Cell], stamp: int = 0) -> Any:
    """A frozen term with its variables as cells; ``cells`` says which, and learns of new ones."""
    spine: list[list[Any]] = []
    while type(term) is tuple:  # a Compound is ground
        spine.append([thaw(p, cells, stamp) if type(p) is tuple or type(p) is Variable else p for p in term[:-1]])
        term = term[-1]
    if len(spine) > _LITTLE:
        charge(len(spine))
    value: Any = _cell(term, cells, stamp) if type(term) is Variable else term
    for parts in reversed(spine):
        parts.append(value)
        value = tuple(parts)
    return value


def inward(term: Term, cells: dict[Variable, Cell], stamp: int = 0) -> Any:
    """A term of the rest of the system with its variables as cells: there, a `Compound` may have variables."""
    spine: list[tuple[Term, ...]] = []
    while isinstance(term, tuple):
        spine.append(term)
        term = term[-1]
    if len(spine) > _LITTLE:
        charge(len(spine))
    value: Any = NO_TERM if type(term) is list else term
    if type(term) is Variable:
        value = _cell(term, cells, stamp)
    for whole in reversed(spine):
        parts = [inward(p, cells, stamp) if isinstance(p, (tuple, Variable, list)) else p for p in whole[:-1]]
        parts.append(value)
        open_ = any(type(part) is list or type(part) is tuple for part in parts)
        value = tuple(parts) if open_ else whole if type(whole) is Compound else Compound(parts)
    return value


def _cell(variable: Variable, cells: dict[Variable, Cell], stamp: int) -> Cell:
    found = cells.get(variable)
    if found is None:
        found = cells[variable] = [UNBOUND, stamp]
    return found


def variant(terms: Iterable[Term]) -> Hashable:
    """A flat key that two rows of frozen terms share exactly when they differ in their variables' names only.

    It is flat, or nearly so, because Python compares nested tuples by recursion, and a list is as deep as it is long.

    Raises:
        BudgetExceeded: the terms have too many parts to be told apart.
    """
    row = tuple(terms)
    for term in row:
        if not _CONSTANTS.issuperset(map(type, term)) if isinstance(term, tuple) else isinstance(term, Variable):
            break
    else:
        return row  # nothing in it is nested further
    key: list[Any] = []
    unchecked = MANY
    numbers: dict[Variable, int] = {}
    waiting: list[Any] = list(reversed(row))
    while waiting:
        term = waiting.pop()
        if isinstance(term, tuple):
            while isinstance(term, tuple) and len(term) == 3 and term[0] == "." and type(term[1]) in _CONSTANTS:
                key += (_ITEM, term[1])  # a list of constants, without a way over the stack
                term = term[2]
            if isinstance(term, tuple):
                key += (_STRUCTURE, len(term))
                waiting.extend(reversed(term))
                if len(key) > unchecked:
                    check_size(row)
                    unchecked = sys.maxsize
            else:
                waiting.append(term)
        elif type(term) is Variable:
            key += (_HOLE, numbers.setdefault(term, len(numbers)))
        else:
            key.append(term)
    if len(key) > SMALL:
        charge(len(key))
    return tuple(key)
