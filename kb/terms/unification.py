"""Unification: what makes two terms equal, and what a term is once its variables are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

from casper.kb.terms.terms import Compound, Term, Variable

Bindings: TypeAlias = dict["Variable", Term]  # a triangular substitution
MANY = 1 << 12  # compound parts from which each is looked at once: as trees, shared ones double with every level


def _is_new(key: object, met: set[Any]) -> bool:
    if key in met:
        return False
    met.add(key)
    return True


def variables_of(*terms: Term) -> Iterator[Variable]:
    """Every variable of the terms, in order of first occurrence."""
    seen: set[Variable] = set()
    met: set[int] = set()
    count = 0
    stack = list(reversed(terms))
    while stack:
        term = stack.pop()
        if isinstance(term, Variable):
            if term not in seen:
                seen.add(term)
                yield term
        elif isinstance(term, tuple):
            count += 1
            if count < MANY or _is_new(id(term), met):
                stack.extend(reversed(term))


def is_ground(term: Term) -> bool:
    """Whether the term has no variable."""
    if not isinstance(term, tuple):
        return not isinstance(term, Variable)
    waiting = list(term)  # a loop, not recursion: a list is as deep as it is long
    met: set[int] = set()
    count = 0
    while waiting:
        part = waiting.pop()
        if isinstance(part, Variable):
            return False
        if isinstance(part, tuple):
            count += 1
            if count < MANY or _is_new(id(part), met):
                waiting.extend(part)
    return True


def walk(term: Term, bindings: Bindings) -> Term:
    """What the term stands for: follow a variable to its value or to an unbound variable."""
    while type(term) is Variable:
        value = bindings.get(term, term)
        if value is term:
            return term
        term = value
    return term


def substitute(term: Term, bindings: Bindings) -> Term:
    """The term with every bound variable replaced, to the bottom."""
    term = walk(term, bindings)
    if not isinstance(term, Compound):
        return term
    try:
        return _substituted(term, bindings, [MANY])
    except _TooMany:
        return _substituted_once(term, bindings)


class _TooMany(Exception):
    """A term has so many parts that it is to be seen which of them are shared."""


def _substituted(term: Term, bindings: Bindings, left: list[int]) -> Term:
    spine = []  # the last argument is followed in a loop: a list is as deep as it is long
    while isinstance(term, Compound):
        parts = list(term)
        last = parts.pop()
        for at, part in enumerate(parts):
            if type(part) is not str:
                part = walk(part, bindings)
                parts[at] = _substituted(part, bindings, left) if isinstance(part, Compound) else part
        spine.append(parts)
        term = walk(last, bindings)
    left[0] -= len(spine)
    if left[0] < 0:
        raise _TooMany
    for parts in reversed(spine):
        term = Compound([*parts, term])
    return term


def _substituted_once(term: Compound, bindings: Bindings) -> Term:
    """As `substitute`, of a term with many parts: what is shared stays shared."""
    known: dict[int, Term] = {}
    waiting = [term]
    while waiting:
        whole = waiting[-1]
        parts = [walk(part, bindings) for part in whole]
        inner = [part for part in parts if isinstance(part, Compound) and id(part) not in known]
        if inner and id(whole) not in known:
            waiting.extend(inner)
            continue
        waiting.pop()
        if id(whole) not in known:
            known[id(whole)] = Compound([known[id(p)] if isinstance(p, Compound) else p for p in parts])
    return known[id(term)]


def unify(left: Term, right: Term, bindings: Bindings) -> Bindings | None:
    """The most general extension of the bindings that makes both terms equal, or None.

    The bindings handed in are never changed. Numbers are equal by value, ``1`` and ``1.0`` too, as in kanren and in the
    indexes. A variable never becomes a term that contains it (the occurs check), so every answer is a finite term.
    """
    extended, waiting, count = bindings, [(left, right)], 0
    met: set[tuple[int, int]] = set()
    while waiting:
        left, right = waiting.pop()
        left, right = walk(left, extended), walk(right, extended)
        if left is right:
            continue
        if not isinstance(left, Variable) and isinstance(right, Variable):
            left, right = right, left
        if isinstance(left, Variable):
            if left == right:
                continue
            if _occurs(left, right, extended):
                return None
            if extended is bindings:
                extended = bindings.copy()
            extended[left] = right
        elif isinstance(left, tuple) and isinstance(right, tuple) and len(left) == len(right):
            count += 1
            if count < MANY or _is_new((id(left), id(right)), met):
                waiting.extend(reversed(list(zip(left, right))))
        elif isinstance(left, tuple) or isinstance(right, tuple) or left != right:
            return None
    return extended


def _occurs(variable: Variable, term: Term, bindings: Bindings) -> bool:
    if not isinstance(term, tuple):
        return False
    waiting, count = list(term), 0
    met: set[int] = set()
    while waiting:
        part = walk(waiting.pop(), bindings)
        if isinstance(part, tuple):
            count += 1
            if count < MANY or _is_new(id(part), met):
                waiting.extend(part)
        elif part is variable or part == variable:
            return True
    return False


def renamed(terms: Iterable[Term], serial: int) -> list[Term]:
    """The terms with every variable made fresh under the serial number."""
    return [_renamed(term, serial) for term in terms]


def _renamed(term: Term, serial: int) -> Term:
    if isinstance(term, Variable):
        return Variable(term.name, serial)
    if isinstance(term, Compound):
        return Compound([_renamed(part, serial) for part in term])
    return term
