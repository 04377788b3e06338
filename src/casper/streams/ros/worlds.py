"""World states at an even pace, out of frames and detections that come as they come."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import floor, inf

from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.streams.ros.frames import Frames, Pose
from casper.streams.ros.messages import Detected, Placed, Told
from casper.streams.ros.names import Names

WAITS = 0.5  # seconds for which the transforms around a moment are waited for
SEEN = 0.5  # seconds for which what was detected is in view
HELD = 0.12  # metres from a hand within which a thing is held
AHEAD = 60.0  # seconds that a stamp may be ahead of those before
MOST = 10_000  # detections that wait
KINDS = 200  # kinds of things left out, and names, that are told
BOUNDS = 10_000  # moments without anything that are told one by one; behind a longer gap it goes on at its end


class Worlds:
    """Takes in what messages say, gives out world states.

    Args:
        names: what frames and classes are called.
        period: seconds from one world state to the next.

    Attributes:
        start: the time (seconds) from which the states' times count; None before the first. counts: what was left
        out, by what there is to say about it.
    """

    def __init__(self, names: Names, period: float) -> None:
        self.names, self.period = names, period
        self.frames = Frames()
        self.fixed = names.fixed
        self.start: float | None = None
        self.counts: Counter[str] = Counter()
        self.nameless: set[str] = set()
        self.met: set[str] = set()
        self._newest: float | None = None
        self._doubted: float | None = None  # a stamp far ahead
        self._next = 0
        self._waiting: list[Detected] = []
        self._seen: dict[str, tuple[float, bool, float, Pose]] = {}  # when, agent?, how sure, where
        self._counted: dict[str, tuple[float, int]] = {}  # of several of a kind: when they were seen last, and how many

    def take(self, said: Told) -> Iterator[WorldState]:
        """What a message said; the world states that are complete by now."""
        if isinstance(said, Placed) and said.is_static:
            self.frames.add(said.t, said.parent, said.frame, said.pose, is_static=True)
            return
        if self._newest is not None and said.t > self._newest + AHEAD and not self._is_usual(said.t):
            return
        self._newest = said.t if self._newest is None else max(self._newest, said.t)
        if isinstance(said, Placed):
            if not self.frames.add(said.t, said.parent, said.frame, said.pose):
                self.count(f"transform of {said.frame} is older than the one before it, or one too many")
        elif len(self._waiting) < MOST:
            self._waiting.append(said)
        yield from self._due(self._newest - WAITS)

    def count(self, what: str) -> None:
        """Something was left out once more."""
        if what in self.counts or len(self.counts) < KINDS:
            self.counts[what] += 1
        else:
            self.counts["other things are left out"] += 1

    def rest(self) -> Iterator[WorldState]:
        """The file is over."""
        if self._newest is not None:
            yield from self._due(self._newest)

    def _is_usual(self, t: float) -> bool:
        """A time far ahead is believed when the next one is there, too."""
        doubted, self._doubted = self._doubted, t
        if doubted is not None and abs(t - doubted) <= AHEAD:
            return True
        self.count("stamp is far ahead of those around it")
        return False

    def _due(self, until: float) -> Iterator[WorldState]:
        if self.start is None:
            if self._newest is None:
                return
            self.start = self._newest
        if until - self._moment(self._next) > BOUNDS * self.period:
            self._next = floor((until - self.start) / self.period)
        while (t := self._moment(self._next)) <= until:
            world = self._at(t, round(self._next * self.period, 9))
            self._next += 1
            if world is not None:
                yield world

    def _moment(self, number: int) -> float:
        assert self.start is not None
        return self.start + number * self.period

    def _at(self, t: float, told: float) -> WorldState | None:
        """The world at a moment, as at the time that is told; None: nobody and nothing is in it."""
        if self.fixed is None:
            self.fixed = self._root()
            if self.fixed is None:
                return None
        self._place_detections(t)
        agents: dict[str, Pose] = {}
        objects: dict[str, Pose] = {}
        for table, found in ((self.names.agents, agents), (self.names.objects, objects)):
            for frame, name in table.items():
                pose = self._pose(frame, t)
                if pose is not None:
                    found[name] = pose
        for name, (when, is_agent, _, pose) in self._seen.items():
            if t - when <= SEEN:
                (agents if is_agent else objects).setdefault(name, pose)
        self.met |= agents.keys() | objects.keys()
        if not agents and not objects:
            return None
        return WorldState(
            told,
            {name: AgentState(p.x, p.y, p.heading, self._holds(name, objects, t)) for name, p in agents.items()},
            {name: ObjectState(p.x, p.y, p.z) for name, p in objects.items()},
        )

    def _root(self) -> str | None:
        """The root above somebody; else that in which something was detected."""
        for frame in (*self.names.agents, *self.names.objects, *(said.frame for said in self._waiting)):
            if frame in self.frames:
                return self.frames.above(frame)[-1]
        return next((said.frame for said in self._waiting), None)

    def _pose(self, frame: str, t: float) -> Pose | None:
        assert self.fixed is not None
        if frame not in self.frames and frame != self.fixed:
            return None
        pose = self.frames.pose(frame, self.fixed, t)
        if pose is None:
            self.count(f"moment without a transform from {frame} to {self.fixed}")
        return pose

    def _place_detections(self, t: float) -> None:
        """Those up to a moment, where they were in the fixed frame; of several of one name the surest."""
        waiting, self._waiting = self._waiting, []
        for said in waiting:
            if said.t > t:
                self._waiting.append(said)
                continue
            kind = self.names.of_several(said.identifier, said.label)
            if kind is None:
                named = self.names.of_detection(said.identifier, said.label)
            elif (number := self._number(kind, said.t)) is None:
                continue
            else:
                named = f"{kind}_{number}", False
            if named is None:
                if len(self.nameless) < KINDS:
                    self.nameless.add(said.identifier or said.label)
                continue
            assert self.fixed is not None
            name, is_agent = named
            frame = self.frames.pose(said.frame, self.fixed, said.t)
            if frame is None:
                self.count(f"detection without a transform from {said.frame} to {self.fixed}")
                continue
            before = self._seen.get(name)
            if before is not None and before[0] == said.t:
                self.count(f"detection of {name} beside another at the same time; the surest is taken")
                if before[2] >= said.score:
                    continue
            if before is None or before[0] <= said.t:
                self._seen[name] = said.t, is_agent, said.score, frame.of(said.pose)

    def _number(self, kind: str, t: float) -> int | None:
        """The number of one more of a kind at a time, those of before being out of view; None where it is late."""
        newest, count = self._counted.get(kind, (-inf, 0))
        if t < newest:
            self.count(f"detection of one more {kind} is older than those before it")
            return None
        if t > newest:
            self._seen = {name: was for name, was in self._seen.items() if name.rpartition("_")[0] != kind}
            self.met.add(kind)
            count = 0
        self._counted[kind] = t, count + 1
        return count + 1

    def _holds(self, agent: str, objects: dict[str, Pose], t: float) -> str | None:
        """What hangs on the agent's frames, or is where a hand is."""
        own = {frame for frame, name in self.names.agents.items() if name == agent}
        hands = [frame for frame, name in self.names.hands.items() if name == agent]
        for frame, name in self.names.objects.items():
            if name in objects and not own.union(hands).isdisjoint(self.frames.above(frame)[1:]):
                return name
        places = [pose for hand in hands if (pose := self._pose(hand, t)) is not None]
        near = [(place.gap(pose), name) for place in places for name, pose in objects.items()]
        gap, name = min(near, default=(HELD + 1.0, ""))
        return name if gap <= HELD else None
