"""Whether an observation can be a certain leaf of a plan: names, parameters, and what the knowledge base says.

A `Binding` is what is known of a plan's parameters, in the order of ``plan.variables``; None is unknown. A matcher
maps (plan, leaf, observation, binding) to the new binding or to a `Mismatch` with its reasons. Behind the parameters a
binding may have what a matcher keeps of conditions whose answer is still open. Both the tree-copying
specification and the counting engine take their matcher as an argument, so verification enters them alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeAlias

from casper.engine.events.telling import PLAIN, Telling
from casper.engine.verification.observation import Observation
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import Bindings, is_ground, renamed, substitute, unify
from casper.plans.trees.plan import Plan

Binding: TypeAlias = tuple[Term | None, ...]
Recipe: TypeAlias = tuple[Any, ...]  # what makes a matcher, and what it takes besides the plans
ROBOT = "robot"  # in by(robot, Action): whoever helps


class Mismatch:
    """That an observation cannot be a leaf, and why."""

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why, one sentence each."""
        return ()

    def told(self, tell: Telling) -> tuple[str, ...]:
        """The same in the author's words, as far as there are any."""
        return self.reasons


@dataclass(frozen=True)
class Refused(Mismatch):
    """A mismatch with the sentences of those who refused it."""

    sentences: tuple[str, ...]

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why, one sentence each."""
        return self.sentences


@dataclass(frozen=True)
class Clash(Mismatch):
    """A mismatch of parameters; its sentence is made when somebody asks, which is seldom where there are many plans."""

    plan: Plan
    leaf: int
    observation: Observation
    binding: Binding

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why, one sentence each."""
        return self.told(PLAIN)

    def told(self, tell: Telling) -> tuple[str, ...]:
        """The same in the author's words, as far as there are any."""
        seen = Compound((self.observation.action, *(self.observation.args or ())))
        return (_conflict(self.plan, self.plan.leaves[self.leaf], seen, bindings_of(self.plan, self.binding), tell),)


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


class NameMatcher:
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

    def ask(
        self, plan: int, due: Sequence[tuple[int, bool]], observation: Observation, binding: Binding
    ) -> Binding | Mismatch:
        """Nobody is asked."""
        return binding

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Matcher:
        """Nothing depends on the past."""
        return self


Slot: TypeAlias = tuple[int, Term]  # which of the plan's parameters an argument is; (-1, value) for a constant


class ParameterMatcher:
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

    def ask(
        self, plan: int, due: Sequence[tuple[int, bool]], observation: Observation, binding: Binding
    ) -> Binding | Mismatch:
        """There is nobody to ask."""
        return binding

    def observed(self, observation: Observation) -> None:
        """Nothing depends on the past."""

    def forget(self) -> None:
        """Nothing depends on the past."""

    def fork(self) -> Matcher:
        """Nothing depends on the past."""
        return self


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


def _conflict(plan: Plan, wanted: Compound, seen: Compound, known: Bindings, tell: Telling) -> str:
    """The first argument that disagrees, in words."""
    goal = tell.goal(plan.label)
    if len(wanted) != len(seen):
        return f"{wanted.functor} takes {len(wanted) - 1} arguments in {plan.label}"
    for expected, value in zip(wanted.args, seen.args):
        settled = substitute(expected, known)
        if is_ground(settled) and not isinstance(value, Variable) and settled != value:
            if isinstance(expected, Variable):
                return tell.phrase("parameter", repr(expected), goal, tell.thing(settled), tell.thing(value))
            break
    steps = (tell.step(term_text(as_term(step))) for step in (substitute(wanted, known), seen))
    return tell.phrase("other step", goal, *steps)
