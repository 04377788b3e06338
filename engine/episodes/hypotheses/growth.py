"""Where one observation leads from one goal instance: every state it may be in takes it in every way it can."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from operator import itemgetter
from typing import Any, Generic, NamedTuple, TypeVar

from casper.engine.episodes.growing import Growing, Step
from casper.engine.episodes.hypotheses.hypothesis import Body, Entry, Event, Instance, Link
from casper.engine.episodes.prices import Prices
from casper.engine.settings import require

S = TypeVar("S")
_FACTOR: Callable[[list[Any]], float] = itemgetter(1)


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much is kept.

    keep: the heaviest hypotheses, none below ``floor`` of the heaviest one's weight. entries: what one instance may
    be, none below ``least`` of its likeliest one. lag: for how many observations what was believed and what closed is
    kept.
    """

    keep: int = 100
    floor: float = 1e-4
    entries: int = 300
    least: float = 1e-3
    lag: int = 100

    def __post_init__(self) -> None:
        require(min(self.keep, self.entries, self.lag) >= 1, "keep, entries and lag of a day start at 1")
        require(0 <= self.floor < 1 and 0 <= self.least < 1, "floor and least of a day are from 0 and below 1")


class Finish(NamedTuple, Generic[S]):
    """An instance that is finished by a step: its goal, the factor, and how it came there."""

    goal: int
    factor: float
    link: Link[S]


class Growth(Generic[S]):
    """An instance after an observation.

    ``instance`` (None: none is left open) has the factor ``whole``, each of ``finished`` its own. ``goals`` are the
    factors by goal, ``dropped`` is the factor of what was too unlikely to be kept.
    """

    __slots__ = ("dropped", "finished", "goals", "instance", "whole")

    def __init__(
        self,
        instance: Instance[S] | None,
        whole: float,
        finished: list[Finish[S]],
        goals: dict[int, float],
        dropped: float,
    ) -> None:
        self.instance, self.whole, self.finished, self.goals, self.dropped = instance, whole, finished, goals, dropped


class Grower(Generic[S]):
    """Grows instances by one observation; equal bodies are made once."""

    def __init__(self, growing: Growing[S], prices: Prices, bounds: Bounds, event: Event) -> None:
        self._growing, self._prices, self._bounds, self._event = growing, prices, bounds, event
        self._grown: dict[Instance[S], Growth[S] | None] = {}
        self._bodies: dict[Any, Body[S]] = {}

    def grown(self, instance: Instance[S]) -> Growth[S] | None:
        """The instance after the observation; None where it cannot take it."""
        if instance not in self._grown:
            body = instance.body
            helping = 1.0 if body.owner == self._event.agent else self._prices.helping
            sources = zip(body.entries, instance.links)
            self._grown[instance] = self._made(self._steps(sources, helping), body.owner, body.touched)
        return self._grown[instance]

    def begun(self, priors: list[float]) -> Growth[S] | None:
        """A goal that begins with the observation; None where none can."""
        return self._made(self._first_steps(priors), self._event.agent, 0)

    def _first_steps(self, priors: list[float]) -> Iterator[tuple[int, float, Step[S], Link[S] | None]]:
        growing, seen, agent = self._growing, self._event.seen, self._event.agent
        for goal in self._allowed(growing.begins_with(seen)):
            state = growing.begin(goal)
            steps = growing.steps(state, seen, agent)
            if steps:
                share = priors[goal] / max(1, growing.choices(state))
                for step in steps:
                    yield goal, share, step, None

    def _allowed(self, goals: Iterable[int]) -> Iterable[int]:
        only = self._event.only
        return goals if only is None else [goal for goal in goals if goal in only]

    def _steps(
        self, sources: Iterable[tuple[Entry[S], Link[S]]], helping: float
    ) -> Iterator[tuple[int, float, Step[S], Link[S] | None]]:
        growing, seen, agent = self._growing, self._event.seen, self._event.agent
        only = self._event.only
        for (goal, state, share), link in sources:
            if only is not None and goal not in only:
                continue
            steps = growing.steps(state, seen, agent)
            if steps:
                each = share / max(1, growing.choices(state))
                for step in steps:
                    yield goal, each if step.is_theirs else each * helping, step, link

    def _made(
        self, steps: Iterable[tuple[int, float, Step[S], Link[S] | None]], owner: str | None, touched: int
    ) -> Growth[S] | None:
        missed, settled = self._prices.missed, self._prices.settled
        found: dict[S, list[Any]] = {}  # goal, factor, the largest part of it, its step and the link before
        for goal, share, step, before in steps:
            state, skipped, _, weight, _, fresh = step
            factor = share * weight * missed**skipped * settled**fresh
            known = found.get(state)
            if known is None:
                found[state] = [goal, factor, factor, step, before]
            else:
                known[1] += factor
                if factor > known[2]:
                    known[2:] = factor, step, before
        return self._split(found, owner, touched) if found else None

    def _split(self, found: dict[S, list[Any]], owner: str | None, touched: int) -> Growth[S]:
        """What is finished, and what goes on."""
        growing, event = self._growing, self._event
        goals: dict[int, float] = {}
        finished: dict[int, Finish[S]] = {}
        going: list[list[Any]] = []
        for state, made in found.items():
            goal, factor = made[0], made[1]
            goals[goal] = goals.get(goal, 0.0) + factor
            if growing.is_done(state) and not growing.choices(state):
                known = finished.get(goal)
                link = Link(event, made[3], made[4])
                better = known.link if known is not None and known.factor >= factor else link
                finished[goal] = Finish(goal, factor + (known.factor if known is not None else 0.0), better)
            else:
                going.append(made)
        going.sort(key=_FACTOR, reverse=True)
        kept = going[: self._bounds.entries]
        least = going[0][1] * self._bounds.least if going else 0.0
        while kept and kept[-1][1] < least:
            kept.pop()
        whole = sum(map(_FACTOR, kept))
        dropped = sum(map(_FACTOR, going[len(kept) :]))
        instance = self._instance(kept, whole, owner, touched) if kept else None
        return Growth(instance, whole, list(finished.values()), goals, dropped)

    def _instance(
        self, kept: list[list[Any]], whole: float, owner: str | None, touched: int
    ) -> Instance[S]:
        event = self._event
        now = event.own_number if owner == event.agent else touched
        entries = tuple([Entry(made[0], made[3].state, made[1] / whole) for made in kept])
        key = (owner, now, *[(state, round(share, 12)) for _, state, share in entries])
        body = self._bodies.get(key)
        if body is None:
            body = self._bodies[key] = Body(entries, owner, now, all(self._growing.is_done(e.state) for e in entries))
        return Instance(body, tuple([Link(event, made[3], made[4]) for made in kept]))
