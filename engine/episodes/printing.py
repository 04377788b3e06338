"""How a day is shown to a person: what was seen, how likely each goal is pursued, and the row of episodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

from casper.engine.episodes.episode import Account, Episode, Needless
from casper.engine.events.shares import heading, shares_lines
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Span, line, one_line


class Lives(Protocol):
    """What is printed of a day (`engine.episodes.day`)."""

    @property
    def observations(self) -> Sequence[object]:
        """What was observed lately, in order."""

    @property
    def count(self) -> int:
        """How many observations there were."""

    @property
    def states(self) -> int:
        """How many hypotheses are kept."""

    @property
    def is_exact(self) -> bool:
        """Whether nothing was dropped lately."""

    @property
    def left_out(self) -> float:
        """The share of the weight that was dropped lately."""

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being pursued."""

    @property
    def leading(self) -> str | None:
        """What the last action most likely belongs to."""

    @property
    def current(self) -> Mapping[str, float]:
        """Each goal's probability that the last action belongs to it."""

    @property
    def rejected(self) -> Mapping[str, Sequence[str]]:
        """Why a goal that is neither open nor begins with the last action does not take it."""

    @property
    def needless(self) -> Sequence[Needless]:
        """What served no goal lately."""

    @property
    def frontier(self) -> Sequence[Compound]:
        """What is yet to be done."""

    @property
    def episodes(self) -> Sequence[Episode]:
        """The episodes of the best hypothesis."""

    def best(self, count: int, /) -> Sequence[Account]:
        """The heaviest hypotheses."""


def day_lines(day: Lives, top: int = 1) -> Iterator[Line]:
    """What was observed, each goal's probability, what the last action belongs to, and the best rows of episodes."""
    yield heading(day.observations)
    kept = "" if day.is_exact else f", {day.left_out:.2g} of the weight left out"
    yield line(f"{day.states} hypothes{'is' if day.states == 1 else 'es'}{kept}")
    yield from shares_lines(day.posterior, _refused(day))
    yield line("last action: ", Span(day.leading, "outcome") if day.leading else "needless or undecided")
    for account in day.best(max(top, 0)):
        yield from account.lines()
    if day.frontier:
        yield line(f"yet to come: {', '.join(term_text(as_term(action)) for action in day.frontier)}")


def _refused(day: Lives) -> Mapping[str, Sequence[str]]:
    """Why no goal takes the last action, where the plans have it and none does."""
    is_told = any(each.foreign and each.number == day.count for each in day.needless)
    return {} if is_told or any(day.current.values()) else day.rejected


def day_name(day: Lives) -> str:
    """One line: ``<Day of 9 observations: breakfast finished, lunch under way>``."""
    told = f"Day of {day.count} observation{'' if day.count == 1 else 's'}"
    row = ", ".join(f"{episode.goal} {episode.outcome or 'under way'}" for episode in day.episodes)
    return one_line(f"{told}: {row}" if row else told)
