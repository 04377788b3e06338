"""Episodes as they are told: a goal, whose it was, what became of it, and which observations belong to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from casper.engine.episodes.hypotheses.hypothesis import Outcome
from casper.engine.verification.observation import Seen
from casper.engine.verification.vocabulary import Foreign
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Span, line, lines_of, one_line, text_of
from casper.plans.trees.tree import tree_text

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class Episode:
    """A goal from its first observation to its last.

    ``goal`` is the goal's label and ``term`` the goal with its parameters as far as they are known, ``outcome`` None
    while it is open, ``start`` and ``end`` the times of its first and last observation, ``observed`` and ``missed`` how
    many of its leaves were seen and went unseen (in a finished one also those at the end), ``left`` the fewest that are
    still to be done, ``observations`` the numbers of its observations, from 1, since the day began.
    """

    goal: str
    agent: str | None
    outcome: Outcome | None
    start: float
    end: float
    observed: int
    missed: int
    observations: tuple[int, ...]
    term: Compound
    left: int = 0
    draw: Callable[[], nx.DiGraph] | None = field(default=None, compare=False, repr=False)

    def tree(self) -> nx.DiGraph:
        """The marked plan tree (attributes: `casper.plans.trees.tree`)."""
        assert self.draw is not None, "this episode came without its tree"
        return self.draw()

    def to_json(self) -> dict[str, Any]:
        """``{"goal", "agent", "outcome", "from", "to", "observed", "missed", "observations", "leaves"}``."""
        told: dict[str, Any] = {
            "goal": self.goal,
            "term": term_text(as_term(self.term)),
            "agent": self.agent,
            "outcome": self.outcome,
            "from": self.start,
            "to": self.end,
            "observed": self.observed,
            "missed": self.missed,
            "observations": list(self.observations),
        }
        return told if self.draw is None else {**told, "leaves": self.leaves()}

    def leaves(self) -> list[dict[str, str]]:
        """The actions of its plan, each with its status; none where the tree is lacking."""
        if self.draw is None:
            return []
        nodes = [data for _, data in self.tree().nodes(data=True) if data["kind"] == "action"]
        in_order = sorted(nodes, key=lambda data: int(data["leaf"]))
        return [{"action": data["term"], "status": data["status"]} for data in in_order]

    def lines(self) -> Iterator[Line]:
        """What became of it, and the marked tree."""
        yield line(Span(self._told(), "strong"))
        if self.draw is not None:
            yield from lines_of(tree_text(self.tree()))

    def _told(self) -> str:
        whose = f" of {self.agent}" if self.agent is not None else ""
        missed = f", {self.missed} missed" if self.missed else ""
        steps = f"{self.observed} seen{missed}"
        return f"{self.goal}{whose}: {self.outcome or 'under way'} ({steps}, {self.start:g} to {self.end:g})"

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Episode {self._told()}")


@dataclass(frozen=True)
class Needless:
    """An observation that serves no goal.

    ``foreign`` says why no plan has the action, or has it with these arguments, and what comes nearest.
    """

    number: int
    seen: Seen
    agent: str | None
    t: float
    foreign: Foreign | None = None

    def to_json(self) -> dict[str, Any]:
        """``{"observation", "action", "agent", "t"}``, with ``reasons`` and ``nearest`` where no plan has it."""
        told: dict[str, Any] = {
            "observation": self.number,
            "action": str(self.seen),
            "agent": self.agent,
            "t": self.t,
        }
        if self.foreign is None:
            return told
        return {**told, "reasons": list(self.foreign.reasons), "nearest": self.foreign.nearest}

    def __str__(self) -> str:
        return str(self.seen) if self.foreign is None else f"{self.seen} ({self.foreign})"


@dataclass(frozen=True)
class Account:
    """One explanation of a day: a row of episodes, by when they ended, the open ones last; and what was needless.

    ``share`` is its part of the weight of all hypotheses; ``share_best`` that of this one way to come there.
    """

    episodes: tuple[Episode, ...]
    needless: tuple[Needless, ...]
    share: float
    share_best: float

    @property
    def goals(self) -> tuple[str, ...]:
        """The goals of its episodes, in their order."""
        return tuple(episode.goal for episode in self.episodes)

    def to_json(self) -> dict[str, Any]:
        """An entry of ``best`` as a reading has it, the leaves of all episodes in a row, with ``episodes``."""
        return {
            "goal": row(self.episodes),
            "goals": list(self.goals),
            "share": self.share,
            "score": self.share_best,
            "leaves": [leaf for episode in self.episodes for leaf in episode.leaves()],
            "episodes": [episode.to_json() for episode in self.episodes],
            "needless": [needless.to_json() for needless in self.needless],
        }

    def lines(self) -> Iterator[Line]:
        """The share, the episodes with their trees, and what was needless."""
        yield line(Span(f"share {self.share:.2f}", "faint"))
        for episode in self.episodes:
            yield from episode.lines()
        if self.needless:
            yield line(f"needless: {', '.join(map(str, self.needless))}")

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        row = ", ".join(f"{e.goal} ({e.outcome or 'under way'})" for e in self.episodes)
        return one_line(f"Account {self.share:.2f}: {row or 'nothing'}")


def row(episodes: Sequence[Episode]) -> str:
    """The goals in a row: ``breakfast, drink``."""
    return ", ".join(episode.goal for episode in episodes)
