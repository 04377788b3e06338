"""Explanations: one interpretation of the observations, as frozen data that can draw itself as a marked tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from casper.engine.explanation.printing import explanation_lines, explanation_name
from casper.engine.explanation.situation import Situation
from casper.engine.verification.binding import Binding, bindings_of
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Shown, text_of
from casper.plans.trees.plan import Plan
from casper.plans.trees.tree import Status, plan_tree

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class Explanation(Shown):
    """A plan with the leaves that were observed, in the order of the observations.

    ``score`` is the paper's; ``share`` this explanation's part of the sum of all scores (the best one's share is the
    *confidence*; a goal's shares add up to its *posterior*). ``needless`` are the numbers, from 0, of the observations
    that are no part of the plan.
    """

    plan: Plan
    marks: tuple[int, ...]
    binding: Binding
    score: float
    share: float
    needless: tuple[int, ...] = ()

    @property
    def goal(self) -> str:
        """The goal's label."""
        return self.plan.label

    @property
    def goals(self) -> tuple[str, ...]:
        """The goals pursued: one."""
        return (self.plan.label,)

    @property
    def parts(self) -> tuple[Explanation, ...]:
        """The goals pursued, each with its own marks: one."""
        return (self,)

    @cached_property
    def situation(self) -> Situation:
        """Where the plan stands by this explanation."""
        closed, belonging = self._reached
        return Situation(self.plan, closed, self.binding, closed & belonging)

    @property
    def leaves(self) -> tuple[Compound, ...]:
        """The plan's actions with what is known of their parameters."""
        return self.situation.leaves

    @cached_property
    def _reached(self) -> tuple[int, int]:
        """Masks of the closed leaves, and of those that belong to the plan by now."""
        chart = self.plan.chart
        progress, entered = chart.start, 0
        for leaf in self.marks:
            progress = chart.close(progress, leaf)
            entered |= chart.inside[leaf]
        return progress[0], chart.belonging(entered)

    @cached_property
    def status(self) -> tuple[Status, ...]:
        """The status of every leaf (`casper.plans.trees.tree`)."""
        closed, belonging = self._reached
        coming = set(self.open_leaves)
        return tuple(
            "observed" if leaf in self.marks
            else "missed" if closed & belonging & 1 << leaf
            else "skipped" if closed >> leaf & 1
            else "unobserved" if leaf in coming
            else "alternative"
            for leaf in range(len(self.plan.leaves))
        )  # fmt: skip

    @property
    def open_leaves(self) -> tuple[int, ...]:
        """The numbers of the leaves that are yet to be done (`Situation.open_leaves`)."""
        return self.situation.open_leaves

    @property
    def missed(self) -> int:
        """How many leaves were missed."""
        return self.status.count("missed")

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """The ordered unobserved leaves: what is yet to be done (paper section III-G)."""
        return self.situation.frontier

    def tree(self) -> nx.DiGraph:
        """The marked tree (attributes: `casper.plans.trees.tree`)."""
        known = bindings_of(self.plan, self.binding) if self.binding else {}
        return plan_tree(self.plan, self.status, known)

    def to_json(self) -> dict[str, Any]:
        """The design's entry of ``best``."""
        pairs = zip(self.leaves, self.status)
        leaves = [{"action": term_text(as_term(leaf)), "status": status} for leaf, status in pairs]
        told = {"goal": self.goal, "share": self.share, "score": self.score, "leaves": leaves}
        return {**told, "needless": [at + 1 for at in self.needless]} if self.needless else told

    def lines(self, observations: Sequence[object] = ()) -> Iterator[Line]:
        """Score, share and the marked tree; needless observations by their numbers, or as what they were."""
        return explanation_lines(self, observations)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return explanation_name(self)


@dataclass(frozen=True)
class Interleaved(Shown):
    """Several goals pursued at once: one explanation for each, which together take every observation but the needless.

    ``score`` is the paper's, over the leaves of all of them.
    """

    parts: tuple[Explanation, ...]
    score: float
    share: float
    needless: tuple[int, ...] = ()

    @property
    def goals(self) -> tuple[str, ...]:
        """The labels of the goals, in the order of the library."""
        return tuple(part.goal for part in self.parts)

    @property
    def goal(self) -> str:
        """The goals as one label."""
        return " + ".join(self.goals)

    @property
    def marks(self) -> tuple[int, ...]:
        """The observed leaves, numbered through all the parts."""
        return tuple(offset + leaf for offset, part in self._offsets() for leaf in part.marks)

    @property
    def open_leaves(self) -> tuple[int, ...]:
        """The leaves that are yet to be done, numbered through all the parts."""
        return tuple(offset + leaf for offset, part in self._offsets() for leaf in part.open_leaves)

    def _offsets(self) -> list[tuple[int, Explanation]]:
        offsets = [sum(len(part.leaves) for part in self.parts[:at]) for at in range(len(self.parts))]
        return list(zip(offsets, self.parts))

    @property
    def leaves(self) -> tuple[Compound, ...]:
        """The actions of all the plans, one plan after the other."""
        return tuple(leaf for part in self.parts for leaf in part.leaves)

    @property
    def status(self) -> tuple[Status, ...]:
        """The status of every leaf."""
        return tuple(status for part in self.parts for status in part.status)

    @property
    def missed(self) -> int:
        """How many leaves were missed."""
        return sum(part.missed for part in self.parts)

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """What is yet to be done, one plan after the other."""
        return tuple(leaf for part in self.parts for leaf in part.frontier)

    def to_json(self) -> dict[str, Any]:
        """The design's entry of ``best``, with the goals pursued."""
        pairs = zip(self.leaves, self.status)
        leaves = [{"action": term_text(as_term(leaf)), "status": status} for leaf, status in pairs]
        told = {"goal": self.goal, "goals": list(self.goals), "share": self.share, "score": self.score}
        return {**told, "leaves": leaves, **({"needless": [at + 1 for at in self.needless]} if self.needless else {})}

    def lines(self, observations: Sequence[object] = ()) -> Iterator[Line]:
        """As `Explanation.lines`, with a tree for each goal."""
        return explanation_lines(self, observations)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return explanation_name(self)
