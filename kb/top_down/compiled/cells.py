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

from casper.kb.errors import BudgetExceeded
from casper.kb.terms.terms import Compound, Rigid, Term, Variable

Cell: TypeAlias = list[Any]
MOST_PARTS = 1 << 22  # compound parts of a term that is copied: some 400 MB
MANY = 1 << 16  # compound parts from which it is looked at how many there are: shared ones double with every level
UNBOUND: Any = type("Unbound", (), {"__slots__": (), "__repr__": lambda _: "unbound"})()
NO_TERM: Any = type("NoTerm", (), {"__slots__": (), "__eq__": lambda a, b: False, "__hash__": lambda _: 0})()
serials = count(1)  # shared by all searches: one may hand its variables to another, through valid/1
_STRUCTURE, _ITEM, _HOLE = object(), object(), object()
_CONSTANTS = frozenset((str, int, float))
_NOT_GROUND = frozenset((Variable, Rigid, tuple))  # types of what is not ground in a term that is frozen


class Trail(list[Cell]):
    """Cells in the order in which they were bound; ``toil`` counts work on large terms, in steps."""

    __slots__ = ("toil",)

    def __init__(self) -> None:
        super().__init__()
        self.toil = 0


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
        BudgetExceeded: it has too many parts; as it is copied, a part that is shared counts as often as it occurs.
    """
    term = deref(term)
    if type(term) is tuple:
        return _frozen(term, holes, kind, _Room(term))
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
        room.enlarge()
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


def _hole(cell: Cell, holes: dict[int, Variable]) -> Variable:
    """What an unbound cell is called."""
    found = holes.get(id(cell))
    if found is None:
        found = holes[id(cell)] = fresh_variable()
    return found


class _Room:
    """How many parts of a term may be copied before it is looked at whether that will ever end."""

    __slots__ = ("left", "term")

    def __init__(self, term: Any) -> None:
        self.left, self.term = MANY, term

    def enlarge(self) -> None:
        """Go on where the whole term is not too large."""
        check_size([self.term])
        self.left = MOST_PARTS


def check_size(terms: Iterable[Any]) -> None:
    """Refuse terms that would be too large as trees, in the time that their parts take when each is looked at once.

    Raises:
        BudgetExceeded: one has more than ``MOST_PARTS`` compound parts, each counted as often as it occurs.
    """
    sizes: dict[int, int] = {}
    waiting = [term for term in map(deref, terms) if isinstance(term, tuple)]
    while waiting:
        term = waiting[-1]
        parts = [part for part in map(deref, term) if isinstance(part, tuple)]
        inner = [part for part in parts if id(part) not in sizes]
        if inner and id(term) not in sizes:
            waiting.extend(inner)
            continue
        waiting.pop()
        sizes[id(term)] = size = 1 + sum(sizes[id(part)] for part in parts)
        if size > MOST_PARTS:
            raise BudgetExceeded(f"the search met a term of more than {MOST_PARTS:,} parts: the answer is unknown")


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

    It is flat because Python compares nested tuples by recursion, and a list is as deep as it is long.

    Raises:
        BudgetExceeded: the terms have too many parts to be told apart.
    """
    row = tuple(terms)
    for term in row:
        if isinstance(term, (tuple, Variable)):
            break
    else:
        return row
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
    return tuple(key)
