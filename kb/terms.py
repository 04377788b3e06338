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
        return Compound(term)
    raise TypeError(f"{term!r} is not a statement: an atom or name(arguments) is needed")


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
    if isinstance(term, tuple):
        return all(is_ground(part) for part in term)
    return not isinstance(term, Variable)


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
    if isinstance(term, Compound):
        return Compound([substitute(part, bindings) for part in term])
    return term


def unify(left: Term, right: Term, bindings: Bindings) -> Bindings | None:
    """The most general extension of the bindings that makes both terms equal, or None.

    The bindings handed in are never changed. There is no occurs check, as in ISO Prolog's ``=``.
    """
    left, right = walk(left, bindings), walk(right, bindings)
    if left is right:
        return bindings
    if isinstance(left, Variable):
        return {**bindings, left: right}
    if isinstance(right, Variable):
        return {**bindings, right: left}
    if isinstance(left, tuple) and isinstance(right, tuple):
        if len(left) != len(right):
            return None
        extended: Bindings | None = bindings
        for a, b in zip(left, right):
            extended = unify(a, b, extended)  # type: ignore[arg-type]
            if extended is None:
                return None
        return extended
    return bindings if left == right and type(left) is type(right) else None


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
