"""Situations: where a plan stands. What is yet to be done of it depends on that, not on how it came about."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from casper.engine.verification.binding import Binding, bindings_of
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import substitute
from casper.plans.trees.plan import Plan


@dataclass(frozen=True)
class Situation:
    """A plan, the mask of its closed leaves (bit j = leaf j), and what is known of its parameters.

    ``done`` is the mask of the leaves that were observed, or missed and so done unseen. Where it is not known which
    alternative of a choice that is over was taken, none of it counts.
    """

    plan: Plan
    closed: int
    binding: Binding
    done: int

    @classmethod
    def of(cls, plan: Plan, closed: int, binding: Binding) -> Situation:
        """A situation of which only the closed leaves are known."""
        chart = plan.chart
        return cls(plan, closed, binding, closed & chart.certain(closed))

    def after(self, leaves: int) -> Situation:
        """The same with more leaves done: their mask."""
        return Situation(self.plan, self.closed | leaves, self.binding, self.done | leaves)

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
    def open_leaves(self) -> tuple[int, ...]:
        """The numbers of the leaves that are yet to be done, in an order that the plan allows.

        Of a choice that is open they are those of its smallest alternative.
        """
        return tuple(self.plan.chart.coming_leaves(self.closed))

    @property
    def belonging(self) -> int:
        """Mask of the open leaves that belong to the plan by now: not those of an optional part nobody began."""
        chart = self.plan.chart
        return chart.belonging(chart.entered(self.closed)) & ~self.closed

    def leads_to(self, later: Situation) -> bool:
        """Whether what was expected here came true as far as the later situation knows, and nothing else was begun."""
        if later.plan != self.plan or self.closed & ~later.closed:
            return False
        expected = [leaf for leaf in self.open_leaves if not later.closed >> leaf & 1]
        return expected == list(later.open_leaves) and self.belonging & ~later.closed == later.belonging

    @property
    def frontier(self) -> tuple[Compound, ...]:
        """The ordered unobserved leaves: what is yet to be done (paper section III-G)."""
        return tuple(self.leaves[leaf] for leaf in self.open_leaves)
