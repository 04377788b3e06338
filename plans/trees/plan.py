"""A plan: one way to pursue a goal, as a tree whose leaves are actions in order (frozen data)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from casper.kb.errors import Place
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import variables_of
from casper.kb.text.lines import Line, Shown, lines_of, one_line, text_of
from casper.plans.trees.chart import Chart, draw_chart
from casper.plans.trees.nodes import Action, Condition, Task, actions_below, conditions_below, is_plain
from casper.plans.trees.tree import plan_tree, tree_text


@dataclass(frozen=True)
class Plan(Shown):
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
        """The parameters of goal, leaves, those who do them, and conditions, in order of first occurrence."""
        doers = [action.by for action in self.actions if action.by is not None]
        return tuple(variables_of(self.goal, *self.leaves, *doers, *(each.term for each in self.conditions)))

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        """What the plan asks of the knowledge base, in order (`Chart.guards` says when)."""
        return tuple(conditions_below(self.root))

    @cached_property
    def says_who(self) -> bool:
        """Whether some leaf says who does it."""
        return any(action.by is not None for action in self.actions)

    @cached_property
    def chart(self) -> Chart:
        """What the shapes mean for the leaves: their order, and what may be left out."""
        return draw_chart(self.root)

    @cached_property
    def is_plain(self) -> bool:
        """Whether the plan's actions simply follow one another."""
        return is_plain(self.root)

    def lines(self) -> Iterator[Line]:
        """The plan as a tree of which nothing was observed."""
        return lines_of(tree_text(plan_tree(self)))

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        leaves = ", ".join(term_text(as_term(leaf)) for leaf in self.leaves)
        return one_line(f"Plan {term_text(as_term(self.goal))}: {leaves}")
