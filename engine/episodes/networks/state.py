"""The state of a goal's instance whose plans are grown lazily."""

from __future__ import annotations

from typing import Any, NamedTuple

from casper.engine.episodes.networks.items.terms import Row, interned
from casper.engine.episodes.networks.remembering import Asked


class State(NamedTuple):
    """A goal's number, its term, the row of its open items, the conditions that wait; and how many slots it has."""

    goal: int
    term: Any
    rest: Row
    open: tuple[Asked, ...]
    slots: int

    def __reduce__(self) -> tuple[Any, ...]:
        return _state, tuple(self)


def _state(goal: int, *parts: Any) -> State:
    """A state that came from another process."""
    return State(goal, *map(interned, parts))
