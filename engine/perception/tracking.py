"""Object permanence between sensor and perception: what is not seen is where it was last known to be."""

from __future__ import annotations

import math
from collections import deque

from casper.engine.perception.filters.association import Associator
from casper.engine.perception.filters.quality import Gauge, Quality
from casper.engine.perception.filters.settings import TrackerSettings as TrackerSettings
from casper.engine.perception.filters.settings import tracker_settings as tracker_settings
from casper.engine.perception.filters.steadying import Steadier
from casper.engine.perception.filters.tracks import AgentTrack, ObjectTrack
from casper.engine.perception.perception import check_world
from casper.engine.perception.world import AgentState, ObjectState, WorldState

RECENT = 40  # world states from which the filters begin, once the sensor is found to be poor


class Tracker:
    """Turns each sensed world state into a steadier one in which nothing once seen is lost.

    Args:
        settings: what is mended, and from when on a sensor is filtered.
        own: the name of the one who looks, of whose own pose there is no doubt; None: nobody in view.
        associator: gives what is seen the names by which it was known; None: things are what they are called.
    """

    def __init__(
        self, settings: TrackerSettings, own: str | None = None, associator: Associator | None = None
    ) -> None:
        self.settings, self.own, self._associator = settings, own, associator
        self.reset()

    def reset(self) -> None:
        """Forget every object and agent."""
        self._t: float | None = None
        self.latest: WorldState | None = None  # what was told last
        self._agents: dict[str, AgentTrack] = {}
        self._objects: dict[str, ObjectTrack] = {}
        self._gauge = Gauge()
        self._steadier: Steadier | None = None
        self._recent: deque[WorldState] = deque(maxlen=RECENT)
        self._last = -math.inf
        if self._associator is not None:
            self._associator.reset()

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
        if self._associator is not None:
            check_world(self._t, world)
            world = self._associator.update(world)
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
                self._agents[name] = AgentTrack()
        for name, track in self._agents.items():
            state = track.update(t, agents.get(name), settings)
            if state is not None:
                seen[name] = state
        return seen

    def _met(self, name: str, seen: ObjectState | None, holder: AgentState | None) -> ObjectState:
        first = seen if seen is not None or holder is None else ObjectState(holder.x, holder.y)
        assert first is not None  # a name comes from the world state or from a hand
        track = self._objects[name] = ObjectTrack(first)
        track.held = holder is not None
        return first
