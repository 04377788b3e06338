"""World states of a poor sensor made steady: filtered, and told at an even pace, a little later.

What is told at a time is the world as it was ``lag`` seconds before, in the light of what was seen since. Agents stand
or walk, things rest or are carried; which of both is decided by likelihoods. Who is not seen for long is absent.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.engine.perception.filters.absence import Absences
from casper.engine.perception.filters.handling import QUIET, Handling, Near
from casper.engine.perception.filters.quality import Quality
from casper.engine.perception.filters.walking import Motion, Way
from casper.engine.perception.world import AgentState, Doubt, ObjectState, WorldState

REACH = 1.1  # metres from an agent within which things are taken, carried and put down
SLOWEST, SURE = 0.12, 0.3  # m/s: below it nobody walks, above it everybody does
CREEP = 0.03  # metres a step by which the place of one who stands is mended
HOLDS = 0.3  # the share from which something is in the hand: in the middle of a use it is there for a moment only
LEAST_NOISE = 0.01  # metres
PAUSE = 60.0  # seconds without a world state after which nothing more is told until the next
STRIDE = 0.4  # m/s, standard deviation along an axis of how fast walkers go
STEADIER = 0.25  # share of its variance with which a speed is really off, of who stands
SLACK = 1.0  # of the noise, by which what is within a band seems beyond it all along: means settle slowly
AVERAGED = 3  # steps that somebody stands through which are as good as one
IF_NEAR = 0.06  # how often what rests near somebody is told to be in the hand
LOOKS = 0.3  # seconds around a moment whose headings count
AROUND = 8 * LOOKS  # what is farther away counts for nothing


Look: TypeAlias = tuple[float, float, float]
"""When a heading was sensed, its sine and its cosine."""
Present: TypeAlias = tuple[str, float, float]
"""Somebody's name and where they are, x and y in metres."""


@dataclass
class _Person:
    """What is kept of one agent: the way, what was sensed of heading by time, and what was told last.

    ``poses`` are what was sensed by time, of the one who looks alone.
    """

    way: Way = field(default_factory=Way)
    looks: deque[Look] = field(default_factory=lambda: deque(maxlen=400))
    poses: deque[tuple[float, AgentState]] = field(default_factory=lambda: deque(maxlen=400))
    told: AgentState | None = None
    stood: int = 0
    middle: tuple[float, float] = (0.0, 0.0)

    last: tuple[Motion, Near] | None = None

    def near(self, name: str) -> Near:
        """Where somebody is, and how fast they go if they do; kept until there is more to know."""
        motion = self.way.nodes[-1]
        if self.last is None or self.last[0] is not motion:
            walks = motion.pace > _walks_from(motion)
            speed = (motion.vx, motion.vy) if walks else (0.0, 0.0)
            self.last = motion, Near(name, motion.x, motion.y, *speed)
        return self.last[1]


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
        self._people: dict[str, _Person] = {}
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
                person = self._people[name] = _Person()
            person.way.seen(t, agent.x, agent.y, variance)
            person.looks.append((t, math.sin(agent.heading), math.cos(agent.heading)))
            if name == self.own:
                person.poses.append((t, agent))
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
        agents, looks = {}, dict[float, float]()
        for name, person in self._people.items():
            share, holding = held.get(name, (0.0, None))
            if name == self.own:
                state = self._as_sensed(person, moment, holding)
            else:
                state = self._agent(person, moment, looks, share, holding)
            if state is not None:
                agents[name] = state
        return WorldState(moment + self.lag, agents, objects)

    def _agent(
        self, person: _Person, moment: float, looks: dict[float, float], share: float, holding: str | None
    ) -> AgentState | None:
        motion = person.way.at(moment)
        if motion is None or not self._is_known(person, moment):
            person.told, person.stood = None, 0
            return None
        x, y = motion.x, motion.y
        if motion.pace > _walks_from(motion) or (person.stood and _left(person, motion)):
            person.stood = 0
        else:
            x, y = self._stands(person, x, y)
        spread = math.sqrt(motion.place / max(person.stood / AVERAGED, 1.0))
        doubt = Doubt(_evidence(share, self._noise), _walks(motion), spread, SLACK * self._noise)
        person.told = AgentState(x, y, _heading(person, moment, looks), holding, doubt)
        return person.told

    def _as_sensed(self, person: _Person, moment: float, holding: str | None) -> AgentState | None:
        """Where the one who looks was last at a moment."""
        for t, pose in reversed(person.poses):
            if t <= moment:
                here = AgentState(pose.x, pose.y, pose.heading, holding)
                return here if moment - t <= self.bridge else None
        return None

    def _is_known(self, person: _Person, moment: float) -> bool:
        """Seen not long before, or at both ends of a gap."""
        before, after = -math.inf, math.inf
        for t, _, _ in reversed(person.looks):
            if t <= moment:
                before = t
                break
            after = t
        return moment - before <= self.bridge or after - before <= 2 * self.bridge

    def _stands(self, person: _Person, x: float, y: float) -> tuple[float, float]:
        """The mean of where it was since it stands; it is brought there slowly, so that it does not seem to walk."""
        person.stood = n = person.stood + 1
        mx, my = person.middle if n > 1 else (x, y)
        mx, my = mx + (x - mx) / n, my + (y - my) / n
        person.middle = mx, my
        if person.told is None or n == 1:
            return mx, my
        dx, dy = mx - person.told.x, my - person.told.y
        gap = math.hypot(dx, dy)
        share = 1.0 if gap <= CREEP else CREEP / gap
        return person.told.x + dx * share, person.told.y + dy * share


def nearest(x: float, y: float, present: Iterable[Present]) -> str | None:
    """Who may have something in the hand that is there (metres): the nearest within reach."""
    best, found = REACH, None
    for name, own_x, own_y in present:
        if -best < own_x - x < best:
            gap = math.hypot(own_x - x, own_y - y)
            if gap < best:
                best, found = gap, name
    return found


def _evidence(share: float, noise: float) -> float:
    """What speaks for it that a hand holds something.

    The less the hands are told of, the likelier one that is near something is free, and the more a small share says.
    """
    usual = min(max(0.5 * told_if_carried(noise), 0.12), 0.5)
    held, free = share / usual, (1.0 - share) / (1.0 - usual)
    return held / (held + free)


def _left(person: _Person, motion: Motion) -> bool:
    """Whether somebody is no longer where they were thought to stand."""
    gap = math.hypot(motion.x - person.middle[0], motion.y - person.middle[1])
    return gap > max(3 * math.sqrt(motion.place), 0.15)


def _walks_from(motion: Motion) -> float:
    """m/s above which somebody walks: more than chance would have it."""
    return min(max(2.5 * math.sqrt(motion.speed), SLOWEST), SURE)


def _walks(motion: Motion) -> float:
    """The probability that somebody walks who seems that fast; speeds, and errors of who stands, are normal."""
    still = STEADIER * motion.speed
    moving = still + STRIDE * STRIDE
    odds = still / moving * math.exp(min(0.5 * motion.pace**2 * (1.0 / still - 1.0 / moving), 50.0))
    return odds / (1.0 + odds)


def told_of_hand(if_carried: float, is_held: bool, is_telling: bool) -> tuple[float, float]:
    """How likely what is told of the hands is when a thing rests and when it is carried.

    A hand is told by how near the thing seems to be, so the more noise the less it says (`told_if_carried`).

    Args:
        if_carried: how often what is in a hand is told to be so.
        is_held: whether somebody is told to hold it.
        is_telling: whether it is seen, and near somebody who is seen.
    """
    if is_held:
        return IF_NEAR, if_carried
    return (1 - IF_NEAR, 1 - if_carried) if is_telling else (1.0, 1.0)


def told_if_carried(noise: float) -> float:
    """How often what is in a hand is told to be so, by how near both seem to be."""
    return max(0.95 * math.exp(-((noise / 0.05) ** 2)), 0.07)


def _heading(person: _Person, moment: float, weights: dict[float, float]) -> float:
    """The mean of the headings around a moment; ``weights`` are those of each time, kept for the next person."""
    s, c, first = 0.0, 0.0, moment - AROUND
    for t, sine, cosine in reversed(person.looks):
        if t < first and (s or c):
            break
        weight = weights.get(t)
        if weight is None:
            weight = weights[t] = math.exp(-abs(t - moment) / LOOKS)
        s, c = s + weight * sine, c + weight * cosine
    return math.atan2(s, c)
