"""Unification: what makes two terms equal, and what a term is once its variables are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

from casper.kb.terms.terms import Compound, Term, Variable

Bindings: TypeAlias = dict["Variable", Term]  # a triangular substitution


def variables_of(*terms: Term) -> Iterator[Variable]:
    """Every variable of the terms, in order of first occurrence."""
    seen: set[Variable] = set()
    stack = list(reversed(terms))
    while stack:
        term = stack.pop()
        if isinstance(term, Variable):
            if term not in seen:
                seen.add(term)
                yield term
        elif isinstance(term, tuple):
            stack.extend(reversed(term))


def is_ground(term: Term) -> bool:
    """Whether the term has no variable."""
    if not isinstance(term, tuple):
        return not isinstance(term, Variable)
    waiting = list(term)  # a loop, not recursion: a list is as deep as it is long
    while waiting:
        part = waiting.pop()
        if isinstance(part, Variable):
            return False
        if isinstance(part, tuple):
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
    spine = []  # the last argument is followed in a loop: a list is as deep as it is long
    while isinstance(term, Compound):
        spine.append([part if type(part) is str else substitute(part, bindings) for part in term[:-1]])
        term = walk(term[-1], bindings)
    for parts in reversed(spine):
        term = Compound([*parts, term])
    return term


def unify(left: Term, right: Term, bindings: Bindings) -> Bindings | None:
    """The most general extension of the bindings that makes both terms equal, or None.

    The bindings handed in are never changed. Numbers are equal by value, ``1`` and ``1.0`` too, as in kanren and in the
    indexes. A variable never becomes a term that contains it (the occurs check), so every answer is a finite term.
    """
    extended, waiting = bindings, [(left, right)]
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
            waiting.extend(reversed(list(zip(left, right))))
        elif isinstance(left, tuple) or isinstance(right, tuple) or left != right:
            return None
    return extended


def _occurs(variable: Variable, term: Term, bindings: Bindings) -> bool:
    if not isinstance(term, tuple):
        return False
    waiting = list(term)
    while waiting:
        part = walk(waiting.pop(), bindings)
        if part is variable or part == variable:
            return True
        if isinstance(part, tuple):
            waiting.extend(part)
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
