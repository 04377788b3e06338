"""Explanations: one interpretation of the observations, as frozen data that can draw itself as a marked tree."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from casper.engine.matching import Binding, bindings_of
from casper.kb.terms import Compound, as_term, substitute
from casper.kb.writer import term_text
from casper.plans.plan import Plan
from casper.plans.tree import Status, plan_tree, statuses

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class Explanation:
    """A plan with the leaves that were observed.

    ``score`` is the paper's; ``share`` this explanation's part of the sum of all scores (the best one's share is the
    *confidence*; a goal's shares add up to its *posterior*).
    """

    plan: Plan
    marks: tuple[int, ...]
    binding: Binding
    score: float
    share: float

    @property
    def goal(self) -> str:
        """The goal's label."""
        return self.plan.label

    @cached_property
    def leaves(self) -> tuple[Compound, ...]:
        """The plan's actions with what is known of their parameters."""
        known = bindings_of(self.plan, self.binding) if self.binding else {}
        return tuple(substitute(leaf, known) for leaf in self.plan.leaves)

    @cached_property
    def status(self) -> tuple[Status, ...]:
        """The status of every leaf."""
        return statuses(len(self.plan.leaves), self.marks)

    @property
    def missed(self) -> int:
        """How many leaves were missed."""
        return self.status.count("missed")

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """The ordered unobserved leaves: what is yet to be done (paper section III-G)."""
        last = max(self.marks, default=-1)
        return self.leaves[last + 1 :]

    def tree(self) -> nx.DiGraph:
        """The marked tree (attributes: `casper.plans.tree`)."""
        known = bindings_of(self.plan, self.binding) if self.binding else {}
        return plan_tree(self.plan, self.status, known)

    def to_json(self) -> dict[str, Any]:
        """The design's entry of ``best``."""
        pairs = zip(self.leaves, self.status)
        leaves = [{"action": term_text(as_term(leaf)), "status": status} for leaf, status in pairs]
        return {"goal": self.goal, "share": self.share, "score": self.score, "leaves": leaves}
