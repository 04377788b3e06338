"""Plans nobody can do: the knowledge base lets no agent take one of their steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain, islice

from casper.engine.domain import Domain
from casper.kb.errors import BudgetExceeded, CasperError, Place
from casper.kb.finding import Finding, error, note, warning
from casper.kb.terms import Bindings, Compound, Variable, as_term, substitute, unify
from casper.kb.writer import term_text
from casper.plans.library import GOAL
from casper.plans.plan import Plan
from casper.plans.spelling import decided

MOST_PLANS = 500  # looked at one by one
MOST_VALUES = 50  # of a goal's parameters
_ANYBODY = Variable("Anybody", -1)


@dataclass(frozen=True, slots=True)
class _Obstacle:
    """A step that is not valid, and why; without a step it is the goal that nothing allows."""

    step: Compound | None
    place: Place
    reasons: tuple[str, ...]

    def __str__(self) -> str:
        shown = "" if self.step is None else f"nobody can do {term_text(as_term(self.step))}, because "
        return f"{shown}{'; '.join(self.reasons)}"


def plans_nobody_can_do(domain: Domain) -> Iterator[Finding]:
    """Goals that cannot be pursued, single plans that cannot, and steps at which the partner is never seen."""
    ways = chain.from_iterable(map(decided, domain.library.ways))
    plans = list(islice(ways, MOST_PLANS))
    if next(ways, None) is not None:
        yield note(plans[0].place, f"only the first {MOST_PLANS} plans were tried out")
    obstacles = {plan: _obstacle(domain, plan, None) for plan in plans}
    possible = {plan.label for plan, obstacle in obstacles.items() if obstacle is None}
    for plan, obstacle in obstacles.items():
        if obstacle is None:
            yield from _never_seen(domain, plan)
        elif plan.label in possible:
            yield warning(obstacle.place, f"one way to pursue {plan.label} is impossible: {obstacle}")
        else:
            yield error(plan.place, f"the goal {plan.label} cannot be pursued: {obstacle}")


def _never_seen(domain: Domain, plan: Plan) -> Iterator[Finding]:
    obstacle = _obstacle(domain, plan, domain.partner)
    if obstacle is not None and obstacle.step is not None:
        shown = term_text(as_term(obstacle.step))
        because = "; ".join(obstacle.reasons)
        sentence = f"{domain.partner} is never seen to do {shown} of {plan.label}, because {because}"
        yield note(obstacle.place, f"{sentence}; others can do it")


def _obstacle(domain: Domain, plan: Plan, agent: str | None) -> _Obstacle | None:
    """The first thing that keeps the agent (None: everybody) from the plan, whatever its parameters are.

    What lies before a step is taken as done by the partner. A search without an end keeps nobody from anything; a
    condition that cannot be decided does.
    """
    found: _Obstacle | None = None
    try:
        for values in islice(_values(domain, plan), MOST_VALUES):
            obstacle = _first_refusal(domain, plan, values, agent)
            if obstacle is None:
                return None
            found = found or obstacle
        if found is None:
            refusal = domain.kb.why_not(Compound(("goal", as_term(plan.goal))))
            reasons = refusal.reasons if refusal is not None else ("no value of its parameters makes it a goal",)
            return _Obstacle(None, plan.place, reasons)
    except BudgetExceeded:
        return None
    except CasperError as mistake:
        return _Obstacle(None, mistake.place or plan.place, (mistake.sentence,))
    return found


def _values(domain: Domain, plan: Plan) -> Iterator[Bindings]:
    """What the goal's conditions allow its parameters to be."""
    goal = Compound(("goal", as_term(plan.goal)))
    if not domain.kb.defines(*GOAL):
        yield {}
        return
    for answer in domain.kb.instances(goal):
        bindings = unify(goal, answer, {})
        if bindings is not None:
            yield bindings


def _first_refusal(domain: Domain, plan: Plan, values: Bindings, agent: str | None) -> _Obstacle | None:
    history: list[tuple[Compound, float]] = []
    for number, action in enumerate(plan.actions):
        step = substitute(action.term, values)
        verdict = domain.kb.verify(Compound((step.functor, agent or _ANYBODY, *step.args)), history)
        if verdict.valid is False:
            return _Obstacle(step, action.place, verdict.reasons)
        history.append((Compound((step.functor, domain.partner, *step.args)), float(number)))
    return None
