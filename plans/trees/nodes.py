"""The nodes of a plan: tasks, shapes and actions, as a tree of frozen data."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from casper.kb.errors import Place
from casper.kb.terms.terms import Compound, Term


@dataclass(frozen=True, slots=True)
class Task:
    """An inner node: the goal itself or a non-terminal, with what it is done by, in order."""

    term: Compound
    children: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """A leaf: an action the partner can be seen to do; its agent is left out. ``place`` is its production's.

    ``by`` is who does it, where the plan says so: an agent, a variable, or ``robot``; None: whoever pursues the goal.
    """

    term: Compound
    place: Place = field(default=Place(), compare=False)
    by: Term | None = None


@dataclass(frozen=True, slots=True)
class Condition:
    """What must hold where it stands: nothing is done, the knowledge base is asked (`plans.grammar.conditions`).

    ``term`` is the relation that stands for it, with the parameters it is about.
    """

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


Node: TypeAlias = Task | Action | Shape | Condition


def actions_below(node: Node) -> list[Action]:
    """The node's leaves from left to right; an action is its own."""
    if isinstance(node, Action):
        return [node]
    if isinstance(node, Condition):
        return []
    return [leaf for child in node.children for leaf in actions_below(child)]


def conditions_below(node: Node) -> list[Condition]:
    """The node's conditions from left to right; a condition is its own."""
    if isinstance(node, Condition):
        return [node]
    if isinstance(node, Action):
        return []
    return [condition for child in node.children for condition in conditions_below(child)]


def is_hollow(node: Node) -> bool:
    """Whether there is nothing to be done in it."""
    return isinstance(node, Condition) or (not isinstance(node, Action) and all(map(is_hollow, node.children)))


def is_plain(root: Task) -> bool:
    """Whether the actions below simply follow one another: no shape or condition is left in the tree."""
    waiting: list[Node] = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, (Shape, Condition)):
            return False
        if isinstance(node, Task):
            waiting.extend(node.children)
    return True
