"""World states: what a robot's perception hands to the mind at one moment (frozen data, and its JSON)."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from casper.engine.perception.printing import world_lines
from casper.kb.errors import WorldStateError
from casper.kb.terms.numbers import as_float
from casper.kb.text.lines import Line, one_line, text_of


@dataclass(frozen=True, slots=True)
class AgentState:
    """An agent at one moment: position (metres), heading (radians, 0 = +x, counter-clockwise), what it holds.

    ``grasp`` is the weight of evidence, 0 to 1, that the hand holds something, where a tracker is not sure.
    """

    x: float
    y: float
    heading: float
    holding: str | None = None
    grasp: float | None = None


@dataclass(frozen=True, slots=True)
class ObjectState:
    """An object of interest at one moment (metres); ``z`` is None where the sensor gives a plane only."""

    x: float
    y: float
    z: float | None = None


@dataclass(frozen=True, slots=True)
class WorldState:
    """The paper's World State: time (seconds), agents and objects by name, as seen at that moment.

    Names that were not seen at this moment are simply absent.
    """

    t: float
    agents: Mapping[str, AgentState]
    objects: Mapping[str, ObjectState]

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return world_lines(self.t, self.agents, self.objects)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"WorldState at {self.t:g} s: {', '.join((*self.agents, *self.objects))}")


def world_state_from_json(data: str | bytes | Mapping[str, Any]) -> WorldState:
    """Read one world state from its JSON text or the object it stands for.

    Raises:
        WorldStateError: not JSON, a missing key, or a coordinate that is missing, NaN or infinite;
            the sentence names the object or agent and the time.
    """
    data = json_object(data)
    t = _number(data, "t", "the world state")
    when = f"at t={t:g}"
    agents = {
        name: AgentState(
            _number(entry, "x", f"agent {name} {when}"),
            _number(entry, "y", f"agent {name} {when}"),
            _number(entry, "heading", f"agent {name} {when}"),
            _held(entry, f"agent {name} {when}"),
        )
        for name, entry in _entries(data, "agents", when)
    }
    objects = {
        name: ObjectState(
            _number(entry, "x", f"object {name} {when}"),
            _number(entry, "y", f"object {name} {when}"),
            None if entry.get("z", None) is None else _number(entry, "z", f"object {name} {when}"),
        )
        for name, entry in _entries(data, "objects", when)
    }
    return WorldState(t, agents, objects)


def json_object(data: str | bytes | Mapping[str, Any]) -> Mapping[str, Any]:
    """The object that a line of JSON is; an object is itself.

    Raises:
        WorldStateError: it is not JSON, or no object.
    """
    if isinstance(data, (str, bytes)):
        try:
            data = json.loads(data)
        except (ValueError, RecursionError) as mistake:
            raise WorldStateError(f"this is not a line of JSON ({mistake})") from None
    if not isinstance(data, Mapping):
        raise WorldStateError(
            f'a world state is an object with "t", "agents" and "objects", not {data!r:.60}'
        )
    return data


def world_state_to_json(world: WorldState) -> dict[str, Any]:
    """The JSON object of the design for one world state; reading it back gives an equal one."""
    agents = {
        name: {"x": a.x, "y": a.y, "heading": a.heading, "holding": a.holding}
        for name, a in world.agents.items()
    }
    objects = {name: {"x": o.x, "y": o.y, "z": o.z} for name, o in world.objects.items()}
    return {"t": world.t, "agents": agents, "objects": objects}


def _number(entry: Mapping[str, Any], key: str, whose: str) -> float:
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise WorldStateError(f'{whose} has no number under "{key}"')
    if not math.isfinite(as_float(value)):
        shown = value if isinstance(value, float) else "a number too large"
        raise WorldStateError(f'{whose} has {shown} under "{key}"; coordinates must be finite numbers')
    return float(value)


def _held(entry: Mapping[str, Any], whose: str) -> str | None:
    held = entry.get("holding")
    if held is not None and not isinstance(held, str):
        raise WorldStateError(
            f'{whose} has {held!r:.40} under "holding"; it must be an object\'s name or null'
        )
    return held


def _entries(data: Mapping[str, Any], key: str, when: str) -> list[tuple[str, Mapping[str, Any]]]:
    table = data.get(key)
    if not isinstance(table, Mapping):
        raise WorldStateError(f'the world state {when} has no object under "{key}"')
    for name, entry in table.items():
        if not isinstance(entry, Mapping):
            raise WorldStateError(f'"{name}" under "{key}" {when} must be an object with its coordinates')
    return list(table.items())
