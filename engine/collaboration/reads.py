"""What a supervisor asks of a reading."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.events.telling import Telling
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.verification.observation import Seen


class Reads(Protocol):
    """What a supervisor asks of a reading (`engine.reading.reading`)."""

    @property
    def outcome(self) -> str | None:
        """The goal that is committed to."""

    @property
    def observations(self) -> Sequence[Seen]:
        """What was observed."""

    @property
    def tell(self) -> Telling:
        """What tells goals in the author's words."""

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's share of all scores."""

    @property
    def first(self) -> Explanation | Interleaved | None:
        """The best explanation."""

    def best_of(self, goal: str, /) -> Explanation | Interleaved | None:
        """The best explanation of a goal."""

    def plan_for(self, agent: str, explanation: Explanation | Interleaved, /) -> CollaborativePlan | None:
        """The agent's part in it."""

    def plans_for(self, agent: str, /) -> Mapping[CollaborativePlan, float]:
        """The probability of each part of the agent."""

    def next_part(
        self, agent: str, explanation: Explanation | Interleaved, done: CollaborativePlan, /
    ) -> CollaborativePlan | None:
        """The agent's part in what comes after one that it has done."""
