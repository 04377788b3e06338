"""Prices learned from recorded days: what is read into them is counted, and counted again with what was learned.

A record is a file of JSON lines, one observation each: ``{"action": "eat(biscuits, plate)"}``, with ``t``, ``agent``
and ``goal`` (the label of the goal it serves, null where it serves none) as far as they are known. A file is a day.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from casper.engine.episodes.day import Day
from casper.engine.episodes.episode import Episode
from casper.engine.episodes.prices import SECTION, Prices
from casper.engine.verification.observation import options_of
from casper.kb.errors import CasperError, DomainError, Place
from casper.kb.text.files import read_utf8

ROUNDS = 3
STRENGTH = 10.0  # as many observations the prices at the start count for
LEAST, MOST = 1e-4, 0.5  # what a price can come to


@dataclass(frozen=True, slots=True)
class Recorded:
    """An observation of a recorded day; ``goals`` are those it is known to serve: none at all, or None for unknown."""

    action: str
    t: float | None = None
    agent: str | None = None
    goals: tuple[str, ...] | None = None
    place: Place = field(default=Place())


@dataclass(frozen=True)
class Learned:
    """Prices, and how many days, observations and episodes they come from."""

    prices: Prices
    days: int
    observations: int
    episodes: int

    def to_text(self) -> str:
        """The prices as facts for ``plans.pl``."""
        priced = ((each.name, getattr(self.prices, each.name)) for each in fields(Prices))
        return "".join(f"setting({SECTION}, {name}, {price:.4g}).\n" for name, price in priced)


def read_day(file: Path) -> list[Recorded]:
    """The observations of one file.

    Raises:
        DomainError: it cannot be read, or a line is no observation (with its place).
    """
    found = []
    for number, line in enumerate(read_utf8(file).splitlines(), 1):
        if line.strip():
            found.append(_recorded(line, Place(str(file), number)))
    return found


def _recorded(line: str, place: Place) -> Recorded:
    try:
        told: Any = json.loads(line)
    except ValueError as mistake:
        raise DomainError(f"this is no JSON: {mistake}", place) from None
    if not isinstance(told, dict) or not isinstance(told.get("action"), str):
        raise DomainError('an observation is an object such as {"action": "eat(biscuits, plate)"}', place)
    goal, agent, t = told.get("goal"), told.get("agent"), told.get("t")
    if not isinstance(goal, (str, type(None))) or not isinstance(agent, (str, type(None))):
        raise DomainError("goal and agent of an observation are names, or null", place)
    if t is not None and (isinstance(t, bool) or not isinstance(t, (int, float))):
        raise DomainError("t of an observation is a number of seconds", place)
    goals = None if "goal" not in told else () if goal is None else (goal,)
    return Recorded(told["action"], None if t is None else float(t), agent, goals, place)


def learn(make: Callable[[Prices], Day[Any]], days: Sequence[Sequence[Recorded]], start: Prices) -> Learned:
    """Prices from recorded days, by counting what the likeliest reading of them holds, a few times over.

    Each price is a relative frequency, to which the one at the start counts for `STRENGTH` observations.

    Args:
        make: a fresh day with these prices.
        days: what was recorded.
        start: the prices to begin with.

    Raises:
        CasperError: nothing was recorded, or something is no action, or a goal is none.
    """
    if not any(days):
        raise DomainError("there is nothing to learn from: the records hold no observation")
    prices, episodes = start, 0
    for _ in range(ROUNDS):
        counts = _Counts()
        for day in days:
            counts.add(*_read(make(prices), day))
        prices, episodes = counts.prices(start), counts.episodes
    return Learned(prices, len(days), sum(map(len, days)), episodes)


def _read(
    day: Day[Any], recorded: Iterable[Recorded]
) -> tuple[list[Episode], list[Episode], list[str | None], list[Any]]:
    """The episodes that closed in a day and those it cut off, and of each observation who did it and what was seen."""
    agents, seen, told = list[str | None](), list[Any](), list[Episode]()
    for one in recorded:
        try:
            day.observe(one.action, one.t, one.agent, one.goals)
        except CasperError as mistake:
            raise type(mistake)(mistake.sentence, one.place) from None
        agents.append(one.agent)
        seen.append(day.observations[-1])
        told += day.closed()
    day.finish()
    return told, day.closed(), agents, seen


class _Counts:
    """How often something happened, and how often it could have."""

    def __init__(self) -> None:
        self.episodes = 0
        self._counted: dict[str, list[float]] = {each.name: [0.0, 0.0] for each in fields(Prices)}
        self._things: dict[Any, int] = {}

    def add(
        self,
        closed: Sequence[Episode],
        cut_off: Sequence[Episode],
        agents: Sequence[str | None],
        seen: Sequence[Any],
    ) -> None:
        """Count a day. Whether what it cut off would have been given up is not known."""
        episodes = [*closed, *cut_off]
        self.episodes += len(episodes)
        served = {number for episode in episodes for number in episode.observations}
        self._count("needless", len(seen) - len(served), len(served))
        self._count("abandon", sum(e.outcome == "abandoned" for e in closed), len(closed))
        observed, missed = sum(e.observed for e in episodes), sum(e.missed for e in episodes)
        self._count("missed", missed, observed)
        spans = [(e.observations[0], e.observations[-1]) for e in episodes]
        begins = [first for first, _ in spans if any(a < first < b for a, b in spans)]
        self._count("begin", len(begins), sum(any(a < at <= b for a, b in spans) for at in range(1, len(seen) + 1)))
        whose = [(e.agent, agents[number - 1]) for e in episodes for number in e.observations]
        self._count("helping", sum(owner != agent for owner, agent in whose), len(whose))
        for argument in _arguments(seen):
            self._things[argument] = self._things.get(argument, 0) + 1

    def _count(self, name: str, happened: float, possible: float) -> None:
        self._counted[name][0] += happened
        self._counted[name][1] += possible

    def prices(self, start: Prices) -> Prices:
        """The relative frequencies, and for things the chance that two of them are the same."""
        whole = sum(self._things.values())
        if whole:
            self._counted["settled"] = [sum(n * n for n in self._things.values()) / whole, float(whole)]
        found = {}
        for name, (happened, possible) in self._counted.items():
            price = (happened + STRENGTH * getattr(start, name)) / (possible + STRENGTH)
            found[name] = min(max(price, LEAST), MOST)
        return Prices(**found)


def _arguments(seen: Iterable[Any]) -> Iterator[Any]:
    for one in seen:
        for option, _ in options_of(one)[:1]:
            yield from option.args or ()
