"""Terms while a search runs: variables are cells that are written and, on the way back, wiped.

A cell is a Python list ``[value, stamp]`` (a list is never a term, so its type tells it apart). The stamp is the serial
number of the newest choice point when the cell was made: a younger choice point must wipe it, so its binding is noted
on the trail; a binding of a cell younger than every choice point is not, and can be collected as soon as it is unused.
A compound term built here is a plain tuple; a `Compound` is known to have no cell in it.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from itertools import count
from typing import Any, TypeAlias

from casper.kb.terms.terms import Compound, Rigid, Term, Variable

Cell: TypeAlias = list[Any]
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


def unify(left: Any, right: Any, trail: Trail, top: int) -> bool:
    """Make two terms equal by binding cells; False when they cannot be (what was bound by then is on the trail).

    Args:
        left, right: terms with cells.
        trail: where bindings of cells that are older than ``top`` are noted.
        top: serial of the newest choice point.
    """
    waiting: list[tuple[Any, Any]] = []
    while True:
        left, right = deref(left), deref(right)
        if left is not right:
            if type(left) is not list and type(right) is list:
                left, right = right, left
            if type(left) is list:
                if type(right) is tuple and occurs(left, right, trail):
                    return False
                left[0] = right
                if left[1] < top:
                    trail.append(left)
            elif isinstance(left, tuple):
                if not isinstance(right, tuple) or len(left) != len(right):
                    return False
                if left[0] != right[0] and type(left[0]) is not list and type(right[0]) is not list:
                    return False
                waiting.extend(zip(left[:0:-1], right[:0:-1]))
            elif isinstance(right, tuple) or left != right:
                return False
        if not waiting:
            return True
        left, right = waiting.pop()


def occurs(cell: Cell, term: tuple[Any, ...], trail: Trail) -> bool:
    """Whether an unbound cell is somewhere in a compound term; looking at a large one is charged for."""
    waiting: list[Any] = [term]
    seen = 0
    while waiting:
        seen += 1
        if seen % 64 == 0:
            trail.toil += 1
        for part in waiting.pop():
            part = deref(part)
            if part is cell:
                return True
            if type(part) is tuple:
                waiting.append(part)
    return False


def freeze(term: Any, holes: dict[int, Variable], kind: type[tuple[Term, ...]] = tuple) -> Term:
    """The term as it is now, without cells: a `Compound` where it is ground, else a plain tuple with variables.

    ``holes`` names the unbound cells, by identity; those it does not know yet are given fresh variables. With
    `Compound` as ``kind`` every compound is one: that is how the rest of the system knows terms.
    """
    spine: list[list[Any]] = []  # the last argument is followed in a loop: a list is as deep as it is long
    term = deref(term)
    while type(term) is tuple:
        parts = list(term)
        term = deref(parts.pop())
        for at, part in enumerate(parts):
            if type(part) is list or type(part) is tuple:
                parts[at] = freeze(part, holes, kind)
        spine.append(parts)
    if type(term) is list:
        found = holes.get(id(term))
        if found is None:
            found = holes[id(term)] = fresh_variable()
        term = found
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
    """
    row = tuple(terms)
    for term in row:
        if isinstance(term, (tuple, Variable)):
            break
    else:
        return row
    key: list[Any] = []
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
            else:
                waiting.append(term)
        elif type(term) is Variable:
            key += (_HOLE, numbers.setdefault(term, len(numbers)))
        else:
            key.append(term)
    return tuple(key)
