"""Whether an observation can be a certain leaf of a plan: names, parameters, and what the knowledge base says.

A matcher maps (plan, leaf, observation, binding) to the new `Binding` or to a `Mismatch` with its reasons. Behind the
parameters a binding may have what a matcher keeps of conditions whose answer is still open. Both the tree-copying
specification and the counting engine take their matcher as an argument, so verification enters them alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol, Self, TypeAlias

from casper.engine.verification.binding import Binding, Slot, filled, slots_of, unified
from casper.engine.verification.mismatch import Clash, Mismatch, Refused
from casper.engine.verification.observation import Observation
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Term, Variable, as_term
from casper.plans.trees.plan import Plan

Recipe: TypeAlias = tuple[Any, ...]  # what makes a matcher, and what it takes besides the plans
ROBOT = "robot"  # in by(robot, Action): whoever helps


class Agents(NamedTuple):
    """Who the partner is, and who is meant by ``robot`` in ``by(robot, Action)``; None: nobody says."""

    partner: str | None = None
    robot: str | None = None

    def named(self, who: Term) -> Term:
        """The agent that a plan means."""
        return self.robot if who == ROBOT and self.robot is not None else who


NOBODY = Agents()


class Matcher(Protocol):
    """What an explainer asks about plans, leaves and observations."""

    def initial(self, plan: int) -> Binding | Mismatch:
        """What is known of the plan's parameters before anything was seen."""

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """The binding after the observation is taken for the leaf (whose name agrees)."""

    def ask(
        self, plan: int, due: Sequence[tuple[int, bool]], observation: Observation, binding: Binding
    ) -> Binding | Mismatch:
        """The binding after the conditions that the observation asks (`Chart.asked`), and those that are still open.

        ``due`` are their numbers, and whether what was observed is past for them.
        """

    def observed(self, observation: Observation) -> None:
        """Told once an observation is settled: later verdicts may depend on what was done earlier."""

    def forget(self) -> None:
        """Told when the last observation is taken back."""

    def fork(self) -> Matcher:
        """One that goes on from here on its own."""


class Timeless:
    """What matchers have in common for which no condition and nothing that was done earlier counts."""

    def ask(
        self, plan: int, due: Sequence[tuple[int, bool]], observation: Observation, binding: Binding
    ) -> Binding | Mismatch:
        """There is nobody to ask."""
        return binding

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Self:
        """Nothing depends on the past."""
        return self


class NameMatcher(Timeless):
    """Action names only: no parameters, no knowledge base (``--no-verification``)."""

    def __init__(self, plans: Sequence[Plan]) -> None:
        self.plans = plans

    @property
    def recipe(self) -> Recipe:
        """How another process makes one for the same plans."""
        return (NameMatcher,)

    def initial(self, plan: int) -> Binding | Mismatch:
        """Nothing is ever known of parameters."""
        return ()

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Every leaf of the name will do."""
        return ()


class ParameterMatcher(Timeless):
    """Parameters flow between leaves; a conflict rejects the leaf, and so does a leaf that another agent does."""

    def __init__(self, plans: Sequence[Plan], agents: Agents = NOBODY) -> None:
        self.plans, self.agents = plans, agents
        self._slots: dict[int, list[tuple[Slot, ...] | None]] = {}  # by plan and leaf; None: not plain

    @property
    def recipe(self) -> Recipe:
        """How another process makes one for the same plans."""
        return ParameterMatcher, self.agents

    def initial(self, plan: int) -> Binding | Mismatch:
        """No parameter is known."""
        return (None,) * len(self.plans[plan].variables)

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Unify the leaf under the binding with the observation."""
        if self.plans[plan].says_who:
            done = self._by(plan, leaf, binding)
            if isinstance(done, Mismatch):
                return done
            binding = done
        if observation.args is None:
            return binding
        by_leaf = self._slots.get(plan)
        if by_leaf is None:
            by_leaf = self._slots[plan] = slots_of(self.plans[plan])
        slots = by_leaf[leaf]
        if slots is None or not observation.is_plain:
            after = unified(self.plans[plan], leaf, observation, binding)
            after = None if after is None else (*after, *binding[len(after) :])
        else:
            after = filled(slots, observation.args, binding)
        return Clash(self.plans[plan], leaf, observation, binding) if after is None else after

    def _by(self, plan: int, leaf: int, binding: Binding) -> Binding | Mismatch:
        """The binding after the partner did the leaf; a mismatch where the plan has somebody else do it."""
        by, partner, chosen = self.plans[plan].actions[leaf].by, self.agents.partner, self.plans[plan]
        if by is None or partner is None:
            return binding
        at = chosen.variables.index(by) if isinstance(by, Variable) else -1
        who = self.agents.named(by if at < 0 else binding[at])
        if who is None:
            return (*binding[:at], partner, *binding[at + 1 :])
        if who == partner:
            return binding
        step = term_text(as_term(chosen.leaves[leaf]))
        return Refused((f"{step} of {chosen.label} is {term_text(who)}'s step, not {partner}'s",))
