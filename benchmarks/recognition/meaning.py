"""What the shapes of a plan mean for its leaves, read off the tree: for pairs of leaves, and for sets of observed ones.

Two leaves part at the lowest node that both stand under, and only there it is decided whether one comes before the
other or rules it out. Sets of leaves are integers (bit j = leaf j). Nothing here is shared with `plans.trees.chart`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from itertools import count
from operator import or_
from typing import TypeAlias

from casper.plans.trees.nodes import Action, Node, Shape
from casper.plans.trees.plan import Plan

Leaves: TypeAlias = int
Path: TypeAlias = tuple[tuple[Node, int], ...]  # down to a leaf: each node with the number of the child taken


@dataclass(frozen=True)
class Branch:
    """A node with its leaves; ``default`` are those that belong to the plan as long as none of them was observed.

    A branch ``is_fixed`` when all its leaves belong whatever is observed: no part of it is optional or a choice.
    """

    children: tuple[Branch, ...]
    leaves: Leaves
    default: Leaves
    is_choice: bool
    is_fixed: bool

    def belonging(self, marked: Leaves) -> Leaves:
        """The leaves that belong to the plan once these were observed."""
        if self.is_fixed or not self.leaves & marked:
            return self.default
        if self.is_choice:
            (chosen,) = (child for child in self.children if child.leaves & marked)
            return chosen.belonging(marked)
        return union(child.belonging(marked) for child in self.children)


class Meaning:
    """The leaves of a plan by name, what an observed leaf rules out, and what belongs to the plan.

    ``ruled_out[j]`` are the leaves that cannot be observed any more once leaf j was: itself, those that come before it,
    and those of other alternatives.
    """

    def __init__(self, plan: Plan) -> None:
        paths = paths_below(plan.root)
        self.everything = (1 << len(paths)) - 1
        self.ruled_out = [union(1 << j for j, path in enumerate(paths) if rules_out(seen, path)) for seen in paths]
        self.root = branch(plan.root, count())
        self.named: dict[str, list[int]] = {}
        for leaf, term in enumerate(plan.leaves):
            self.named.setdefault(term.functor, []).append(leaf)


def paths_below(node: Node) -> list[Path]:
    """The ways down to the leaves, from left to right."""
    if isinstance(node, Action):
        return [()]
    return [((node, at), *path) for at, child in enumerate(node.children) for path in paths_below(child)]


def rules_out(seen: Path, other: Path) -> bool:
    """Whether the other leaf cannot be observed any more once this one was."""
    for (node, here), (_, there) in zip(seen, other):
        if here != there:
            return comes_before(node, there, here) or (isinstance(node, Shape) and node.kind == "choice")
    return True  # it is the same leaf


def comes_before(node: Node, first: int, then: int) -> bool:
    """Whether one child of a node must be done before another one."""
    if not isinstance(node, Shape) or node.kind in ("sequence", "optional"):
        return first < then
    return any(a == first and (b == then or comes_before(node, b, then)) for a, b in node.order)


def branch(node: Node, numbers: count[int]) -> Branch:
    """The node with its leaves, numbered from left to right."""
    if isinstance(node, Action):
        leaf = 1 << next(numbers)
        return Branch((), leaf, leaf, False, True)
    children = tuple(branch(child, numbers) for child in node.children)
    kind = node.kind if isinstance(node, Shape) else "sequence"
    default = union(child.default for child in children)
    if kind == "optional":
        default = 0
    if kind == "choice":  # the smallest alternative stands for it
        default = min((child.default for child in children), key=int.bit_count)
    is_fixed = kind not in ("optional", "choice") and all(child.is_fixed for child in children)
    return Branch(children, union(child.leaves for child in children), default, kind == "choice", is_fixed)


def union(sets: Iterable[Leaves]) -> Leaves:
    """The leaves of any of the sets."""
    return reduce(or_, sets, 0)
