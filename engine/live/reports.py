"""What a robot sends: world states, and in between what became of its part, as JSON objects."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from casper.engine.events import Event
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState, json_object, world_state_from_json
from casper.kb.errors import WorldStateError
from casper.kb.terms.numbers import as_float
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_statement

STATUSES = ("asked", "done", "failed", "stopped")


@dataclass(frozen=True, slots=True)
class Report:
    """What became of an action (without its agent) of the robot's part at a time (seconds).

    ``status`` is one of `STATUSES`; those of what was asked or stopped say nothing new. ``partner`` is whose part it
    belongs to, where that is told.
    """

    t: float
    action: Compound
    status: str
    partner: str | None = None


Message: TypeAlias = WorldState | Report


def message_from_json(line: str | bytes | Mapping[str, Any]) -> Message:
    """A line of JSON: a world state, or a report, which is a ``robot`` event as ``casper run`` prints it.

    ``{"type": "robot", "t": 40.0, "action": "wash(plate, sink)", "status": "done"}``

    Raises:
        WorldStateError: it is neither. ReadError: what was done is no action.
    """
    data = json_object(line)
    kind = data.get("type")
    if kind is None or "agents" in data:
        return world_state_from_json(data)
    if kind != "robot":
        known = 'reports have the type "robot", world states have none'
        raise WorldStateError(f"its type, {kind!r:.40}, is unknown; {known}")
    return _report(data)


def heard(minds: Mind | Partners, message: Message) -> list[Event]:
    """The events of a world state or a report.

    Raises:
        WorldStateError, CasperError: as `Mind.update`.
    """
    if isinstance(message, WorldState):
        return minds.update(message)
    hearing = minds
    if isinstance(minds, Partners) and message.partner in minds.minds:
        hearing = minds.minds[message.partner]
    if message.status == "done":
        return hearing.did(message.action, message.t)
    return hearing.failed(message.action, message.t) if message.status == "failed" else []


def _report(data: Mapping[str, Any]) -> Report:
    t, action, status, partner = as_float(data.get("t")), data.get("action"), data.get("status"), data.get("partner")
    if not math.isfinite(t):
        raise WorldStateError('what the robot did has no finite number under "t"')
    if not isinstance(action, str) or status not in STATUSES:
        kinds = ", ".join(STATUSES)
        raise WorldStateError(f'what the robot did needs an "action" and a "status", one of {kinds}')
    return Report(t, read_statement(action), status, partner if isinstance(partner, str) else None)
