"""What was recorded of a run, as frozen data: nothing here knows of pages.

Lengths are metres, times seconds, angles radians; x points east, y north.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.engine.events.event import Event
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.perception.world import WorldState
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.says import SILENT, Words
from casper.kb.reasons.why_not import Refusal

Box: TypeAlias = tuple[float, float, float, float]
"""Least x and y, greatest x and y."""


@dataclass(frozen=True, slots=True)
class Room:
    """A room from above: the corners of its walls, furniture by name, and the radius of each thing."""

    outline: tuple[tuple[float, float], ...] = ()
    furniture: Mapping[str, Box] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    fixed: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Evidence:
    """What stood behind an event when it happened.

    Of a ``verdict``: the proof of a valid statement, or the refusal of one that is none. Of a ``reading``: its best
    explanations.
    """

    proof: Proof | Doubt | None = None
    refusal: Refusal | None = None
    explanations: tuple[Explanation | Interleaved, ...] = ()


NO_EVIDENCE = Evidence()


@dataclass(frozen=True, slots=True)
class Recording:
    """A run from its beginning to its end, or to where it was broken off.

    ``events`` are those of the run, in order; ``evidence`` is by their number. ``states`` ascend in time. ``left_out``
    says by type how many events a long run had besides.
    """

    domain: str
    partners: tuple[str, ...]
    robot: str
    events: tuple[Event, ...]
    states: tuple[WorldState, ...] = ()
    evidence: Mapping[int, Evidence] = field(default_factory=dict)
    room: Room = Room()
    words: Words = SILENT
    left_out: Mapping[str, int] = field(default_factory=dict)

    @property
    def span(self) -> tuple[float, float]:
        """The first and the last time (seconds)."""
        times = [*(event.t for event in self.events), *(state.t for state in self.states)]
        return (min(times), max(times)) if times else (0.0, 0.0)

    @property
    def summary(self) -> Event | None:
        """How it ended; None where it was broken off."""
        last = self.events[-1] if self.events else None
        return last if last is not None and last.type == "summary" else None

    def of_type(self, *types: str) -> list[Event]:
        """Those of these types."""
        return [event for event in self.events if event.type in types]
