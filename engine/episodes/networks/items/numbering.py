"""One form for what is equal: open slots numbered as they are met, the items of groups without an order sorted."""

from __future__ import annotations

from functools import cmp_to_key, partial
from typing import Any

from casper.engine.episodes.networks.items.terms import PAR, Env, Slot, resolve, slot


def numbered(term: Any, env: Env, names: dict[Slot, Slot]) -> Any:
    """The term resolved, with its open slots numbered in the order in which they are met; ``names`` grows.

    The items of a group without an order are sorted, those of groups within it too, so that it does not matter in which
    order they came about.
    """
    kind = term.__class__
    if kind is Slot:
        term = resolve(term, env)
        kind = term.__class__
        if kind is Slot:
            name = names.get(term)
            if name is None:
                name = names[term] = slot(len(names))
            return name
    if kind is not tuple:
        return term
    if term and term[0] is PAR and not any(term[2]):
        items = sorted(_flat(term), key=cmp_to_key(partial(_order, env)))
        return (PAR, tuple([numbered(item, env, names) for item in items]), (0,) * len(items))
    parts = list(term)
    for at, part in enumerate(term):  # as above for each part, without a call for those that need none
        kind = part.__class__
        if kind is Slot and part not in env:
            name = names.get(part)
            if name is None:
                name = names[part] = slot(len(names))
            parts[at] = name
        elif kind is tuple or kind is Slot:
            parts[at] = numbered(part, env, names)
    return tuple(parts)


def _flat(group: Any) -> list[Any]:
    """The items of a group without an order, and those of such groups within it."""
    found: list[Any] = []
    for item in group[1]:
        if item[0] is PAR and not any(item[2]):
            found.extend(_flat(item))
        else:
            found.append(item)
    return found


def _order(env: Env, left: Any, right: Any) -> int:
    """Below 0 where ``left`` comes first: as texts, open slots alike, and what goes on longer before what does not."""
    while left.__class__ is Slot and (value := env.get(left)) is not None:
        left = value
    while right.__class__ is Slot and (value := env.get(right)) is not None:
        right = value
    if left.__class__ is tuple and right.__class__ is tuple:
        for one, other in zip(left, right):
            if one is not other or one.__class__ is tuple:
                found = _order(env, one, other)
                if found:
                    return found
        return len(right) - len(left)
    if left is right:
        return 0
    first, then = _text(left), _text(right)
    return (first > then) - (first < then)


def _text(atom: Any) -> str:
    if atom.__class__ is str:
        return str(atom)
    return "_" if atom.__class__ is Slot else "(" if atom.__class__ is tuple else repr(atom)
