"""What is in view from state to state: names that cannot be, places that nobody can have gone to, what is long unseen.

Nothing is mended here but what would make no sense to a mind; the rest is told, once for each thing it happens to.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from math import hypot

from casper.engine.domain.domain import Domain
from casper.engine.perception.filters.association import associator_of
from casper.engine.perception.tracking import tracker_settings
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.streams.items import Item, Note

STEP, FASTEST = 1.5, 3.0  # metres, and m/s beside them, that an agent may be from where it was
APART = 0.6  # metres that a thing may be from where it was, whatever the sensor
REACH = 1.6  # metres from an agent within which things are moved
UNSEEN = 60.0  # seconds after which it is told that something is not seen any more
MOST = 1_000  # names that are followed


def sighted(items: Iterable[Item], domain: Domain) -> Iterator[Item]:
    """What minds of a domain can take in, and before each state what there is to say about it."""
    sightings = Sightings(domain)
    for item in items:
        if isinstance(item, Note) or not isinstance(item.message, WorldState):
            yield item
            continue
        world, told = sightings.update(item.message)
        yield from (Note(f"{item.where}: {sentence}") for sentence in told)
        yield item if world is item.message else replace(item, message=world)


class Sightings:
    """Looks at one world state after the other."""

    def __init__(self, domain: Domain) -> None:
        self._domain = domain
        self._associator = associator_of(tracker_settings(domain.kb.rows), domain.kb)
        self._t = 0.0
        self._agents: dict[str, tuple[float, AgentState]] = {}
        self._objects: dict[str, tuple[float, ObjectState]] = {}
        self._jumped: dict[str, ObjectState] = {}  # seen elsewhere once
        self._unseen: set[str] = set()  # told of
        self._both: set[str] = set()  # told of
        self._told_of_many = False
        self._next_look = UNSEEN

    def update(self, world: WorldState) -> tuple[WorldState, list[str]]:
        """The state without what cannot be, and what there is to say about it."""
        told: list[str] = []
        if self._associator is not None:  # as minds do: else each new number would be one more unknown name
            world = self._associator.update(world)
        if not world.objects.keys().isdisjoint(world.agents):
            world = self._without_doubles(world, told)
        if not world.objects.keys() <= self._objects.keys():
            world = self._met(world, told)
        told += self._agents_elsewhere(world)
        told += self._objects_elsewhere(world)
        if world.t >= self._next_look or self._unseen:
            told += self._long_unseen(world)
        self._t = world.t
        return world, told

    def _without_doubles(self, world: WorldState, told: list[str]) -> WorldState:
        """An agent is no object."""
        both = [name for name in world.objects if name in world.agents]
        for name in both:
            if name not in self._both and len(self._both) < MOST:
                self._both.add(name)
                told.append(f"{name} is an agent and an object at once; the object of that name is left out")
        return replace(world, objects={name: thing for name, thing in world.objects.items() if name not in both})

    def _met(self, world: WorldState, told: list[str]) -> WorldState:
        """Things in view for the first time; so many names that nobody could follow them are left out."""
        new = [name for name in world.objects if name not in self._objects]
        room = MOST - len(self._objects)
        for name in new[:room]:
            self._objects[name] = world.t, world.objects[name]
        unknown = self._domain.kb.unmentioned(new[:room]) if self._domain.verifies else ()
        for name in sorted(unknown):
            told.append(f"{name} is in view and nothing the domain knows; what is done with it is not valid")
        left_out = set(new[room:])
        if not left_out:
            return world
        if not self._told_of_many:
            self._told_of_many = True
            told.append(f"more than {MOST:,} names of objects: {new[room]} and those that follow are left out")
        return replace(world, objects={name: thing for name, thing in world.objects.items() if name not in left_out})

    def _agents_elsewhere(self, world: WorldState) -> Iterator[str]:
        for name, agent in world.agents.items():
            before = self._agents.get(name)
            if before is None and len(self._agents) >= MOST:
                continue
            self._agents[name] = world.t, agent
            if before is None:
                continue
            dt, gap = world.t - before[0], hypot(agent.x - before[1].x, agent.y - before[1].y)
            if gap > STEP + FASTEST * dt:
                yield f"{name} is suddenly {gap:.1f} m from where it was {dt:g} s before"

    def _objects_elsewhere(self, world: WorldState) -> Iterator[str]:
        """What was seen at another place twice, with nobody near one or the other."""
        for name, thing in world.objects.items():
            lay = self._objects[name][1]
            gap_x, gap_y = thing.x - lay.x, thing.y - lay.y
            if -APART < gap_x < APART and -APART < gap_y < APART:
                self._objects[name] = world.t, thing
                if self._jumped:
                    self._jumped.pop(name, None)
                continue
            if self._reached(world.agents, lay) or self._reached(world.agents, thing):
                self._objects[name] = world.t, thing
                continue
            seen = self._jumped.pop(name, None)
            if seen is None or hypot(thing.x - seen.x, thing.y - seen.y) > APART:
                self._jumped[name] = thing
                continue
            self._objects[name] = world.t, thing
            yield f"{name} is suddenly {hypot(gap_x, gap_y):.1f} m from where it was, with nobody near"

    def _reached(self, agents: Mapping[str, AgentState], place: ObjectState) -> bool:
        return any(hypot(agent.x - place.x, agent.y - place.y) < REACH for agent in agents.values())

    def _long_unseen(self, world: WorldState) -> Iterator[str]:
        """Looked at now and then; one that is back may be missed again."""
        self._unseen.difference_update(world.objects)
        if world.t < self._next_look:
            return
        self._next_look = world.t + UNSEEN / 4
        held = {agent.holding for agent in world.agents.values()}
        for name, (t, thing) in self._objects.items():
            if world.t - t > UNSEEN and name not in self._unseen and name not in held:
                self._unseen.add(name)
                was = f"it is taken to be where it was, at ({thing.x:.2f}, {thing.y:.2f})"
                yield f"{name} was not seen since t={t:g}; {was}"
