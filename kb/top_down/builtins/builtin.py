"""What a built-in predicate is to the machine: when it can be decided, and the values its arguments then have."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.kb.errors import Undefined
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Rigid
from casper.kb.terms.values.effort import SMALL, charge
from casper.kb.top_down.compiled.cells import deref, freeze
from casper.kb.top_down.compiled.unifying import is_ground as nothing_open

Values: TypeAlias = tuple[Any, ...]  # one for each argument; None says nothing about it
Outcome: TypeAlias = "Values | Iterator[Values] | None"


@dataclass(frozen=True, slots=True)
class Builtin:
    """A predicate that a function computes.

    Args:
        run: from the arguments (walked) to the values of one answer, of many, or None where there is none. Values
            of many answers have no cells, but may have variables. It raises `Undefined` where an argument is of a
            kind that it has no meaning for.
        ready: whether the arguments are known enough; until they are, the condition waits.
    """

    run: Callable[..., Outcome]
    ready: Callable[..., bool]


def always(*_: Any) -> bool:
    """Ready whatever is known."""
    return True


def is_known(term: Any) -> bool:
    """Whether a walked term is more than an open variable."""
    return type(term) is not list and type(term) is not Rigid


def is_ground(term: Any) -> bool:
    """Whether nothing in a walked term is open."""
    return nothing_open(term)


def walked_list(term: Any) -> tuple[list[Any], Any]:
    """The items of a list as they are, and what it ends in: ``[]`` for a proper one."""
    items: list[Any] = []
    term = deref(term)
    while isinstance(term, tuple) and len(term) == 3 and term[0] == ".":
        items.append(term[1])
        term = deref(term[2])
    if len(items) > SMALL:
        charge(len(items))
    return items, term


def has_end(term: Any) -> bool:
    """Whether a term is a list, or certainly none."""
    return is_known(walked_list(term)[1])


def shown(term: Any) -> str:
    """A walked term as text."""
    return term_text(freeze(term, {}, Compound))


def no_meaning(name: str, wanted: str, term: Any) -> Undefined:
    """That an argument is of the wrong kind, so that the condition is neither true nor false."""
    return Undefined(f"{name} needs {wanted}, not {shown(term)}")


def proper_items(name: str, term: Any) -> list[Any]:
    """The items of a proper list.

    Raises:
        Undefined: it is none.
    """
    items, end = walked_list(term)
    if end != "[]":
        raise no_meaning(name, "a list", term)
    return items
