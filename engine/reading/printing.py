"""How a reading is shown to a person: shares as bars, the best explanations as marked trees, what to ask."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

from casper.engine.events.shares import heading, shares_lines
from casper.engine.events.telling import Telling
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.questions import Question
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.lines import Line, Span, line, one_line


class Reads(Protocol):
    """What is printed of a reading (`engine.reading.reading`)."""

    @property
    def observations(self) -> Sequence[object]:
        """What was observed, in order."""

    @property
    def count(self) -> int:
        """The number of explanations."""

    @property
    def is_exact(self) -> bool:
        """Whether every explanation was counted."""

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's share."""

    @property
    def outcome(self) -> str | None:
        """The goal that the policy commits to."""

    @property
    def rejected(self) -> Mapping[str, Sequence[str]]:
        """The goals that explain nothing any more, with the reasons."""

    @property
    def unknown(self) -> Mapping[int, object]:
        """Observations that no plan has, by number from 0, and why."""

    @property
    def tell(self) -> Telling:
        """What tells goals and steps in the author's words."""

    def best(self, count: int, /) -> list[Explanation | Interleaved]:
        """The best few explanations."""

    def questions(self) -> list[Question]:
        """What to find out, most telling first."""


def reading_lines(reading: Reads, top: int = 3, asked: int = 0) -> Iterator[Line]:
    """What was observed, how many explanations it has, each goal's share, the outcome, and the best explanations.

    Args:
        reading: what is shown.
        top: how many explanations are shown as trees.
        asked: how many questions.
    """
    best = reading.best(max(top, 1))
    yield heading(reading.observations)
    yield line(f"{_count(reading)}, confidence {best[0].share if best else 0.0:.2f}")
    for at, foreign in reading.unknown.items():
        yield line(f"needless: {reading.observations[at]} ({foreign})")
    yield from shares_lines(reading.posterior, reading.rejected)
    yield line("outcome: ", Span(reading.outcome, "outcome") if reading.outcome else "undecided")
    for explanation in best[:top]:
        yield from explanation.lines(reading.observations)
    tell = reading.tell
    if best and best[0].frontier:
        steps = (tell.step(term_text(as_term(action))) for action in best[0].frontier)
        yield line(tell.phrase("yet to come", ", ".join(steps)))
    for question in reading.questions()[:asked] if asked else ():
        yield line(
            f"{tell.phrase('ask', question)} ", Span(f"({question.gain:.2f} bits, yes {question.yes:.2f})", "faint")
        )


def reading_name(reading: Reads) -> str:
    """One line that tells it from others: ``<Reading of 2 observations: lunch 1.00>``."""
    seen = len(reading.observations)
    told = f"Reading of {seen} observation{'' if seen == 1 else 's'}"
    if not seen:
        return one_line(told)
    first = sorted(reading.posterior.items(), key=lambda pair: -pair[1])[:3]
    likeliest = [f"{goal} {share:.2f}" for goal, share in first if share > 0]
    return one_line(f"{told}: {', '.join(likeliest) or 'no explanation'}")


def shares_text(reading: Reads) -> str:
    """Every goal's share and the outcome: ``breakfast 0.53, lunch 0.47; outcome: undecided``."""
    shares = ", ".join(f"{goal} {share:.2f}" for goal, share in reading.posterior.items())
    return f"{shares}; outcome: {reading.outcome or 'undecided'}"


def rejected_text(rejected: Mapping[str, Sequence[str]]) -> str:
    """Why each goal explains nothing any more: ``drink: drink has no eat; lunch: …``."""
    return "; ".join(f"{goal}: {', '.join(reasons)}" for goal, reasons in rejected.items())


def _count(reading: Reads) -> str:
    least = "" if reading.is_exact else "at least "
    return f"{least}{reading.count} explanation{'' if reading.count == 1 else 's'}"
