"""Where one observation leads from one goal instance: every state it may be in takes it in every way it can."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any, Generic, NamedTuple, TypeVar

from casper.engine.episodes.growing import Growing, Step
from casper.engine.episodes.hypotheses.hypothesis import Body, Entry, Event, Instance, Link
from casper.engine.episodes.prices import Prices
from casper.engine.settings import require

S = TypeVar("S")
SAME = 1e-12  # by how much shares differ that are equal but for rounding
_FACTOR: Callable[[list[Any]], float] = itemgetter(1)


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much is kept.

    keep: the heaviest hypotheses, none below ``floor`` of the heaviest one's weight. entries: what one instance may
    be, none below ``least`` of its likeliest one. tries: how many states of instances one observation is tried on; the
    lightest hypotheses are dropped for it. lag: for how many observations what was seen and what closed is kept. undo:
    how many observations can be taken back.
    """

    keep: int = 300
    floor: float = 1e-4
    entries: int = 300
    least: float = 1e-3
    tries: int = 4000
    lag: int = 100
    undo: int = 20

    def __post_init__(self) -> None:
        least = min(self.keep, self.entries, self.tries, self.lag, self.undo)
        require(least >= 1, "keep, entries, tries, lag and undo of a day start at 1")
        require(0 <= self.floor < 1 and 0 <= self.least < 1, "floor and least of a day are from 0 and below 1")


class Finish(NamedTuple, Generic[S]):
    """A body that is finished by a step: its goal, the factor, the likeliest step and which entry took it."""

    goal: int
    factor: float
    step: Step[S]
    source: int


class Growth(Generic[S]):
    """A body after an observation.

    ``body`` (None: none is left open) has the factor ``whole``, each of ``finished`` its own. ``goals`` are the
    factors by goal, ``dropped`` is the factor of what was too unlikely to be kept. How instances of the old body come
    to it is worked out for those only that are kept (`Grower.instance`): ``ways`` are, by entry of the new one, the
    likeliest step and which entry of the old one took it.
    """

    __slots__ = ("body", "dropped", "finished", "goals", "ways", "whole")

    def __init__(
        self,
        body: Body[S] | None,
        whole: float,
        finished: list[Finish[S]],
        goals: dict[int, float],
        dropped: float,
        ways: Sequence[tuple[Step[S], int]],
    ) -> None:
        self.body, self.whole, self.finished, self.goals = body, whole, finished, goals
        self.dropped, self.ways = dropped, ways


class Grower(Generic[S]):
    """Grows bodies by one observation, each once; equal ones are made once.

    ``tried`` counts the states that were asked to take the observation.
    """

    def __init__(self, growing: Growing[S], prices: Prices, bounds: Bounds, event: Event) -> None:
        self._growing, self._prices, self._bounds, self._event = growing, prices, bounds, event
        self._grown: dict[Body[S], Growth[S] | None] = {}
        self._bodies: dict[Any, list[Body[S]]] = {}
        self._instances: dict[tuple[Instance[S] | None, Growth[S]], Instance[S]] = {}
        self.tried = 0

    def grown(self, body: Body[S]) -> Growth[S] | None:
        """The body after the observation; None where it cannot take it."""
        if body not in self._grown:
            self.tried += len(body.entries)
            helping = 1.0 if body.owner == self._event.agent else self._prices.helping
            self._grown[body] = self._made(self._steps(body.entries, helping), body.owner, body.touched)
        return self._grown[body]

    def begun(self, priors: list[float]) -> Growth[S] | None:
        """A goal that begins with the observation; None where none can."""
        return self._made(self._first_steps(priors), self._event.agent, 0)

    def instance(self, before: Instance[S] | None, growth: Growth[S]) -> Instance[S]:
        """The instance (None: one that begins) that has grown."""
        assert growth.body is not None
        key = before, growth
        known = self._instances.get(key)
        if known is None:
            event, links = self._event, None if before is None else before.links
            ways = growth.ways
            made = [Link(event, step, None if links is None else links[source]) for step, source in ways]
            known = self._instances[key] = Instance(growth.body, tuple(made))
        return known

    def link(self, before: Instance[S] | None, finish: Finish[S]) -> Link[S]:
        """How the instance came to be finished."""
        return Link(self._event, finish.step, None if before is None else before.links[finish.source])

    def _first_steps(self, priors: list[float]) -> Iterator[tuple[int, float, Step[S], int]]:
        growing, seen, agent = self._growing, self._event.seen, self._event.agent
        for goal in self._allowed(growing.begins_with(seen)):
            state = growing.begin(goal)
            steps = growing.steps(state, seen, agent)
            if steps:
                share = priors[goal] / max(1, growing.choices(state))
                for step in steps:
                    yield goal, share, step, 0

    def _allowed(self, goals: Iterable[int]) -> Iterable[int]:
        only = self._event.only
        return goals if only is None else [goal for goal in goals if goal in only]

    def _steps(self, entries: Iterable[Entry[S]], helping: float) -> Iterator[tuple[int, float, Step[S], int]]:
        asked, choices = self._growing.steps, self._growing.choices
        seen, agent, only = self._event.seen, self._event.agent, self._event.only
        for source, (goal, state, share) in enumerate(entries):
            if only is not None and goal not in only:
                continue
            steps = asked(state, seen, agent)
            if steps:
                each = share / max(1, choices(state))
                for step in steps:
                    yield goal, each if step.is_theirs else each * helping, step, source

    def _made(
        self, steps: Iterable[tuple[int, float, Step[S], int]], owner: str | None, touched: int
    ) -> Growth[S] | None:
        missed, settled = self._prices.missed, self._prices.settled
        found: dict[S, list[Any]] = {}  # goal, factor, the largest part of it, its step and the entry that took it
        for goal, share, step, source in steps:
            state, skipped, _, weight, _, fresh, part = step
            factor = share * weight * missed**skipped * settled**fresh * part
            known = found.get(state)
            if known is None:
                found[state] = [goal, factor, factor, step, source]
            else:
                known[1] += factor
                if factor > known[2]:
                    known[2:] = factor, step, source
        return self._split(found, owner, touched) if found else None

    def _split(self, found: dict[S, list[Any]], owner: str | None, touched: int) -> Growth[S]:
        """What is finished, and what goes on."""
        growing = self._growing
        goals: dict[int, float] = {}
        finished: dict[int, Finish[S]] = {}
        going: list[list[Any]] = []
        for state, made in found.items():
            goal, factor = made[0], made[1]
            goals[goal] = goals.get(goal, 0.0) + factor
            if growing.is_done(state) and not growing.choices(state):
                finished[goal] = _likelier(finished.get(goal), Finish(goal, factor, made[3], made[4]))
            else:
                going.append(made)
        going.sort(key=_FACTOR, reverse=True)
        kept = going[: self._bounds.entries]
        least = going[0][1] * self._bounds.least if going else 0.0
        while kept and kept[-1][1] < least:
            kept.pop()
        whole = sum(map(_FACTOR, kept))
        dropped = sum(map(_FACTOR, going[len(kept) :]))
        body = self._body(kept, whole, owner, touched) if kept else None
        ways = [(made[3], made[4]) for made in kept]
        return Growth(body, whole, list(finished.values()), goals, dropped, ways)

    def _body(self, kept: list[list[Any]], whole: float, owner: str | None, touched: int) -> Body[S]:
        now = self._event.own_number if owner == self._event.agent else touched
        entries = tuple([Entry(made[0], made[3].state, made[1] / whole) for made in kept])
        alike = self._bodies.setdefault((owner, now, len(entries), entries[0].state), [])
        for body in alike:
            if _are_equal(body.entries, entries):
                return body
        is_done = self._growing.is_done
        alike.append(Body(entries, owner, now, all([is_done(entry.state) for entry in entries])))
        return alike[-1]


def _likelier(known: Finish[S] | None, found: Finish[S]) -> Finish[S]:
    """Both together, told as the likelier one."""
    if known is None:
        return found
    return (known if known.factor >= found.factor else found)._replace(factor=known.factor + found.factor)


def _are_equal(some: Sequence[Entry[S]], others: Sequence[Entry[S]]) -> bool:
    """Whether they are the same states as likely, but for rounding."""
    return all(
        abs(one.share - other.share) <= SAME and one.state == other.state for one, other in zip(some, others)
    )
