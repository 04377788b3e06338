"""What is kept of one thing and of one agent that a good sensor sees: means over detections, and a way over gaps."""

from __future__ import annotations

import math
from dataclasses import replace

from casper.engine.perception.filters.settings import TrackerSettings
from casper.engine.perception.world import AgentState, ObjectState


class ObjectTrack:
    """One object: the mean of its detections since it last moved."""

    __slots__ = ("held", "n", "outside", "state")

    def __init__(self, state: ObjectState) -> None:
        self.state = state
        self.n = 1
        self.outside = 0
        self.held = False

    def update(self, seen: ObjectState | None, holder: AgentState | None, settings: TrackerSettings) -> ObjectState:
        state = self.state
        if holder is not None or self.held:
            self.held = holder is not None
            if holder is not None and seen is None:
                seen = ObjectState(holder.x, holder.y, state.z)
            return state if seen is None else self._restarted(seen)
        if seen is None:
            return state
        x, y = state.x, state.y
        dx, dy = seen.x - x, seen.y - y
        if math.hypot(dx, dy) > settings.gate:
            self.outside += 1
            return self._restarted(seen) if self.outside >= settings.outliers else state
        self.n, self.outside = self.n + 1 if self.n < settings.memory else settings.memory, 0
        share, z = 1.0 / self.n, seen.z
        if z is not None and state.z is not None:
            z = state.z + (z - state.z) * share
        self.state = ObjectState(x + dx * share, y + dy * share, z)
        return self.state

    def _restarted(self, seen: ObjectState) -> ObjectState:
        self.state, self.n, self.outside = seen, 1, 0
        return seen


class AgentTrack:
    """One agent: where it is, how fast it went, what is in its hand."""

    __slots__ = ("_grip", "_n", "_seen_at", "_state", "_t", "_velocity")

    def __init__(self) -> None:
        self._state: AgentState | None = None
        self._t = self._seen_at = 0.0
        self._n = 1
        self._velocity = (0.0, 0.0)
        self._grip = _Grip()

    def update(self, t: float, seen: AgentState | None, settings: TrackerSettings) -> AgentState | None:
        if seen is None:
            self._state = self._carried_on(t, settings)
        else:
            held = self._grip.update(seen.holding, settings)
            if held != seen.holding:
                seen = replace(seen, holding=held)
            self._state = self._steadied(t, seen, settings)
            self._seen_at = t
        self._t = t
        return self._state

    def _carried_on(self, t: float, settings: TrackerSettings) -> AgentState | None:
        state = self._state
        if state is None or t - self._seen_at > settings.agent_bridge:
            return None
        dt = t - self._t
        return replace(state, x=state.x + self._velocity[0] * dt, y=state.y + self._velocity[1] * dt)

    def _steadied(self, t: float, seen: AgentState, settings: TrackerSettings) -> AgentState:
        """The mean of what was seen since the agent last took a step; the velocity is kept for a gap."""
        before = self._state
        if before is None:
            self._n, self._velocity = 1, (0.0, 0.0)
            return seen
        dx, dy, dt = seen.x - before.x, seen.y - before.y, t - self._t
        if math.hypot(dx, dy) > settings.agent_gate or settings.memory == 1:
            self._n, self._velocity = 1, (dx / dt, dy / dt)
            return seen
        self._n = n = self._n + 1 if self._n < settings.memory else settings.memory
        dx, dy = dx / n, dy / n
        self._velocity = (dx / dt, dy / dt)
        return AgentState(before.x + dx, before.y + dy, seen.heading, seen.holding)


class _Grip:
    """What is in a hand, less the flicker of the sensor."""

    __slots__ = ("_candidate", "_run", "held")

    def __init__(self) -> None:
        self.held: str | None = None
        self._candidate: str | None = None
        self._run = 0

    def update(self, seen: str | None, settings: TrackerSettings) -> str | None:
        if seen == self.held:
            self._run = 0
            return seen
        self._run = self._run + 1 if seen == self._candidate and self._run else 1
        self._candidate = seen
        needed = settings.hold_bridge + 1 if seen is None else settings.hold_confirm
        if self._run >= needed:
            self.held, self._run = seen, 0
        return self.held
