"""Algorithm 1 of the paper, word for word: the executable specification of what explanations there are.

It copies a whole marked tree for every explanation, so it is slow; the kernel `counting` must give the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from casper.engine.verification.binding import Binding
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan
from casper.plans.trees.tree import plan_tree

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class MarkedTree:
    """One explanation: a copy of a plan's tree, marked; which plan it is of; what is known of its parameters."""

    plan: int
    tree: nx.DiGraph
    binding: Binding

    @property
    def leaf_nodes(self) -> list[int]:
        """The terminal nodes from left to right."""
        return [node for node, data in sorted(self.tree.nodes(data=True)) if data["kind"] == "action"]

    def with_status(self, status: str) -> list[int]:
        """The numbers of the leaves that have the status."""
        return [i for i, node in enumerate(self.leaf_nodes) if self.tree.nodes[node]["status"] == status]

    @property
    def score(self) -> float:
        """observed * (1 - missed), as shares of the terminal nodes (paper equation "score")."""
        leaves = len(self.leaf_nodes)
        observed, missed = len(self.with_status("observed")), len(self.with_status("missed"))
        return observed * (leaves - missed) / (leaves * leaves)


def explanations(plans: Sequence[Plan], observations: Iterable[Observation], matcher: Matcher) -> list[MarkedTree]:
    """Every explanation of the observations, ordered by score, then by plan, then by the marked leaves."""
    trees = []
    for number, plan in enumerate(plans):
        binding = matcher.initial(number)
        if not isinstance(binding, Mismatch):
            trees.append(MarkedTree(number, plan_tree(plan), binding))
    for observation in observations:
        copies: list[MarkedTree] = []
        while trees:
            tree = trees.pop()
            copies.extend(_mark_everywhere(tree, observation, matcher))
        matcher.observed(observation)
        trees = copies
    return sorted(trees, key=lambda t: (-t.score, t.plan, t.with_status("observed")))


def _mark_everywhere(explanation: MarkedTree, observation: Observation, matcher: Matcher) -> Iterable[MarkedTree]:
    """A copy for every unobserved leaf that the observation can be."""
    leaves = explanation.leaf_nodes
    for at, node in enumerate(leaves):
        data = explanation.tree.nodes[node]
        if data["status"] != "unobserved" or data["name"] != observation.action:
            continue
        binding = matcher.match(explanation.plan, at, observation, explanation.binding)
        if isinstance(binding, Mismatch):
            continue
        copy = explanation.tree.copy()
        copy.nodes[node]["status"] = "observed"
        for left in leaves[:at]:
            if copy.nodes[left]["status"] == "unobserved":
                copy.nodes[left]["status"] = "missed"
        yield MarkedTree(explanation.plan, copy, binding)
