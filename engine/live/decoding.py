"""World states from lines of JSON by msgspec, where that is installed (``[fast]``): four times as fast, the same ones.

Only what leaves no question is read here. All else (a name that is there twice, a number that is none, a report) is
left to `message_from_json`, which is what to read lines with and has the sentences.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from casper.engine.perception.world import AgentState, ObjectState, WorldState

NAMES, OF_AGENT, OF_OBJECT = 3, 5, 4  # of a world state, of each agent and of each object, its own included


def plain_world_state(text: str | bytes) -> WorldState | None:
    """The world state of a line, if it has exactly what the design says of one; None is no verdict."""
    decode = _decoder()
    if decode is None:
        return None
    try:
        world = decode(text)
    except (ValueError, RecursionError):  # msgspec's own are of the former kind
        return None
    agents, objects = world.agents, world.objects
    # Each name has a colon behind it, and none may be missing: so many colons are no name twice, and none beside these.
    colons = text.count(":") if isinstance(text, str) else text.count(b":")
    if colons != NAMES + OF_AGENT * len(agents) + OF_OBJECT * len(objects):
        return None
    for thing in objects.values():
        if thing.z is None:  # or it is missing, which only the other way of reading knows
            return None
    seen = {name: AgentState(a.x, a.y, a.heading, a.holding) for name, a in agents.items()}
    return WorldState(world.t, seen, objects)


@cache
def _decoder() -> Callable[[str | bytes], Any] | None:
    """What decodes a line; who reads no lines does not wait for the library to load."""
    try:
        import msgspec
    except ImportError:
        return None
    fields: list[Any] = [("x", float), ("y", float), ("heading", float), ("holding", str | None)]
    agent: Any = msgspec.defstruct("Agent", fields)
    parts: list[Any] = [("t", float), ("agents", dict[str, agent]), ("objects", dict[str, ObjectState])]
    world: Any = msgspec.defstruct("World", parts)
    decode: Callable[[str | bytes], Any] = msgspec.json.Decoder(world).decode
    return decode
