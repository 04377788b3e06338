"""Unification of kanren's terms with an occurs check: no variable ever becomes a term that contains it.

kanren's own unification is driven, with all its dispatches, and every single binding is looked at before the next is
made: ``(x,) = x`` and whatever leads to it fails, where kanren goes on forever.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from cons.core import ConsPair
from kanren.constraints import ConstrainedState
from unification import isvar, unify
from unification.core import _unify, stream_eval, unground_lvars
from unification.utils import transitive_get as walk

State: TypeAlias = Any  # a mapping of kanren variables, perhaps a ConstrainedState
_PLAIN = frozenset((str, int, float, bool, type(None)))


class _Circular(Exception):
    """A binding would make an endless term."""


def unified(left: Any, right: Any, state: State) -> Any:
    """The state in which both are the same; False when there is none (kanren's word for failure)."""
    data = state.data if isinstance(state, ConstrainedState) else state
    if type(data) is dict:
        left = walk(left, data) if isvar(left) else left
        right = walk(right, data) if isvar(right) else right
        if type(data) is type(state) and type(right) in _PLAIN and isvar(left):
            return {**data, left: right}
    if left is right:
        return state
    try:
        found = stream_eval(_unify(left, right, data), _Guard(data))
    except _Circular:
        return False
    return found if found is False or data is state else unify(left, right, state)


class _Guard:
    """Sees each state that a unification comes to, and stops it at the first endless term."""

    def __init__(self, state: Mapping[Any, Any]) -> None:
        self.state = state

    def __call__(self, _: object, found: Any) -> None:
        """Look at the binding that is new in the state that was found."""
        if found is not self.state and isinstance(found, dict):
            if len(found) > len(self.state):
                variable = next(reversed(found))
                if occurs(variable, found[variable], self.state):
                    raise _Circular
            self.state = found


def occurs(variable: Any, term: Any, state: Mapping[Any, Any]) -> bool:
    """Whether an unbound variable is a part of the term as the state has it."""
    waiting, seen = [term], set[int]()
    while waiting:
        part = waiting.pop()
        if type(part) in _PLAIN:
            continue
        if isvar(part):
            part = walk(part, state)
            if part == variable:
                return True
        if isvar(part) or id(part) in seen:
            continue
        seen.add(id(part))
        if isinstance(part, (tuple, list, set, frozenset)):
            waiting.extend(part)
        elif isinstance(part, Mapping):
            waiting.extend(part.values())
        elif isinstance(part, ConsPair):
            waiting.extend((part.car, part.cdr))
        elif variable in unground_lvars(part, state):
            return True
    return False
