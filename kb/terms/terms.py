"""Terms: what a knowledge base speaks of.

An atom is a ``str`` (ISO Prolog read with ``double_quotes = atom``: ``"a b"`` and ``'a b'`` are one atom), a number an
``int`` or ``float``, a variable a `Variable`, a compound term a `Compound`: a tuple whose first element is the functor,
so that kanren unifies it like any tuple. A Prolog list is made of ``.``/2 cells that end in the atom ``[]``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.kb.terms.atoms import NIL as NIL
from casper.kb.terms.syntax import term_text

Term: TypeAlias = Any  # str | int | float | Variable | Compound, and anything hashable that Python code brings along


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

    def __str__(self) -> str:
        return "_" if self.is_anonymous else repr(self)


class Rigid(Variable):
    """A variable that stands for every value at once: what a search says with it must hold whatever it is.

    It is never bound, and what has one in it is not decided before it is known.
    """

    __slots__ = ()


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

    def __reduce__(self) -> tuple[object, ...]:
        """The chain of last arguments laid flat: a list is as deep as it is long, and pickle's stack is not."""
        chain: list[tuple[Term, ...]] = []
        term: Term = self
        while isinstance(term, Compound) and term:
            chain.append(tuple(term[:-1]))
            term = term[-1]
        return (_of_chain, (chain, term)) if self else (Compound, ())

    def __repr__(self) -> str:
        return term_text(self)


def _of_chain(chain: list[tuple[Term, ...]], last: Term) -> Term:
    """The compound whose last arguments are the rest of the chain."""
    for parts in reversed(chain):
        last = Compound((*parts, last))
    return last


_FLAT = frozenset((str, int, float))  # types of parts that stay as they are


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
    if _FLAT.issuperset(map(type, term)):
        return Compound(term)
    return Compound(
        [_as_compound(part) if isinstance(part, tuple) and not isinstance(part, Compound) else part for part in term]
    )


def as_term(atom: Compound) -> Term:
    """The inverse of `predication`: a compound without arguments is the plain atom."""
    return atom if len(atom) > 1 else atom[0]


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
