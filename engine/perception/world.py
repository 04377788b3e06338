"""World states: what a robot's perception hands to the mind at one moment (frozen data, and its JSON)."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from casper.engine.events.records import setters
from casper.engine.perception.printing import world_lines
from casper.kb.errors import WorldStateError
from casper.kb.terms.numbers import as_float
from casper.kb.text.lines import Line, one_line, text_of


@dataclass(frozen=True, slots=True)
class Doubt:
    """How sure a tracker is of an agent.

    grasp: the weight of evidence, 0 to 1, that the hand holds something. moves: the probability that it walks. spread:
    metres, standard deviation of its distance to things. slack: metres by which all of them may seem too far.
    """

    grasp: float
    moves: float
    spread: float
    slack: float = 0.0


@dataclass(frozen=True, slots=True, init=False)
class AgentState:
    """An agent at one moment: position (metres), heading (radians, 0 = +x, counter-clockwise), what it holds.

    ``doubt`` is there where a tracker is not sure of what it tells.
    """

    x: float
    y: float
    heading: float
    holding: str | None = None
    doubt: Doubt | None = None

    def __init__(
        self, x: float, y: float, heading: float, holding: str | None = None, doubt: Doubt | None = None
    ) -> None:
        _agent_x(self, x)
        _agent_y(self, y)
        _heading(self, heading)
        _holding(self, holding)
        _doubt(self, doubt)


_agent_x, _agent_y, _heading, _holding, _doubt = setters(AgentState)


@dataclass(frozen=True, slots=True, init=False)
class ObjectState:
    """An object of interest at one moment (metres); ``z`` is None where the sensor gives a plane only."""

    x: float
    y: float
    z: float | None = None

    def __init__(self, x: float, y: float, z: float | None = None) -> None:
        _x(self, x)
        _y(self, y)
        _z(self, z)


_x, _y, _z = setters(ObjectState)


@dataclass(frozen=True, slots=True, init=False)
class WorldState:
    """The paper's World State: time (seconds), agents and objects by name, as seen at that moment.

    Names that were not seen at this moment are simply absent.
    """

    t: float
    agents: Mapping[str, AgentState]
    objects: Mapping[str, ObjectState]

    def __init__(self, t: float, agents: Mapping[str, AgentState], objects: Mapping[str, ObjectState]) -> None:
        _t(self, t)
        _agents(self, agents)
        _objects(self, objects)

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return world_lines(self.t, self.agents, self.objects)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"WorldState at {self.t:g} s: {', '.join((*self.agents, *self.objects))}")


_t, _agents, _objects = setters(WorldState)


def world_state_from_json(data: str | bytes | Mapping[str, Any]) -> WorldState:
    """Read one world state from its JSON text or the object it stands for.

    Raises:
        WorldStateError: not JSON, a name that is there twice, a missing key, or a coordinate that is missing, NaN or
            infinite; the sentence names the object or agent and the time.
    """
    data = json_object(data)
    t = _number(data, "t", "the world state")
    agents = {name: _agent(entry, name, t) for name, entry in _entries(data, "agents", t)}
    objects = {name: _object(entry, name, t) for name, entry in _entries(data, "objects", t)}
    return WorldState(t, agents, objects)


def _agent(entry: Mapping[str, Any], name: str, t: float) -> AgentState:
    try:
        x, y, heading, held = entry["x"], entry["y"], entry["heading"], entry["holding"]
        if type(x) is type(y) is type(heading) is float and (x + y + heading) * 0.0 == 0.0 and held is None:
            return AgentState(x, y, heading)  # all finite, as nearly always
    except (KeyError, TypeError, IndexError):
        _check_entry(entry, name, "agents", t)
    x, y, heading = [_number(entry, key, "agent", name, t) for key in ("x", "y", "heading")]
    return AgentState(x, y, heading, _held(entry, name, t))


def _object(entry: Mapping[str, Any], name: str, t: float) -> ObjectState:
    try:
        x, y, z = entry["x"], entry["y"], entry["z"]
        if type(x) is type(y) is type(z) is float and (x + y + z) * 0.0 == 0.0:
            return ObjectState(x, y, z)
    except (KeyError, TypeError, IndexError):
        _check_entry(entry, name, "objects", t)
    x, y = _number(entry, "x", "object", name, t), _number(entry, "y", "object", name, t)
    return ObjectState(x, y, None if entry.get("z") is None else _number(entry, "z", "object", name, t))


def json_object(data: str | bytes | Mapping[str, Any]) -> Mapping[str, Any]:
    """The object that a line of JSON is; an object is itself.

    Raises:
        WorldStateError: it is not JSON, no object, or has two values under one name.
    """
    if isinstance(data, (str, bytes)):
        text = data
        try:
            data = json.loads(text)
            if _colons(text) != _named(data):  # the one or the other may be more than names
                json.loads(text, object_pairs_hook=_once_each)
        except (ValueError, RecursionError) as mistake:
            raise WorldStateError(f"this is not a line of JSON ({mistake})") from None
    if not isinstance(data, Mapping):
        raise WorldStateError(f'a world state is an object with "t", "agents" and "objects", not {data!r:.60}')
    return data


def _colons(text: str | bytes) -> int:
    return text.count(":") if isinstance(text, str) else text.count(b":")


def _named(data: Any) -> int:
    """How many names there are, as far as they are those of a world state.

    Each name of a text has a colon behind it: as many colons as names that were read mean that none was there twice.
    """
    try:
        agents, objects = data["agents"], data["objects"]
        inner = sum(map(len, agents.values())) + sum(map(len, objects.values()))
        return len(data) + len(agents) + len(objects) + inner
    except (AttributeError, KeyError, TypeError):
        return -1


def _once_each(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise WorldStateError(f'"{twice}" is there twice, and which of both is meant cannot be known')
    return found


def world_state_to_json(world: WorldState) -> dict[str, Any]:
    """The JSON object of the design for one world state; reading it back gives an equal one."""
    agents = {
        name: {"x": a.x, "y": a.y, "heading": a.heading, "holding": a.holding}
        for name, a in world.agents.items()
    }
    objects = {name: {"x": o.x, "y": o.y, "z": o.z} for name, o in world.objects.items()}
    return {"t": world.t, "agents": agents, "objects": objects}


def _number(entry: Mapping[str, Any], key: str, kind: str, name: str = "", t: float | None = None) -> float:
    value = entry.get(key)
    if type(value) is float and value - value == 0.0:  # finite: every state has dozens of them
        return value
    whose = _whose(kind, name, t)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise WorldStateError(f'{whose} has no number under "{key}"')
    if not math.isfinite(as_float(value)):
        shown = value if isinstance(value, float) else "a number too large"
        raise WorldStateError(f'{whose} has {shown} under "{key}"; coordinates must be finite numbers')
    return float(value)


def _whose(kind: str, name: str, t: float | None) -> str:
    return kind if t is None else f"{kind} {name} at t={t:g}"


def _held(entry: Mapping[str, Any], name: str, t: float) -> str | None:
    held = entry.get("holding")
    if held is not None and not isinstance(held, str):
        whose = _whose("agent", name, t)
        raise WorldStateError(f'{whose} has {held!r:.40} under "holding"; it must be an object\'s name or null')
    return held


def _entries(data: Mapping[str, Any], key: str, t: float) -> Iterable[tuple[str, Mapping[str, Any]]]:
    table = data.get(key)
    if not isinstance(table, Mapping):
        raise WorldStateError(f'the world state at t={t:g} has no object under "{key}"')
    return table.items()


def _check_entry(entry: object, name: str, key: str, t: float) -> None:
    if not isinstance(entry, Mapping):
        raise WorldStateError(f'"{name}" under "{key}" at t={t:g} must be an object with its coordinates')
