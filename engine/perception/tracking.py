"""Object permanence between sensor and perception: what is not seen is where it was last known to be."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, replace

from casper.engine.perception.filters.quality import Gauge, Quality
from casper.engine.perception.filters.steadying import Steadier
from casper.engine.perception.perception import check_world
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.engine.settings import Rows, read_settings, require


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """What the tracker mends.

    enabled: off passes world states through. gate: metres within which a detection of a resting object is
    noise and is averaged. memory: over how many detections at most. outliers: so many detections in a row
    outside the gate mean that it moved. agent_smoothing: weight of the previous estimate of an agent's
    position, 0 is off. hold_bridge: for how many steps a hand that seems empty still holds. hold_confirm:
    how many steps in a row an object must be seen in the hand to count as held. agent_bridge: seconds an
    agent that is out of sight is thought to go on as it went; 0 leaves it absent.

    steady: whether a sensor that is found to be poor is filtered (`engine.perception.filters`). It is poor from
    steady_noise metres of noise, steady_lost lost detections (a share), or steady_period seconds from state to state.
    It is then told at a pace of seconds, with a lag of seconds at least.
    """

    enabled: bool = True
    gate: float = 0.15
    memory: int = 50
    outliers: int = 2
    agent_gate: float = 0.08
    hold_bridge: int = 1
    hold_confirm: int = 1
    agent_bridge: float = 2.0
    steady: bool = True
    steady_noise: float = 0.02
    steady_lost: float = 0.12
    steady_period: float = 1.2
    pace: float = 0.5
    lag: float = 1.5

    def __post_init__(self) -> None:
        for name in ("gate", "agent_gate", "agent_bridge", "steady_noise", "steady_lost", "steady_period", "lag"):
            require(getattr(self, name) >= 0.0, f"{name} of the tracker must not be negative")
        require(self.pace > 0.0, "pace of the tracker must be above 0")
        require(self.memory >= 1 and self.outliers >= 1, "memory and outliers of the tracker start at 1")
        require(self.hold_bridge >= 0 and self.hold_confirm >= 1, "hold_bridge starts at 0, hold_confirm at 1")


def tracker_settings(rows: Rows) -> TrackerSettings:
    """Settings from facts ``setting(tracking, Name, Value)``.

    Raises:
        DomainError: an unknown setting or a value of the wrong kind.
    """
    return read_settings(TrackerSettings, rows, "tracking")


RECENT = 40  # world states from which the filters begin, once the sensor is found to be poor


class Tracker:
    """Turns each sensed world state into a steadier one in which nothing once seen is lost.

    Args:
        settings: what is mended, and from when on a sensor is filtered.
        own: the name of the one who looks, of whose own pose there is no doubt; None: nobody in view.
    """

    def __init__(self, settings: TrackerSettings, own: str | None = None) -> None:
        self.settings, self.own = settings, own
        self.reset()

    def reset(self) -> None:
        """Forget every object and agent."""
        self._t: float | None = None
        self.latest: WorldState | None = None  # what was told last
        self._agents: dict[str, _AgentTrack] = {}
        self._objects: dict[str, _ObjectTrack] = {}
        self._gauge = Gauge()
        self._steadier: Steadier | None = None
        self._recent: deque[WorldState] = deque(maxlen=RECENT)
        self._last = -math.inf

    @property
    def jumps(self) -> tuple[str, ...]:
        """What was found elsewhere, with nobody near who could have brought it, at the last world state."""
        return () if self._steadier is None else tuple(self._steadier.jumps)

    @property
    def late(self) -> float:
        """By how many seconds what is told is later than what it tells of; 0 where the sensor is good."""
        return 0.0 if self._steadier is None else self._steadier.lag

    @property
    def quality(self) -> Quality:
        """What is known of the sensor."""
        return self._gauge.quality

    def steps(self, world: WorldState) -> list[WorldState]:
        """The world states that follow from one that was sensed: one, or, of a poor sensor, those told by now.

        Raises:
            WorldStateError: as `update`.
        """
        steadies = self.settings.enabled and self.settings.steady
        if steadies and self._steadier is not None:
            return self._steadied(world, self._steadier)
        usual = self.update(world)
        if not steadies:
            return [usual]
        seen = self._gauge.update(world)
        self._recent.append(world)
        if not self._is_poor(seen):
            self._last = world.t
            return [usual]
        chosen = self.settings
        since = max(self._last, world.t - 100.0)
        self._steadier = Steadier(since, chosen.pace, chosen.lag, chosen.agent_bridge, self.own)
        return [w for recent in self._recent for w in self._steadier.update(recent, seen)]

    def _steadied(self, world: WorldState, steadier: Steadier) -> list[WorldState]:
        """Those that are told by now of a poor sensor; the last of them is the world as it is believed to be."""
        check_world(self._t, world)
        self._t = world.t
        told = steadier.update(world, self._gauge.update(world))
        if told:
            self.latest = told[-1]
        return told

    def _is_poor(self, seen: Quality) -> bool:
        """Whether the sensor is too poor to be believed a state at a time."""
        chosen = self.settings
        return (
            (seen.noise or 0.0) > chosen.steady_noise
            or seen.lost > chosen.steady_lost
            or (seen.period or 0.0) > chosen.steady_period
        )

    def update(self, world: WorldState) -> WorldState:
        """The world as it is believed to be at ``world.t``.

        A held object that is not seen is where its holder is; one that is seen is taken as seen.

        Raises:
            WorldStateError: time that does not advance, or a coordinate that is not finite.
        """
        check_world(self._t, world)
        self._t = world.t
        self.latest = self._tracked(world) if self.settings.enabled else world
        return self.latest

    def _tracked(self, world: WorldState) -> WorldState:
        """Things in the order of meeting, so that what follows is repeatable."""
        agents = self._track_agents(world)
        held = {a.holding: a for a in agents.values() if a.holding is not None}
        seen, settings, tracks = world.objects, self.settings, self._objects
        objects = {name: track.update(seen.get(name), held.get(name), settings) for name, track in tracks.items()}
        for name in (*seen, *held):
            if name not in objects:
                objects[name] = self._met(name, seen.get(name), held.get(name))
        return WorldState(world.t, agents, objects)

    def _track_agents(self, world: WorldState) -> dict[str, AgentState]:
        t, agents, settings, seen = world.t, world.agents, self.settings, {}
        for name in agents:
            if name not in self._agents:
                self._agents[name] = _AgentTrack()
        for name, track in self._agents.items():
            state = track.update(t, agents.get(name), settings)
            if state is not None:
                seen[name] = state
        return seen

    def _met(self, name: str, seen: ObjectState | None, holder: AgentState | None) -> ObjectState:
        first = seen if seen is not None or holder is None else ObjectState(holder.x, holder.y)
        assert first is not None  # a name comes from the world state or from a hand
        track = self._objects[name] = _ObjectTrack(first)
        track.held = holder is not None
        return first


class _ObjectTrack:
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


class _AgentTrack:
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
