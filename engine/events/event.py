"""Events: every hand-over in the mind, as frozen data that can be logged, replayed and shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from casper.engine.events.entries import NAMES, Names
from casper.engine.events.printing import event_lines
from casper.engine.events.records import setters
from casper.kb.text.lines import Line, Shown, one_line, text_of

TYPES = (
    "focus",
    "movement",
    "action",
    "verdict",
    "reading",
    "prediction",
    "plan",
    "says",
    "withdrawn",
    "robot",
    "episode",
    "warning",
    "summary",
)


@dataclass(frozen=True, slots=True, init=False)
class Event(Shown):
    """One thing that happened: its type (one of `TYPES`), when (seconds), and what."""

    type: str
    t: float
    data: Mapping[str, Any] = field(default_factory=dict)

    def __init__(self, type: str, t: float, data: Mapping[str, Any] | None = None) -> None:
        _type(self, type)
        _t(self, t)
        _data(self, {} if data is None else data)

    def about(self, agent: str) -> Event:
        """The event, naming whose doing it is about; one that names another agent names this one as its partner."""
        named = self.data.get("agent", agent)
        settled = named == agent or "partner" in self.data or "by" in self.data
        return Event(self.type, self.t, {"agent": named, **({} if settled else {"partner": agent}), **self.data})

    def to_json(self) -> dict[str, Any]:
        """The design's object: ``{"type": …, "t": …, **data}``."""
        return {"type": self.type, "t": self.t, **self.data}

    def lines(self, names: Names = NAMES) -> Iterator[Line]:
        """What a person is shown."""
        return event_lines(self.type, self.t, self.data, names)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Event {self.type} at {self.t:g} s")


_type, _t, _data = setters(Event)
