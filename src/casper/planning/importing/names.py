"""Names of a problem as names of the language, and back.

A name that has a meaning to the system, such as ``goal`` or ``by``, gets ``_`` at its end; so does one that is such a
name with ``_`` already, so the way back is clear. Parameters become variables: ``?from-place`` is ``From_place``.
"""

from __future__ import annotations

import re

from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM
from casper.kb.terms.control import CONTROL
from casper.plans.grammar.shapes import SHAPES
from casper.plans.relations import RELATIONS

NETWORK, ACHIEVE, ACT, GOAL_STATE = "task_network", "achieve", "act", "goal_state"
OWN = frozenset(
    {
        *("problem", "type", "subtype", "fluent", "compound_task", "method", "actor", "agent_parameter"),
        *("holds", "value", "initially", "initial_value", "initiates", "terminates", "changes", "assigns"),
        *("ended", "ended_since", "changed", "changed_since", "earlier", "moment"),
        *(NETWORK, ACHIEVE, ACT, GOAL_STATE),
    }
)
READ = frozenset({"goal", "prior", "setting", "human", "robot", "agent", "by", "example"})  # by the system
PHYSICAL = frozenset(
    {
        *("band", "encoding", "movement", "transition", "start", "cycle", "loop", "context", "emission", "body"),
        *("outline", "walkable", "hole", "furniture", "shelf", "opens", "position", "shape", "mass", "placing"),
        *("consumes", "colour"),
    }
)
RESERVED = frozenset(
    {*OWN, *READ, *PHYSICAL, *SHAPES, *(name for name, _ in (*SYSTEM, *BUILTINS, *CONTROL, *RELATIONS))}
)


def outward(name: str) -> str:
    """A name of the problem as one of the language."""
    return f"{name}_" if name.rstrip("_") in RESERVED else name


def inward(name: str) -> str:
    """The name of the problem behind one of the language."""
    return name[:-1] if name.endswith("_") and name.rstrip("_") in RESERVED else name


def variable_name(name: str) -> str:
    """A parameter's name as that of a variable."""
    plain = re.sub(r"\W", "_", name)
    return plain[0].upper() + plain[1:] if plain[:1].isalpha() else f"V_{plain}"


def parameter_name(name: str) -> str:
    """A variable's name as that of a parameter."""
    return name[0].lower() + name[1:]


class Fresh:
    """Names of one clause: each is given away once."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def copy(self) -> Fresh:
        """One that goes its own way from here."""
        other = Fresh()
        other._taken = set(self._taken)
        return other

    def take(self, other: Fresh) -> None:
        """What the other gave away is given away here, too."""
        self._taken |= other._taken

    def name(self, wanted: str) -> str:
        """The wanted name, or with the first number behind it that is free."""
        found, number = wanted, 2
        while found in self._taken:
            found = f"{wanted}_{number}" if wanted[-1].isdigit() else f"{wanted}{number}"
            number += 1
        self._taken.add(found)
        return found
