"""What the page's script is given: the events as ``--json`` prints them, and where everybody was, as JSON.

The JSON stands in a script element that is no script, so nothing in it is ever run; ``<`` is spelt out, for that alone
could end the element.
"""

from __future__ import annotations

import json
import math
from typing import Any

from casper.report.recording import Recording
from casper.report.story import names_of


def payload(recording: Recording) -> dict[str, Any]:
    """``{"span", "robot", "partners", "events", "states", "told"}``; an event that is not kept is not in it.

    ``states`` has columns: ``t`` (s), by agent ``[x, y, heading, holding]`` or null (m, rad), by object ``[x, y]`` or
    null, rounded to millimetres. ``told`` has names and steps in the author's words.
    """
    return {
        "span": list(recording.span),
        "robot": recording.robot,
        "partners": list(recording.partners),
        "events": [event.to_json() for event in recording.events],
        "states": _columns(recording),
        "told": _told(recording),
    }


def script_json(data: dict[str, Any]) -> str:
    """The JSON text, fit to stand in a page. What is no finite number becomes null."""
    written = json.dumps(_finite(data), separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    return written.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _columns(recording: Recording) -> dict[str, Any]:
    states = recording.states
    agents = dict.fromkeys(name for state in states for name in state.agents)
    objects = dict.fromkeys(name for state in states for name in state.objects)
    return {
        "t": [state.t for state in states],
        "agents": {
            name: [
                None if (a := s.agents.get(name)) is None else [_mm(a.x), _mm(a.y), _mm(a.heading), a.holding]
                for s in states
            ]
            for name in agents
        },
        "objects": {
            name: [None if (o := s.objects.get(name)) is None else [_mm(o.x), _mm(o.y)] for s in states]
            for name in objects
        },
    }


def _told(recording: Recording) -> dict[str, str]:
    tell = names_of(recording).tell
    plans = recording.of_type("plan")
    theirs = {step: tell.step(step, str(plan.data.get("partner"))) for plan in plans for step in plan.data["waiting"]}
    ours = {step: tell.step(step, plan.data["agent"]) for plan in plans for step in plan.data["actions"]}
    states = recording.states
    names = *recording.partners, recording.robot, *(name for state in states for name in state.objects)
    return {**theirs, **ours, **{name: tell.name(name) for name in dict.fromkeys(names)}}


def _mm(value: float) -> float:
    return round(value, 3)


def _finite(value: Any) -> Any:
    """The value with null for what JSON cannot say."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {str(key): _finite(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)
