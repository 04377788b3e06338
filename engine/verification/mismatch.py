"""That an observation cannot be a certain leaf of a plan, and why."""

from __future__ import annotations

from dataclasses import dataclass

from casper.engine.events.telling import PLAIN, Telling
from casper.engine.verification.binding import Binding, bindings_of
from casper.engine.verification.observation import Observation
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import Bindings, is_ground, substitute
from casper.plans.trees.plan import Plan


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
