"""World states of a poor sensor made steady: filtered, and told at an even pace, a little later.

What is told at a time is the world as it was ``lag`` seconds before, in the light of what was seen since. Agents stand
or walk, things rest or are carried; which of both is decided by likelihoods. Who is not seen for long is absent.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TypeAlias

from casper.engine.perception.filters.absence import Absences
from casper.engine.perception.filters.handling import QUIET, Handling
from casper.engine.perception.filters.hands import evidence_of, told_if_carried, told_of_hand
from casper.engine.perception.filters.people import Person
from casper.engine.perception.filters.quality import Quality
from casper.engine.perception.world import ObjectState, WorldState

REACH = 1.1  # metres from an agent within which things are taken, carried and put down
HOLDS = 0.3  # the share from which something is in the hand: in the middle of a use it is there for a moment only
LEAST_NOISE = 0.01  # metres
PAUSE = 60.0  # seconds without a world state after which nothing more is told until the next


Present: TypeAlias = tuple[str, float, float]
"""Somebody's name and where they are, x and y in metres."""


class Steadier:
    """Takes in world states as sensed, gives out steady ones.

    Args:
        since: the time of the last world state that was told otherwise; the first one comes a pace later.
        pace: seconds between two that are told.
        lag: seconds by which they are late.
        bridge: seconds for which an agent who is not seen is thought to go on.
        own: the name of the one who looks, who knows best where it is: it is told as it was sensed.
    """

    def __init__(
        self, since: float, pace: float = 0.5, lag: float = 1.5, bridge: float = 2.0, own: str | None = None
    ) -> None:
        self.since, self.pace, self.lag, self.bridge, self.own = since, pace, lag, bridge, own
        self._first_lag = lag
        self._noise = LEAST_NOISE
        self._marked = self._told = 0  # paces
        self._seen: float | None = None  # when the last world state was
        self._people: dict[str, Person] = {}
        self._things: dict[str, Handling] = {}
        self._absences = Absences()
        self.jumps: list[str] = []  # what was found elsewhere with nobody near, at the last world state

    def update(self, world: WorldState, quality: Quality) -> list[WorldState]:
        """Take in one; those that are told by now."""
        before = self._rested(world.t) if self._seen is not None and world.t - self._seen > PAUSE else []
        self._seen = world.t
        while (mark := self._content(self._marked + 1)) <= world.t:
            self._marked += 1
            self._mark(mark)
        self._noise = max(quality.noise or LEAST_NOISE, LEAST_NOISE)
        self._sense(world, self._noise)
        seen = world.objects
        self._absences.update(seen, {n: thing.rest for n, thing in self._things.items() if n not in seen}, quality)
        self.lag = max(self.lag, self._wanted(quality))
        return before + self._told_by(world.t)

    def _told_by(self, t: float) -> list[WorldState]:
        found = []
        while self._content(self._told + 1) + self.lag <= t + 1e-9:
            self._told += 1
            found.append(self._tell())
        return found

    def _rested(self, t: float) -> list[WorldState]:
        """Those of the beginning of a long pause; then it is gone on with at its end, at the same pace."""
        assert self._seen is not None
        while (mark := self._content(self._marked + 1)) <= self._seen + PAUSE:
            self._marked += 1
            self._mark(mark)
        found = self._told_by(self._seen + PAUSE)
        skipped = math.floor((t - self._content(self._marked)) / self.pace) - 1
        self._marked += max(skipped, 0)
        self._told = self._marked
        return found

    def _content(self, number: int) -> float:
        """The moment that the state of that number is about."""
        return self.since + number * self.pace - self._first_lag

    def _wanted(self, quality: Quality) -> float:
        """The lag, in whole paces, that lets the next detection be waited for, which is rarer where many are lost."""
        rare = (quality.period or self.pace) / (1.0 - min(quality.lost, 0.75))
        return self._first_lag + math.ceil(max(1.25 * rare - self.pace, 0.0) / self.pace - 0.5) * self.pace

    # --- taking in -------------------------------------------------------------------------------------------------

    def _mark(self, t: float) -> None:
        for person in self._people.values():
            person.way.mark(t)
        present = self._present(t)
        for thing in self._things.values():
            x, y, _, _ = thing.hand
            name = nearest(x, y, present)
            if name is not None:
                thing.update(t, self._people[name].near(name), None, 1.0, (1.0, 1.0))
            elif thing.carried > QUIET:  # else it is as at the moment before
                thing.update(t, None, None, 1.0, (1.0, 1.0))

    def _sense(self, world: WorldState, noise: float) -> None:
        t, variance, objects, agents = world.t, noise * noise, world.objects, world.agents
        for name, agent in agents.items():
            person = self._people.get(name)
            if person is None:
                person = self._people[name] = Person()
            person.sense(t, agent, variance, name == self.own)
        holder = {agent.holding: name for name, agent in agents.items() if agent.holding is not None}
        present, if_carried = self._present(t), told_if_carried(noise)
        self.jumps = []
        for name, thing in self._things.items():
            seen = objects.get(name)
            x, y = (seen.x, seen.y) if seen is not None else thing.hand[:2]
            by = holder.get(name) or nearest(x, y, present)
            if by is None and thing.lies(t, seen, variance):
                continue
            near = None if by is None else self._people[by].near(by)
            told = told_of_hand(if_carried, name in holder, seen is not None and by in agents)
            if thing.update(t, near, seen, variance, told):
                self.jumps.append(name)
        for name, new in objects.items():
            if name not in self._things:
                self._things[name] = Handling(t, new, variance, 0.5 if name in holder else 0.02)

    def _present(self, t: float) -> list[Present]:
        """Who was seen not long ago, and where they are."""
        return [
            (name, *person.way.nodes[-1][1:3])
            for name, person in self._people.items()
            if t - person.looks[-1][0] <= self.bridge
        ]

    # --- telling ---------------------------------------------------------------------------------------------------

    def _tell(self) -> WorldState:
        moment = self._content(self._told)
        objects: dict[str, ObjectState] = {}
        held: dict[str, tuple[float, str | None]] = {}
        for name, thing in self._things.items():
            found = thing.at(moment)
            if found is None or self._absences.is_gone(name):
                continue
            share, objects[name], by = found
            if by is not None and share > held.get(by, (0.0, None))[0]:
                held[by] = share, name if share > HOLDS else None
        agents, weights = {}, dict[float, float]()
        for name, person in self._people.items():
            share, holding = held.get(name, (0.0, None))
            if name == self.own:
                state = person.as_sensed(moment, self.bridge, holding)
            else:
                grasp = evidence_of(share, self._noise)
                state = person.at(moment, self.bridge, self._noise, weights, grasp, holding)
            if state is not None:
                agents[name] = state
        return WorldState(moment + self.lag, agents, objects)


def nearest(x: float, y: float, present: Iterable[Present]) -> str | None:
    """Who may have something in the hand that is there (metres): the nearest within reach."""
    best, found = REACH, None
    for name, own_x, own_y in present:
        if -best < own_x - x < best:
            gap = math.hypot(own_x - x, own_y - y)
            if gap < best:
                best, found = gap, name
    return found
