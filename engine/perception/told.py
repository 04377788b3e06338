"""What perception has to tell, as events: what somebody attends to, and what was suddenly elsewhere."""

from __future__ import annotations

from casper.engine.events import Event
from casper.engine.perception.focus import Focus
from casper.engine.perception.tracking import Tracker


def jumps(tracker: Tracker, t: float) -> list[Event]:
    """Told of what was suddenly elsewhere."""
    if not tracker.jumps:
        return []
    told = "is suddenly somewhere else, with nobody near who could have brought it there"
    return [Event("warning", t, {"message": f"{name} {told}"}) for name in tracker.jumps]


def focus_event(focus: Focus, agent: str) -> Event:
    """What an agent attends to."""
    data = {"agent": agent, "target": focus.target, "destination": focus.destination, "scores": dict(focus.scores)}
    return Event("focus", focus.t, data)
