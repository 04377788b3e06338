"""What a robot sends: world states, and in between what became of its part, as JSON objects."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from casper.engine.events import Event
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import json_object, world_state_from_json
from casper.kb.errors import WorldStateError
from casper.kb.terms.numbers import as_float
from casper.kb.text.reader import read_statement

STATUSES = ("asked", "done", "failed", "stopped")


def heard(minds: Mind | Partners, line: str, now: float) -> tuple[list[Event], float]:
    """The events of one line of JSON, a world state or a report, and the time after it.

    A report is a ``robot`` event: ``{"type": "robot", "t": 40.0, "action": "wash(plate, sink)", "status": "done"}``.
    Those of what was asked or stopped say nothing new.

    Args:
        minds: who hears it.
        line: the JSON text.
        now: the time of the line before (seconds).

    Raises:
        WorldStateError: it is neither, or a report of the past. ReadError: what was done is no action.
    """
    data = json_object(line)
    if data.get("type") != "robot":
        world = world_state_from_json(data)
        return minds.update(world), world.t
    t, action, status = _report(data, now)
    done = read_statement(action)
    if status == "done":
        return minds.did(done, t), t
    return (minds.failed(done, t) if status == "failed" else []), t


def _report(data: Mapping[str, Any], now: float) -> tuple[float, str, str]:
    t, action, status = as_float(data.get("t")), data.get("action"), data.get("status")
    if not math.isfinite(t):
        raise WorldStateError('what the robot did has no finite number under "t"')
    if t < now:
        raise WorldStateError(f"time must not run backwards: what the robot did at t={t:g} came after t={now:g}")
    if not isinstance(action, str) or status not in STATUSES:
        kinds = ", ".join(STATUSES)
        raise WorldStateError(f'what the robot did needs an "action" and a "status", one of {kinds}')
    return t, action, status
