"""A plan: one way to pursue a goal, as a tree whose leaves are actions in order (frozen data)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

from casper.kb.errors import Place
from casper.kb.terms import Compound, Variable, as_term, variables_of
from casper.kb.writer import term_text

if TYPE_CHECKING:
    from casper.plans.chart import Chart


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


@dataclass(frozen=True)
class Plan:
    """One way to pursue a goal, with what it leaves open.

    ``label`` is what the goal is called in results: its name, or the whole term where several goals share the name.
    ``way`` numbers the plans of one goal from 0. ``leaves`` are the actions of all alternatives, in one order that the
    plan allows (the only one, where it has no `Shape`). Parameters that are not settled are variables, the same ones in
    the goal and in the leaves.
    """

    label: str
    root: Task
    way: int = 0
    place: Place = field(default=Place(), compare=False)

    @property
    def goal(self) -> Compound:
        """The goal with its parameters."""
        return self.root.term

    @cached_property
    def leaves(self) -> tuple[Compound, ...]:
        """The actions in order."""
        return tuple(action.term for action in self.actions)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """The leaf nodes in order."""
        return tuple(actions_below(self.root))

    @cached_property
    def variables(self) -> tuple[Variable, ...]:
        """The parameters of goal and leaves, in order of first occurrence."""
        return tuple(variables_of(self.goal, *self.leaves))

    @cached_property
    def chart(self) -> Chart:
        """What the shapes mean for the leaves: their order, and what may be left out."""
        from casper.plans.chart import draw_chart  # charts are drawn of plans

        return draw_chart(self)

    def __repr__(self) -> str:
        leaves = ", ".join(term_text(as_term(leaf)) for leaf in self.leaves)
        return f"<Plan {term_text(as_term(self.goal))}: {leaves}>"


def actions_below(node: Node) -> list[Action]:
    """The node's leaves from left to right; an action is its own."""
    if isinstance(node, Action):
        return [node]
    return [leaf for child in node.children for leaf in actions_below(child)]


def is_plain(plan: Plan) -> bool:
    """Whether the plan's actions simply follow one another: no shape is left in its tree."""
    waiting: list[Node] = [plan.root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Shape):
            return False
        if isinstance(node, Task):
            waiting.extend(node.children)
    return True
