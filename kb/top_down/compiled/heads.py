"""How a clause's head is matched with the arguments of a call: one closure for each argument that asks something.

A closure reads where the argument is known, and writes (builds the term, binds the cell) where it is open.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import is_ground
from casper.kb.top_down.compiled.cells import UNBOUND, Trail, deref
from casper.kb.top_down.compiled.unifying import occurs, unify

_DEEP = 20
Frame: TypeAlias = list[Any]
Read: TypeAlias = Callable[[Any, Frame, Trail, int], bool]
Write: TypeAlias = Callable[[Frame], Any]
Matcher: TypeAlias = tuple[int, Read]  # the slot of an argument, and what it must agree with


def matchers(args: Sequence[Term], slots: dict[Variable, int], set_: set[Variable]) -> tuple[Matcher, ...]:
    """Closures over a frame whose slots 1, 2 … hold the arguments.

    Args:
        args: the head's arguments.
        slots: where each variable lives.
        set_: variables whose slot is an argument's; those met inside terms are added.
    """
    found: list[Matcher] = []
    known = set(set_)
    for at, arg in enumerate(args, 1):
        if isinstance(arg, Variable):
            if slots[arg] != at:
                found.append((at, _same(slots[arg])))
        elif not isinstance(arg, Compound):
            found.append((at, _constant(arg)))
    for at, arg in enumerate(args, 1):  # terms last: constants fail faster
        if isinstance(arg, Compound):
            found.append((at, _reader(arg, slots, known)[0]))
    return tuple(found)


def _same(other: int) -> Read:
    return lambda value, frame, trail, top: unify(value, frame[other], trail, top)


def _constant(constant: Term) -> Read:
    def read(value: Any, frame: Frame, trail: Trail, top: int) -> bool:
        while type(value) is list:
            below = value[0]
            if below is UNBOUND:
                value[0] = constant
                if value[1] < top:
                    trail.append(value)
                return True
            value = below
        return bool(value == constant)

    return read


def _reader(term: Term, slots: dict[Variable, int], known: set[Variable]) -> tuple[Read, Write]:
    """How a part of a head, no variable met for the first time, is matched with a value, and how it is built."""
    if isinstance(term, Variable):
        slot = slots[term]
        return (lambda value, frame, trail, top: unify(frame[slot], value, trail, top)), (lambda frame: frame[slot])
    if not isinstance(term, Compound):
        return _constant(term), (lambda frame: term)
    if is_ground(term):
        return (lambda value, frame, trail, top: unify(term, value, trail, top)), (lambda frame: term)
    if is_deep(term):
        return _deep(term, slots, known)
    return _structure(term, slots, known)


def is_deep(term: Term) -> bool:
    """Whether a term is nested further than closures within closures should be."""
    for _ in range(_DEEP):
        if not isinstance(term, Compound):
            return False
        term = term[-1]
    return True


def instance(term: Term, slots: dict[Variable, int], frame: Frame) -> Any:
    """A term with its variables as a frame has them; a loop along last arguments, as deep as a list is long."""
    spine: list[list[Any]] = []
    while isinstance(term, Compound):
        spine.append([instance(p, slots, frame) if isinstance(p, (Compound, Variable)) else p for p in term[:-1]])
        term = term[-1]
    value: Any = frame[slots[term]] if isinstance(term, Variable) else term
    for parts in reversed(spine):
        parts.append(value)
        value = tuple(parts)
    return value


def _deep(term: Compound, slots: dict[Variable, int], known: set[Variable]) -> tuple[Read, Write]:
    new = tuple(slots[v] for v in dict.fromkeys(_variables(term)) if v not in known)
    known.update(_variables(term))

    def write(frame: Frame) -> Any:
        for slot in new:
            frame[slot] = [UNBOUND, frame[0]]
        return instance(term, slots, frame)

    return (lambda value, frame, trail, top: unify(write(frame), value, trail, top)), write


def _opener(slot: int) -> Write:
    def write(frame: Frame) -> Any:
        cell = frame[slot] = [UNBOUND, frame[0]]
        return cell

    return write


def _structure(term: Compound, slots: dict[Variable, int], known: set[Variable]) -> tuple[Read, Write]:
    name, size = term[0], len(term)
    firsts: list[tuple[int, int]] = []  # parts that are variables met for the first time: position and slot
    others: list[tuple[int, Read]] = []
    writes: list[Write] = []
    risky = [slots[v] for v in dict.fromkeys(_variables(term)) if v in known]  # could hold the cell that is bound
    for at, part in enumerate(term.args, 1):
        if isinstance(part, Variable) and part not in known:
            known.add(part)
            firsts.append((at, slots[part]))
            writes.append(_opener(slots[part]))
        else:
            read, write = _reader(part, slots, known)
            others.append((at, read))
            writes.append(write)
    build = _pair(term, [slots[v] for v in term.args], firsts) if _is_pair(term) else _built(name, writes)
    set_, check, may_hold = tuple(firsts), tuple(others), tuple(risky)

    def match(value: Any, frame: Frame, trail: Trail, top: int) -> bool:
        while type(value) is list:
            below = value[0]
            if below is UNBOUND:
                for slot in may_hold:
                    held = deref(frame[slot])
                    if held is value or (type(held) is tuple and occurs(value, held)):
                        return False
                value[0] = build(frame)
                if value[1] < top:
                    trail.append(value)
                return True
            value = below
        if not isinstance(value, tuple) or len(value) != size or value[0] != name:
            return False
        for at, slot in set_:
            frame[slot] = value[at]
        return all(read(value[at], frame, trail, top) for at, read in check) if check else True

    return match, build


def _is_pair(term: Compound) -> bool:
    return len(term) == 3 and all(isinstance(part, Variable) for part in term.args) and term[1] != term[2]


def _pair(term: Compound, at: Sequence[int], firsts: Sequence[tuple[int, int]]) -> Write:
    """How a term of two different variables is built: a list's cell, most often."""
    name, (left, right) = term[0], at
    new = tuple(slot for _, slot in firsts)
    if new == (right,):

        def append(frame: Frame) -> Any:
            cell = frame[right] = [UNBOUND, frame[0]]
            return name, frame[left], cell

        return append

    def build(frame: Frame) -> Any:
        for slot in new:
            frame[slot] = [UNBOUND, frame[0]]
        return name, frame[left], frame[right]

    return build


def _built(name: Term, writes: Sequence[Write]) -> Write:
    if len(writes) == 2:
        left, right = writes
        return lambda frame: (name, left(frame), right(frame))
    return lambda frame: (name, *[write(frame) for write in writes])


def _variables(term: Compound) -> list[Variable]:
    found: list[Variable] = []
    waiting: list[Any] = [term]
    while waiting:
        for part in waiting.pop():
            if isinstance(part, Variable):
                found.append(part)
            elif isinstance(part, tuple):
                waiting.append(part)
    return found
