"""Terms: what a knowledge base speaks of, and unification between them.

An atom is a ``str`` (ISO Prolog read with ``double_quotes = atom``: ``"a b"`` and ``'a b'`` are one atom), a number an
``int`` or ``float``, a variable a `Variable`, a compound term a `Compound`: a tuple whose first element is the functor,
so that kanren unifies it like any tuple. A Prolog list is made of ``.``/2 cells that end in the atom ``[]``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

Term: TypeAlias = Any  # str | int | float | Variable | Compound, and anything hashable that Python code brings along
Bindings: TypeAlias = dict["Variable", Term]  # a triangular substitution


@dataclass(frozen=True, slots=True)
class Variable:
    """A logic variable of a clause or a query; ``serial`` tells the renamed copies of one clause apart."""

    name: str
    serial: int = 0

    @property
    def is_anonymous(self) -> bool:
        """Whether it was written ``_``: it occurs once, so nothing else can ever bind it."""
        return self.name.startswith("_#")

    def __hash__(self) -> int:
        return hash(self.name) ^ self.serial

    def __repr__(self) -> str:
        return self.name if self.serial == 0 else f"{self.name}_{self.serial}"


class Compound(tuple[Term, ...]):
    """A functor with its arguments, as one tuple: ``Compound(("eat", "human", "biscuits", "plate"))``."""

    __slots__ = ()

    @property
    def functor(self) -> str:
        """The name in front of the brackets."""
        return str(self[0])

    @property
    def args(self) -> tuple[Term, ...]:
        """What stands between the brackets."""
        return tuple(self[1:])

    @property
    def arity(self) -> int:
        """How many arguments there are."""
        return len(self) - 1

    @property
    def indicator(self) -> tuple[str, int]:
        """Name and arity: the key under which a predicate is known."""
        return str(self[0]), len(self) - 1

    def __repr__(self) -> str:
        from casper.kb.writer import term_text

        return term_text(self)


def predication(term: Term) -> Compound:
    """The term as something that can be true: an atom becomes a compound without arguments.

    Raises:
        TypeError: a number or a variable is not a statement.
    """
    if isinstance(term, Compound):
        return term
    if isinstance(term, str):
        return Compound((term,))
    if isinstance(term, tuple) and term and isinstance(term[0], str):
        return _as_compound(term)
    raise TypeError(f"{term!r} is not a statement: an atom or name(arguments) is needed")


def _as_compound(term: tuple[Term, ...]) -> Compound:
    """A Python tuple as a compound, to the bottom."""
    return Compound(
        [_as_compound(part) if isinstance(part, tuple) and not isinstance(part, Compound) else part for part in term]
    )


def as_term(atom: Compound) -> Term:
    """The inverse of `predication`: a compound without arguments is the plain atom."""
    return atom if len(atom) > 1 else atom[0]


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
    while isinstance(term, Variable):
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
        spine.append([substitute(part, bindings) for part in term[:-1]])
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


NIL = "[]"


def make_list(items: Iterable[Term], tail: Term = NIL) -> Term:
    """The Prolog list of the items."""
    result = tail
    for item in reversed(list(items)):
        result = Compound((".", item, result))
    return result


def list_items(term: Term) -> tuple[list[Term], Term]:
    """The items of a list and its tail (the atom ``[]`` for a proper list)."""
    items = []
    while isinstance(term, Compound) and term.indicator == (".", 2):
        items.append(term[1])
        term = term[2]
    return items, term
