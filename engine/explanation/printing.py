"""How an explanation is shown to a person: its score and share, and a marked tree for each goal pursued."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Protocol

from casper.kb.text.lines import Line, Span, line, lines_of, one_line
from casper.plans.trees.tree import tree_text

if TYPE_CHECKING:
    import networkx as nx


class Drawn(Protocol):
    """One goal pursued."""

    def tree(self) -> nx.DiGraph:
        """The marked tree."""


class Explains(Protocol):
    """What is printed of an explanation (`engine.explanation.explanation`)."""

    @property
    def goal(self) -> str:
        """What is pursued, as one label."""

    @property
    def parts(self) -> Sequence[Drawn]:
        """The goals pursued."""

    @property
    def marks(self) -> Sequence[int]:
        """The observed leaves."""

    @property
    def missed(self) -> int:
        """How many leaves were missed."""

    @property
    def score(self) -> float:
        """The paper's score."""

    @property
    def share(self) -> float:
        """Its part of the sum of all scores."""

    @property
    def needless(self) -> Sequence[int]:
        """The numbers, from 0, of observations that are no part of it."""


def explanation_lines(explanation: Explains, observations: Sequence[object] = ()) -> Iterator[Line]:
    """Score and share, the trees, and what was needless: by number (from 1) where the observations are not given."""
    yield line(Span(f"score {explanation.score:.3f}, share {explanation.share:.2f}", "faint"))
    for part in explanation.parts:
        yield from lines_of(tree_text(part.tree()))
    if explanation.needless:
        named = [str(observations[at]) if observations else f"observation {at + 1}" for at in explanation.needless]
        yield line(f"needless: {', '.join(named)}")


def explanation_name(explanation: Explains) -> str:
    """One line that tells it from others."""
    steps = f"{len(explanation.marks)} seen, {explanation.missed} missed"
    weight = f"score {explanation.score:.3f}, share {explanation.share:.2f}"
    return one_line(f"Explanation by {explanation.goal}: {steps}, {weight}")
