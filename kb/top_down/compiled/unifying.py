"""Unification of terms with cells, and the occurs check; where there are many parts, a shared one is looked at once."""

from __future__ import annotations

from typing import Any

from casper.kb.terms.terms import Rigid, Variable
from casper.kb.terms.values.effort import SMALL, charge
from casper.kb.top_down.compiled.cells import MANY, Cell, Trail, deref


def unify(left: Any, right: Any, trail: Trail, top: int) -> bool:
    """Make two terms equal by binding cells; False when they cannot be (what was bound by then is on the trail).

    Args:
        left, right: terms with cells.
        trail: where bindings of cells that are older than ``top`` are noted.
        top: serial of the newest choice point.
    """
    waiting: list[tuple[Any, Any]] = []
    met: set[tuple[int, int]] = set()  # pairs that are equal already, or wait to be made so
    count = 0
    while True:
        left, right = deref(left), deref(right)
        if left is not right:
            if type(left) is not list and type(right) is list:
                left, right = right, left
            if type(left) is list:
                if type(right) is tuple and occurs(left, right):
                    return False
                left[0] = right
                if left[1] < top:
                    trail.append(left)
            elif isinstance(left, tuple):
                if not isinstance(right, tuple) or len(left) != len(right):
                    return False
                if left[0] != right[0] and type(left[0]) is not list and type(right[0]) is not list:
                    return False
                count += 1
                if count % SMALL == 0:
                    charge(SMALL)
                if count < MANY or _is_new((id(left), id(right)), met):
                    waiting.extend(zip(left[:0:-1], right[:0:-1]))
            elif isinstance(right, tuple) or left != right:
                return False
        if not waiting:
            return True
        left, right = waiting.pop()


def occurs(cell: Cell, term: tuple[Any, ...]) -> bool:
    """Whether an unbound cell is somewhere in a compound term; looking at a large one is charged for."""
    waiting: list[Any] = [term]
    met: set[int] = set()
    seen = 0
    while waiting:
        seen += 1
        if seen % SMALL == 0:
            charge(SMALL)
        for part in waiting.pop():
            part = deref(part)
            if part is cell:
                return True
            if type(part) is tuple and (seen < MANY or _is_new(id(part), met)):
                waiting.append(part)
    return False


def is_ground(term: Any) -> bool:
    """Whether a term has no open cell now, and nothing rigid; nothing is copied."""
    term = deref(term)
    if type(term) is not tuple:
        return type(term) is not list and type(term) is not Rigid
    waiting: list[Any] = [term]
    met: set[int] = set()
    seen = 0
    while waiting:
        seen += 1
        if seen % SMALL == 0:
            charge(SMALL)
        for part in waiting.pop():
            part = deref(part)
            if type(part) is tuple:
                if seen < MANY or _is_new(id(part), met):
                    waiting.append(part)
            elif type(part) is list or type(part) is Rigid or type(part) is Variable:
                return False
    return True


def _is_new(key: Any, met: set[Any]) -> bool:
    if key in met:
        return False
    met.add(key)
    return True
