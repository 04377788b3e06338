"""Frozen records that are made for every world state: what sets their fields in an ``__init__`` of their own.

The one that a frozen dataclass is given takes twice as long, and a step of the mind makes dozens of them.

    @dataclass(frozen=True, slots=True, init=False)
    class Place:
        x: float

        def __init__(self, x: float) -> None:
            _x(self, x)


    (_x,) = setters(Place)
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, TypeAlias

Setter: TypeAlias = Callable[[Any, Any], None]


def setters(kind: type) -> tuple[Setter, ...]:
    """What sets each field of a slotted dataclass, in order; nothing but its ``__init__`` should."""
    return tuple(vars(kind)[field.name].__set__ for field in dataclasses.fields(kind))
