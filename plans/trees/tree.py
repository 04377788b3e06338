"""Plan trees as networkx graphs, and their text form.

A tree is a ``networkx.DiGraph`` whose nodes are numbered in pre-order, the root being 0, with edges from a task to
what it is done by. Every node has the attributes

    term     the goal, task or action with its parameters, as text
    name     its functor
    kind     "goal", "task" or "action"
    leaf     the number of the action among the plan's leaves, from 0 (None for a goal or task)
    status   "observed", "missed" or "unobserved"; a task is observed (missed) when all its leaves are, else unobserved;
             a leaf that was passed over and is no part of the plan is "skipped", one that may still be done instead of
             what stands for its choice an "alternative"
    optional whether it may be left out
    by       who does it, as text, where the plan says so; None elsewhere
    rival    the number, from 0, of the alternative that the node is the first of; None for all others

Conditions have no node. Shapes have none of their own: what stands in them hangs from their task, in an order that
they allow. These are the paper's conventions: filled, textured and dashed nodes (figure "score").
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import count
from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import Bindings, substitute
from casper.plans.trees.nodes import Action, Condition, Node, Shape, Task

if TYPE_CHECKING:
    import networkx as nx

Status: TypeAlias = Literal["observed", "missed", "unobserved", "skipped", "alternative"]
MARKS: dict[str, str] = {"observed": "●", "missed": "✗", "unobserved": "○", "skipped": "–", "alternative": "◌"}


class Rooted(Protocol):
    """What a tree is made of: a plan (`casper.plans.trees.plan`)."""

    @property
    def root(self) -> Task:
        """The goal with what it is done by."""

    @property
    def leaves(self) -> Sequence[Compound]:
        """The actions in order."""


def statuses(leaves: int, marks: Iterable[int]) -> tuple[Status, ...]:
    """The status of every leaf when the marked ones were observed: what lies left of the last one was missed."""
    observed = set(marks)
    last = max(observed, default=-1)
    return tuple(
        "observed" if at in observed else "missed" if at < last else "unobserved" for at in range(leaves)
    )


def plan_tree(plan: Rooted, status: Sequence[Status] | None = None, bindings: Bindings | None = None) -> nx.DiGraph:
    """The plan as a networkx tree, marked, with parameters replaced by their values where known."""
    import networkx as nx

    marked = list(status) if status is not None else ["unobserved"] * len(plan.leaves)
    tree: nx.DiGraph = nx.DiGraph()
    numbers, leaf_numbers = count(), count()

    def add(node: Node, optional: bool, rival: int | None = None) -> list[int]:
        if isinstance(node, Condition):
            return []
        if isinstance(node, Shape):
            is_choice, found = node.kind == "choice", list[int]()
            for at, child in enumerate(node.children):
                first = at or rival or 0 if is_choice else None if at else rival
                found += add(child, optional or is_choice or node.kind == "optional", first)
            return found
        number = next(numbers)
        text = term_text(as_term(substitute(node.term, bindings or {})))
        common = {"term": text, "name": node.term.functor, "optional": optional, "rival": rival}
        if isinstance(node, Action):
            leaf = next(leaf_numbers)
            by = None if node.by is None else term_text(substitute(node.by, bindings or {}))
            tree.add_node(number, **common, kind="action", leaf=leaf, status=marked[leaf], by=by)
            return [number]
        kind = "goal" if number == 0 else "task"
        tree.add_node(number, **common, kind=kind, leaf=None, status="unobserved", by=None)
        children = [below for child in node.children for below in add(child, optional)]
        tree.add_edges_from((number, child) for child in children)
        tree.nodes[number]["status"] = _shared(tree.nodes[child]["status"] for child in children)
        return [number]

    add(plan.root, False)
    return tree


def _shared(statuses: Iterable[Status]) -> Status:
    """What a task is, by what its leaves are; those that are no part of the plan do not count where others are."""
    below = set(statuses)
    counted = below - {"skipped", "alternative"} or below
    return counted.pop() if len(counted) == 1 else "unobserved"


def tree_text(tree: nx.DiGraph) -> str:
    """The tree as indented text: ● observed, ✗ missed, ○ unobserved, – skipped, ◌ alternative; rivals with "or"."""
    import networkx as nx

    shown = nx.DiGraph()
    for number, data in tree.nodes(data=True):
        mark = MARKS[data["status"]] if data["kind"] == "action" else ""
        rival = "or " if data["rival"] else ""
        by = f" by {data['by']}" if data.get("by") is not None else ""
        shown.add_node(number, label=f"{mark} {rival}{data['term']}{by}".strip())
    shown.add_edges_from(tree.edges)
    return "\n".join(nx.generate_network_text(shown, sources=[0]))
