"""The nodes of a plan: tasks, shapes and actions, as a tree of frozen data."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.terms import Compound


@dataclass(frozen=True, slots=True)
class Task:
    """An inner node: the goal itself or a non-terminal, with what it is done by, in order."""

    term: Compound
    children: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """A leaf: an action the partner can be seen to do; its agent is left out. ``place`` is its production's."""

    term: Compound
    place: Place = field(default=Place(), compare=False)


@dataclass(frozen=True, slots=True)
class Shape:
    """Steps of a task that are more than one after the other: they hang from the task that the shape stands in.

    ``kind`` is ``sequence``, ``optional`` (both in order), ``choice`` (one of the children is done), ``unordered``, or
    ``steps``: then ``order`` holds the pairs of child numbers of which the first comes before the second, and the
    children stand in an order that keeps them. Children that no order relates may interleave.
    """

    kind: Literal["sequence", "optional", "choice", "unordered", "steps"]
    children: tuple[Node, ...]
    order: frozenset[tuple[int, int]] = frozenset()


Node: TypeAlias = Task | Action | Shape


def actions_below(node: Node) -> list[Action]:
    """The node's leaves from left to right; an action is its own."""
    if isinstance(node, Action):
        return [node]
    return [leaf for child in node.children for leaf in actions_below(child)]


def is_plain(root: Task) -> bool:
    """Whether the actions below simply follow one another: no shape is left in the tree."""
    waiting: list[Node] = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Shape):
            return False
        if isinstance(node, Task):
            waiting.extend(node.children)
    return True
