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
from casper.kb.base import KnowledgeBase
from casper.kb.terms import Bindings, Compound, Term, Variable, as_term, is_ground, substitute, unify
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
        return _binding(self.plans[plan], unified)

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Matcher:
        """Nothing depends on the past."""
        return self


class VerifyingMatcher(ParameterMatcher):
    """Parameters, the goal's own condition, and the validity of what the partner is taken to have done."""

    def __init__(self, plans: Sequence[Plan], kb: KnowledgeBase, partner: str) -> None:
        super().__init__(plans)
        self.kb, self.partner = kb, partner
        self._histories: list[tuple[tuple[Compound, float], ...]] = [()]  # after each observation
        self._goals: dict[tuple[int, Binding], Binding | Mismatch] = {}
        self._verdicts: dict[Compound, Mismatch | None] = {}

    def initial(self, plan: int) -> Binding | Mismatch:
        """What the goal's condition alone settles: ``goal(breakfast(F)) :- biscuits(F)`` makes F the biscuits."""
        return self._allowed(plan, (None,) * len(self.plans[plan].variables))

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Unify, then ask the knowledge base about the goal and about the action."""
        result = super().match(plan, leaf, observation, binding)
        if isinstance(result, Mismatch):
            return result
        if result != binding:
            result = self._allowed(plan, result)
            if isinstance(result, Mismatch):
                return result
        action = substitute(self.plans[plan].leaves[leaf], bindings_of(self.plans[plan], result))
        return self._verdict(Compound((action.functor, self.partner, *action.args))) or result

    def observed(self, observation: Observation) -> None:
        """Remember the action for did/2, where it is known in full."""
        history = self._histories[-1]
        if observation.args is not None and all(is_ground(arg) for arg in observation.args):
            statement = Compound((observation.action, self.partner, *observation.args))
            history = (*history, (statement, float(len(self._histories))))
        self._histories.append(history)
        self._verdicts.clear()

    def forget(self) -> None:
        """Take the last observation out of the history."""
        self._histories.pop()
        self._verdicts.clear()

    def fork(self) -> Matcher:
        """One with the same past; what was settled of the goals is shared."""
        other = object.__new__(VerifyingMatcher)
        other.__dict__.update(self.__dict__)
        other._histories, other._verdicts = list(self._histories), dict(self._verdicts)
        return other

    def _verdict(self, statement: Compound) -> Mismatch | None:
        if statement not in self._verdicts:
            verdict = self.kb.verify(statement, self._histories[-1])
            self._verdicts[statement] = Mismatch(verdict.reasons) if verdict.valid is False else None
        return self._verdicts[statement]

    def _allowed(self, plan: int, binding: Binding) -> Binding | Mismatch:
        key = (plan, binding)
        if key not in self._goals:
            stated = self.kb.defines("goal", 1)
            self._goals[key] = settle(self.kb, self.plans[plan], binding) if stated else binding
        return self._goals[key]


def settle(kb: KnowledgeBase, plan: Plan, binding: Binding) -> Binding | Mismatch:
    """The binding completed by the goal's condition where only one value will do; a mismatch where none does."""
    known = bindings_of(plan, binding)
    goal = Compound(("goal", as_term(substitute(plan.goal, known))))
    answers: list[Binding] = []
    for answer in kb.instances(goal):
        unified = unify(goal, answer, known)
        completed = None if unified is None else _binding(plan, unified)
        if completed is not None and completed not in answers:
            answers.append(completed)
        if len(answers) > 1:
            return binding
    if answers:
        return answers[0]
    refusal = kb.why_not(goal)
    return Mismatch(refusal.reasons if refusal is not None else ())


def bindings_of(plan: Plan, binding: Binding) -> Bindings:
    """The substitution that a binding stands for."""
    return {v: value for v, value in zip(plan.variables, binding) if value is not None}


def _binding(plan: Plan, bindings: Bindings) -> Binding:
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
