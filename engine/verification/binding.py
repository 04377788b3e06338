"""What is known of a plan's parameters: a `Binding` has them in the order of ``plan.variables``; None is unknown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, renamed, substitute, unify
from casper.plans.trees.plan import Plan

Binding: TypeAlias = tuple[Term | None, ...]
Slot: TypeAlias = tuple[int, Term]  # which of the plan's parameters an argument is; (-1, value) for a constant


def slots_of(plan: Plan) -> list[tuple[Slot, ...] | None]:
    """What the arguments of each leaf are; None where one is a compound term."""
    numbers = {variable: at for at, variable in enumerate(plan.variables)}
    return [
        None
        if any(isinstance(arg, Compound) for arg in leaf.args)
        else tuple((numbers[arg], None) if isinstance(arg, Variable) else (-1, arg) for arg in leaf.args)
        for leaf in plan.leaves
    ]


def filled(slots: Sequence[Slot], values: Sequence[Term], binding: Binding) -> Binding | None:
    """The binding after constants were seen as arguments; None where they clash. The same as `unified`, and faster."""
    if len(slots) != len(values):
        return None
    after = binding
    for (number, constant), value in zip(slots, values):
        wanted = constant if number < 0 else after[number]
        if wanted is None:
            after = (*after[:number], value, *after[number + 1 :])
        elif wanted != value:
            return None
    return after


def unified(plan: Plan, leaf: int, observation: Observation, binding: Binding) -> Binding | None:
    """The binding after the observation was unified with the leaf; None where they clash."""
    seen = Compound((observation.action, *renamed(observation.args or (), -1)))  # its variables are no plan's
    bindings = unify(plan.leaves[leaf], seen, bindings_of(plan, binding))
    return None if bindings is None else binding_of(plan, bindings)


def bindings_of(plan: Plan, binding: Binding) -> Bindings:
    """The substitution that a binding stands for."""
    return {v: value for v, value in zip(plan.variables, binding) if value is not None}


def binding_of(plan: Plan, bindings: Bindings) -> Binding:
    """What a substitution says of the plan's parameters."""
    values = (substitute(variable, bindings) for variable in plan.variables)
    return tuple(value if is_ground(value) else None for value in values)
