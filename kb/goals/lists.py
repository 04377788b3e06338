"""kanren's goals about sequences, with the streams and the occurs check of this room.

The same relations with the same answers as kanren's; a list is as long as it likes, since every step back into itself
is a step of the scheduler and not of Python's stack.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

from cons import cons
from cons.core import ConsNull, ConsPair
from kanren import constraints, core
from kanren import goals as theirs
from unification import reify, var
from unification.core import isground

from casper.kb.goals.streams import Goal, Staged, State, conde, eq, lall

_neq: Callable[[Any, Any], Goal] = constraints.neq


def heado(head: Any, coll: Any) -> Goal:
    """``head`` is the first item."""
    return eq(cons(head, var()), coll)


def tailo(tail: Any, coll: Any) -> Goal:
    """``tail`` is what follows the first item."""
    return eq(cons(var(), tail), coll)


def conso(head: Any, tail: Any, coll: Any) -> Goal:
    """The collection is the head before the tail."""
    return eq(cons(head, tail), coll)


def _staged(step: Callable[..., Goal | None]) -> Callable[..., Goal]:
    """A goal constructor whose goal is made when the search comes to it: ``step`` gets the state before the rest."""

    @wraps(step)
    def make(*args: Any, **options: Any) -> Goal:
        return Staged(lambda state: step(state, *args, **options))

    return make


def nullo(*args: Any, refs: Any = None, default_ConsNull: type = list) -> Goal:
    """Every term is the empty sequence of one type: that of the terms and ``refs``, or else the default."""
    return _nullo(args, refs or (), default_ConsNull)


@_staged
def _nullo(state: State, args: tuple[Any, ...], refs: tuple[Any, ...], default: type) -> Goal | None:
    terms, others = reify(args, state), reify(refs, state)
    sequences = [a for a in (*terms, *others) if isinstance(a, (ConsPair, ConsNull))]
    kinds = {type(a) for a in sequences if not issubclass(type(a), ConsPair)}
    if len(kinds) > 1:
        return None
    empty = (kinds or {default}).pop()
    return lall(*[eq(term, empty()) for term in terms])


@_staged
def itero(state: State, coll: Any, nullo_refs: Any = None, default_ConsNull: type = list) -> Goal:
    """The term is a sequence."""
    known, head, tail = reify(coll, state), var(), var()
    return conde(
        [nullo(known, refs=nullo_refs, default_ConsNull=default_ConsNull)],
        [conso(head, tail, known), itero(tail, default_ConsNull=default_ConsNull)],
    )


@_staged
def membero(state: State, x: Any, coll: Any) -> Goal:
    """``x`` is an item."""
    head, tail = var(), var()
    return lall(conso(head, tail, coll), conde([eq(head, x)], [membero(x, tail)]))


@_staged
def appendo(state: State, front: Any, back: Any, whole: Any, default_ConsNull: type = list) -> Goal:
    """The front followed by the back is the whole."""
    front, back, whole = reify((front, back, whole), state)
    head, tail, rest = var(prefix="a"), var(prefix="d"), var(prefix="res")
    return conde(
        [nullo(back, front, whole, default_ConsNull=default_ConsNull)],
        [
            conso(head, tail, whole),
            eq(back, whole),
            nullo(front, refs=(back, whole), default_ConsNull=default_ConsNull),
        ],
        [
            conso(head, tail, front),
            conso(head, rest, whole),
            appendo(tail, back, rest, default_ConsNull=default_ConsNull),
        ],
    )


@_staged
def rembero(state: State, x: Any, coll: Any, left: Any, default_ConsNull: type = list) -> Goal:
    """``left`` is what is left of the sequence without its first ``x``."""
    x, coll, left = reify((x, coll, left), state)
    head, tail, rest = var(), var(), var()
    return conde(
        [nullo(coll, left, default_ConsNull=default_ConsNull)],
        [conso(head, tail, coll), eq(x, head), eq(tail, left)],
        [
            conso(head, tail, coll),
            _neq(head, x),
            conso(head, rest, left),
            rembero(x, tail, rest, default_ConsNull=default_ConsNull),
        ],
    )


@_staged
def permuteo(
    state: State, a: Any, b: Any, inner_eq: Any = eq, default_ConsNull: type = list, no_ident: bool = False
) -> Goal:
    """One sequence has the items of the other, in any order."""
    permuted: Any = theirs.permuteo
    if inner_eq is eq and isground(a, state) and isground(b, state):
        inner_eq = core.eq  # by which kanren knows that a single look will do
    goal: Goal = permuted(a, b, inner_eq, default_ConsNull, no_ident)
    return goal


permuteq = permuteo

__all__ = ["appendo", "conso", "heado", "itero", "membero", "nullo", "permuteo", "permuteq", "rembero", "tailo"]
