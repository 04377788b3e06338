"""What the simulated partner will do for a goal: the goal's plan as steps of skills."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from casper.engine.actions.contexts import skills_of
from casper.engine.domain.domain import Domain
from casper.engine.episodes.networks.state import State
from casper.engine.verification.binding import bindings_of
from casper.engine.verification.matching import ROBOT
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation
from casper.engine.verification.verified_matching import settle
from casper.kb.errors import DomainError, PlanError, Undefined
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term
from casper.kb.terms.unification import is_ground, substitute, unify
from casper.plans.library import GOAL
from casper.plans.trees.plan import Plan
from casper.plans.trees.spelling import spelled_out
from casper.sim_adapter.steps import Step

MOST_WAYS = 200  # to do something, of which one is drawn
MOST_TRIED = 2000  # actions that are tried for a goal whose plans are not listed


@dataclass(frozen=True, slots=True)
class ScriptedAction:
    """An action of a plan, the skill that carries it out, who does it (None: who pursues the goal), and for what goal.

    ``action`` and ``goal`` are None where the step serves no goal.
    """

    action: Compound | None
    step: Step
    by: str | None = None
    goal: str | None = None


def script_for(domain: Domain, goal: str, seed: int = 0) -> list[ScriptedAction]:
    """The goal's plan as the partner would do it, every action fully known.

    Args:
        domain: whose plans.
        goal: the goal's label.
        seed: where the plan allows several ways and orders, one of the first `MOST_WAYS` is drawn from it.

    Of plans that are not listed it is a way of doing what is left of the goal with the fewest leaves.

    Raises:
        DomainError: there is no such goal. PlanError: an action has unknown parts that the rules do not settle.
    """
    if goal not in domain.library.goals:
        raise DomainError(f"there is no goal {goal!r}: choose {', '.join(domain.library.goals)}")
    if not domain.library.is_listed:
        return [ScriptedAction(action, step_for(domain, action), by, goal) for action, by in _grown(domain, goal)]
    ways = (spelled for way in domain.library.ways if way.label == goal for spelled in spelled_out(way))
    plans = list(islice(ways, MOST_WAYS))
    return acted_out(domain, random.Random(seed).choice(plans))


def acted_out(domain: Domain, plan: Plan) -> list[ScriptedAction]:
    """All actions of a plan, those of every alternative, every action fully known.

    Raises:
        PlanError: an action has unknown parts that the rules do not settle.
    """
    doers = [_doer(domain, action.by) for action in plan.actions]
    return [ScriptedAction(a, step_for(domain, a), by, plan.label) for a, by in zip(_grounded(domain, plan), doers)]


def _doer(domain: Domain, by: Term | None) -> str | None:
    """Who does a step, where the plan names somebody; a variable is whoever pursues the goal."""
    if not isinstance(by, str):
        return None
    return domain.robot if by == ROBOT else by


def step_for(domain: Domain, action: Compound) -> Step:
    """The skill behind an action: what a context turns ``use`` into is a use, anything else is a skill by its name."""
    if action.arity != 2:
        raise PlanError(f"{term_text(action)} cannot be acted out: a target and a destination are needed")
    return Step(skills_of(domain.kb).get(action.functor, action.functor), str(action[1]), str(action[2]))


def _grounded(domain: Domain, plan: Plan) -> list[Compound]:
    """The plan's actions with the goal's parameters settled and every open part chosen: the first valid one."""
    unknown = (None,) * len(plan.variables)
    settled = settle(domain.kb, plan, unknown) if domain.kb.defines(*GOAL) else unknown
    if isinstance(settled, Mismatch):
        raise PlanError(f"nobody can pursue {plan.label}: {', '.join(settled.reasons)}", plan.place)
    known = bindings_of(plan, settled)
    actions: list[Compound] = []
    for leaf in plan.leaves:  # what one of them settles the others share
        actions.append(_chosen(domain, substitute(leaf, known)))
        known = unify(leaf, actions[-1], known) or known
    return actions


def _grown(domain: Domain, goal: str) -> list[tuple[Compound, str | None]]:
    """The actions of a goal whose plans are grown, and who does each: the first valid ones from which it is reached."""
    networks = domain.networks()
    tried = 0

    def onward(state: State) -> list[tuple[Compound, str | None]] | None:
        nonlocal tried
        coming = networks.leaves_left(state)
        if not coming:
            return [] if networks.is_done(state) else None
        doer = _doer(domain, coming[0].by)
        for action in _instances(domain, coming[0].term, doer):
            tried += 1
            if tried > MOST_TRIED:
                return None
            steps = networks.steps(state, Observation(action.functor, action.args), doer or domain.partner)
            for step in sorted(steps, key=lambda step: networks.least_left(step.state)):
                rest = onward(step.state) if not step.missed else None
                if rest is not None:
                    return [(action, doer), *rest]
        return None

    found = onward(networks.begin(list(networks.goals).index(goal)))
    if found is None:
        raise PlanError(f"no way to do {goal} was found among the first {MOST_TRIED} actions that were tried")
    return found


def _instances(domain: Domain, action: Compound, doer: str | None = None) -> Iterator[Compound]:
    """The valid actions that an action with open parts may be; then those of which it is not known yet."""
    if is_ground(action):
        yield action
        return
    statement = Compound((action.functor, doer or domain.partner, *action.args))
    try:
        for answer in domain.kb.instances(Compound(("valid", statement))):
            if is_ground(answer):
                yield Compound((action.functor, *answer[1].args[1:]))
    except Undefined:
        for instance in domain.kb.instances(statement):
            if is_ground(instance) and domain.kb.verify(instance).valid is None:
                yield Compound((action.functor, *instance.args[1:]))


def _chosen(domain: Domain, action: Compound) -> Compound:
    for found in _instances(domain, action):
        return found
    raise PlanError(f"nothing settles the open parts of {term_text(action)}")
