"""Several partners in one world: each has a mind of its own, over one tracker, one history and one robot."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.domain.partners.agents import is_known
from casper.engine.events import Event
from casper.engine.live.memory import Uninterrupted
from casper.engine.mind import Mind
from casper.engine.perception.told import jumps
from casper.engine.perception.tracking import Tracker
from casper.engine.perception.world import WorldState
from casper.engine.reading.course import Course
from casper.kb.terms.terms import Compound
from casper.kb.text.lines import Line, one_line, text_of

MOST_STRANGERS = 100  # who are told of


class Partners:
    """The minds for all partners of a domain who come into view.

    Args:
        domain: where it happens; `Domain.partners` are those who are watched.
        choices: as for `Mind`, but its ``partner`` and ``history``.

    Raises:
        DomainError, CasperError: as `Mind`.
    """

    def __init__(self, domain: Domain, **choices: Any) -> None:
        self.domain, self.choices = domain, choices
        self.first = Mind(domain, **choices)
        self.minds: dict[str, Mind] = {self.first.partner: self.first}
        self.strangers: set[str] = set()  # who were told of

    @property
    def tracker(self) -> Tracker:
        """What steadies the world for all of them."""
        return self.first.tracker

    def update(self, world: WorldState) -> list[Event]:
        """Take in one world state; the events of every partner in view, each naming whom it is about.

        Raises:
            WorldStateError, CasperError: as `Mind.update`.
        """
        with Uninterrupted():
            tracker = self.first.tracker
            steady = tracker.steps(world)
            events = jumps(tracker, world.t)
            for state in steady:
                events += self._noticed(state)
            return events

    def _noticed(self, tracked: WorldState) -> list[Event]:
        events = [*self._met(tracked)]
        for mind in self.minds.values():
            events += mind.notice(tracked)
        return events

    def did(self, action: Compound, t: float) -> list[Event]:
        """The robot has done an action of somebody's part (without the agent)."""
        return self._owner(action).did(action, t)

    def failed(self, action: Compound, t: float) -> list[Event]:
        """The robot could not do an action of somebody's part."""
        return self._owner(action).failed(action, t)

    def end(self, t: float) -> list[Event]:
        """Nobody watches any more."""
        return [event for mind in self.minds.values() for event in mind.end(t)]

    def summary(self, goal: str | None = None, seed: int | None = None) -> dict[str, Any]:
        """The data of a ``summary`` event: the first partner's figures, and every episode of all partners in order."""
        told = self.first.summary(goal, seed)
        if len(self.minds) > 1:
            rows = (row for mind in self.minds.values() for row in mind.course.rows)
            told["episodes"] = sorted(rows, key=lambda row: (row["to"], row["from"]))
        return told

    def lines(self) -> Iterator[Line]:
        """What a person is shown: mind after mind."""
        return (line for mind in self.minds.values() for line in mind.lines())

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Partners in {self.domain.name}: {', '.join(self.minds)}")

    def add(self, mind: Mind) -> None:
        """Another partner, who shares the world with the others."""
        mind.tracker, mind.memories = self.first.tracker, self.first.memories
        self.minds[mind.partner] = mind
        for each in self.minds.values():
            each.course.others = lambda own=each: self._others(own)  # type: ignore[misc]

    def _others(self, own: Mind) -> list[Course]:
        return [mind.course for mind in self.minds.values() if mind is not own]

    def _met(self, world: WorldState) -> Iterator[Event]:
        """Those who are in view for the first time get a mind; of those whom the domain does not know it is told."""
        for name in world.agents:
            if name in self.minds or name == self.domain.robot:
                continue
            if name in self.domain.partners:
                self.add(Mind(self.domain, **self.choices, partner=name, history=self.first.history))
            elif name not in self.strangers and len(self.strangers) < MOST_STRANGERS:
                self.strangers.add(name)
                if not is_known(self.domain.kb, name):
                    told = f"{name} is in view and nobody the domain knows, so nothing {name} does is read"
                    advice = f"state human({name}) in ontology.pl to have it read"
                    yield Event("warning", world.t, {"agent": name, "message": f"{told}; {advice}"})

    def _owner(self, action: Compound) -> Mind:
        """Whose part has the action to be done, the first partner when it is nobody's."""
        owners = (m for m in self.minds.values() if any(action in s.left for s in m.course.supervisors))
        return next(owners, self.first)
