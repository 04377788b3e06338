"""What the simulated partner will do for a goal: the goal's plan as steps of skills."""

from __future__ import annotations

import random
from dataclasses import dataclass
from itertools import islice

from casper.engine.domain.domain import Domain
from casper.engine.verification.matching import ROBOT, Mismatch, bindings_of
from casper.engine.verification.verified_matching import settle
from casper.kb.errors import DomainError, PlanError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import is_ground, substitute
from casper.plans.library import GOAL
from casper.plans.trees.plan import Plan
from casper.plans.trees.spelling import spelled_out
from casper.sim_adapter.steps import Step

MOST_WAYS = 200  # to do something, of which one is drawn


@dataclass(frozen=True, slots=True)
class ScriptedAction:
    """An action of a plan, the skill that carries it out, and who does it (None: whoever pursues the goal)."""

    action: Compound
    step: Step
    by: str | None = None


def script_for(domain: Domain, goal: str, seed: int = 0) -> list[ScriptedAction]:
    """The goal's plan as the partner would do it, every action fully known.

    Args:
        domain: whose plans.
        goal: the goal's label.
        seed: where the plan allows several ways and orders, one of the first `MOST_WAYS` is drawn from it.

    Raises:
        DomainError: there is no such goal. PlanError: an action has unknown parts that the rules do not settle.
    """
    ways = (spelled for way in domain.library.ways if way.label == goal for spelled in spelled_out(way))
    plans = list(islice(ways, MOST_WAYS))
    if not plans:
        raise DomainError(f"there is no goal {goal!r}: choose {', '.join(domain.library.goals)}")
    return acted_out(domain, random.Random(seed).choice(plans))


def acted_out(domain: Domain, plan: Plan) -> list[ScriptedAction]:
    """All actions of a plan, those of every alternative, every action fully known.

    Raises:
        PlanError: an action has unknown parts that the rules do not settle.
    """
    doers = [_doer(domain, action.by) for action in plan.actions]
    return [ScriptedAction(a, step_for(domain, a), by) for a, by in zip(_grounded(domain, plan), doers)]


def _doer(domain: Domain, by: Term | None) -> str | None:
    """Who does a step, where the plan names somebody; a variable is whoever pursues the goal."""
    if not isinstance(by, str):
        return None
    return domain.robot if by == ROBOT else by


def step_for(domain: Domain, action: Compound) -> Step:
    """The skill behind an action: what a context turns ``use`` into is a use, anything else is a skill by its name."""
    if action.arity != 2:
        raise PlanError(f"{term_text(action)} cannot be acted out: a target and a destination are needed")
    skills = {str(meaning): str(skill) for skill, _, meaning in domain.kb.rows("context", 3)}
    return Step(skills.get(action.functor, action.functor), str(action[1]), str(action[2]))


def _grounded(domain: Domain, plan: Plan) -> list[Compound]:
    """The plan's actions with the goal's parameters settled and every open part chosen: the first valid one."""
    unknown = (None,) * len(plan.variables)
    settled = settle(domain.kb, plan, unknown) if domain.kb.defines(*GOAL) else unknown
    if isinstance(settled, Mismatch):
        raise PlanError(f"nobody can pursue {plan.label}: {', '.join(settled.reasons)}", plan.place)
    known = bindings_of(plan, settled)
    return [_chosen(domain, substitute(leaf, known)) for leaf in plan.leaves]


def _chosen(domain: Domain, action: Compound) -> Compound:
    if is_ground(action):
        return action
    statement = Compound((action.functor, domain.partner, *action.args))
    for answer in domain.kb.instances(Compound(("valid", statement))):
        if is_ground(answer):
            return Compound((action.functor, *answer[1].args[1:]))
    raise PlanError(f"nothing settles the open parts of {term_text(action)}")
