"""Whether an observation can be a certain leaf of a plan: names, parameters, and what the knowledge base says.

A `Binding` is what is known of a plan's parameters, in the order of ``plan.variables``; None is unknown. A matcher
maps (plan, leaf, observation, binding) to the new binding or to a `Mismatch` with its reasons. Both the tree-copying
specification and the counting engine take their matcher as an argument, so verification enters them alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from casper.engine.observation import Observation
from casper.kb.terms import Bindings, Compound, Term, Variable, is_ground, substitute, unify
from casper.kb.writer import term_text
from casper.plans.plan import Plan

Binding: TypeAlias = tuple[Term | None, ...]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """Why an observation cannot be a leaf, one sentence each."""

    reasons: tuple[str, ...]


class Matcher(Protocol):
    """What an explainer asks about plans, leaves and observations."""

    def initial(self, plan: int) -> Binding | Mismatch:
        """What is known of the plan's parameters before anything was seen."""

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """The binding after the observation is taken for the leaf (whose name agrees)."""

    def observed(self, observation: Observation) -> None:
        """Told once an observation is settled: later verdicts may depend on what was done earlier."""

    def forget(self) -> None:
        """Told when the last observation is taken back."""

    def fork(self) -> Matcher:
        """One that goes on from here on its own."""


class NameMatcher:
    """Action names only: no parameters, no knowledge base (``--no-verification``)."""

    def __init__(self, plans: Sequence[Plan]) -> None:
        self.plans = plans

    def initial(self, plan: int) -> Binding | Mismatch:
        """Nothing is ever known of parameters."""
        return ()

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Every leaf of the name will do."""
        return ()

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Matcher:
        """Nothing depends on the past."""
        return self


class ParameterMatcher:
    """Parameters flow between leaves; a conflict rejects the leaf."""

    def __init__(self, plans: Sequence[Plan]) -> None:
        self.plans = plans

    def initial(self, plan: int) -> Binding | Mismatch:
        """No parameter is known."""
        return (None,) * len(self.plans[plan].variables)

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Unify the leaf under the binding with the observation."""
        if observation.args is None:
            return binding
        known = bindings_of(self.plans[plan], binding)
        wanted = self.plans[plan].leaves[leaf]
        seen = Compound((observation.action, *_apart(observation.args)))
        unified = unify(wanted, seen, known)
        if unified is None:
            return Mismatch((_conflict(self.plans[plan], wanted, seen, known),))
        return binding_of(self.plans[plan], unified)

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Matcher:
        """Nothing depends on the past."""
        return self


def bindings_of(plan: Plan, binding: Binding) -> Bindings:
    """The substitution that a binding stands for."""
    return {v: value for v, value in zip(plan.variables, binding) if value is not None}


def binding_of(plan: Plan, bindings: Bindings) -> Binding:
    """What a substitution says of the plan's parameters."""
    values = (substitute(variable, bindings) for variable in plan.variables)
    return tuple(value if is_ground(value) else None for value in values)


def _apart(args: Sequence[Term]) -> list[Term]:
    """An observation's unknown arguments as variables that are no plan's."""
    return [Variable(f"_seen{at}", -1) if isinstance(arg, Variable) else arg for at, arg in enumerate(args)]


def _conflict(plan: Plan, wanted: Compound, seen: Compound, known: Bindings) -> str:
    """The first argument that disagrees, in words."""
    if len(wanted) != len(seen):
        return f"{wanted.functor} takes {len(wanted) - 1} arguments in {plan.label}"
    for expected, value in zip(wanted.args, seen.args):
        settled = substitute(expected, known)
        if is_ground(settled) and not isinstance(value, Variable) and settled != value:
            if isinstance(expected, Variable):
                return f"{expected!r} of {plan.label} is {term_text(settled)}, not {term_text(value)}"
            return f"{plan.label} has {term_text(substitute(wanted, known))}, not {term_text(seen)}"
    return f"{plan.label} has {term_text(substitute(wanted, known))}, not {term_text(seen)}"
