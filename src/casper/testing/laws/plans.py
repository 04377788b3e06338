"""Laws of a domain's plans: they can be done, step by step, and each is told from the others in the end."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import given

from casper.engine.domain.domain import Domain
from casper.kb.reasons.constraints import History
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import is_ground
from casper.kb.text.reader import read_statement
from casper.plans.library import PlanLibrary
from casper.testing.laws.law import with_plans, with_rules
from casper.testing.profiles import checked
from casper.testing.strategies.pursuits import Pursuit, observations
from casper.testing.values import text_of


def plans_can_be_done(domain: Domain) -> None:
    """Every step of every plan is valid for somebody, after the steps before it."""
    with_plans(with_rules(domain))
    for goal in domain.library.goals:
        _goal_can_be_done(domain, goal)


def goals_are_recognised(domain: Domain) -> None:
    """When all steps of a goal were seen, it is likelier than any other."""
    with_plans(domain)
    for goal in domain.library.goals:
        _goal_is_recognised(domain, goal)


def order_of_goals_is_nothing(domain: Domain) -> None:
    """The order in which a library states its goals and productions changes no posterior."""
    library = with_plans(domain)
    backwards = PlanLibrary([*reversed(library.goal_clauses), *reversed(library.productions)])
    bare, other = _of_plans_alone(domain, library), _of_plans_alone(domain, backwards)

    @checked
    @given(observations(library, drop=0.5, needless=0.5))
    def law(pursuit: Pursuit) -> None:
        ours, theirs = bare.reading(verification=False), other.reading(verification=False)
        for number, action in enumerate(pursuit.actions, 1):
            ours.observe(action)
            theirs.observe(action)
            seen = ", ".join(pursuit.actions[:number])
            same = all(abs(share - theirs.posterior[goal]) < 1e-9 for goal, share in ours.posterior.items())
            shown = f"{dict(ours.posterior)}, with goals and plans reversed {dict(theirs.posterior)}"
            assert same, f"after {seen} it is {shown}"

    law()


def _goal_can_be_done(domain: Domain, goal: str) -> None:
    @checked
    @given(observations(domain, goal=goal))
    def law(pursuit: Pursuit) -> None:
        steps = [_term(step) for step in pursuit.steps]
        for number, step in enumerate(steps):
            if not _somebody_can(domain, step, steps[:number]):
                raise AssertionError(_told(domain, goal, steps, number))

    law()


def _goal_is_recognised(domain: Domain, goal: str) -> None:
    @checked
    @given(observations(domain, goal=goal))
    def law(pursuit: Pursuit) -> None:
        reading = domain.reading()
        for number, action in enumerate(pursuit.own, 1):
            reading.observe(action)
            if reading.count == 0:
                why = "; ".join(reading.rejected.get(goal, ()))
                raise AssertionError(f"{goal} rejects its own step {number}, {action}: {why}")
        share = reading.posterior[goal]
        hiding = [other for other, its in reading.posterior.items() if other != goal and its >= share - 1e-9]
        if hiding:
            steps = ", ".join(pursuit.steps)
            raise AssertionError(f"{goal} is hidden by {' and '.join(hiding)}: seen {steps}\n{reading}")

    law()


def _somebody_can(domain: Domain, step: Compound, before: Sequence[Compound]) -> bool:
    return any(domain.kb.verify(_of(agent, step), _history(domain, before)).valid for agent in _agents(domain))


def _told(domain: Domain, goal: str, steps: Sequence[Compound], number: int) -> str:
    """Which step fails and why, after as few steps as it still fails after; and after what later one it would not."""
    before, step = list(steps[:number]), steps[number]
    for earlier in list(before):
        fewer = [other for other in before if other is not earlier]
        if not _somebody_can(domain, step, fewer):
            before = fewer
    verdict = domain.kb.verify(_of(domain.partner, step), _history(domain, before))
    after = f" after {', '.join(map(text_of, before))}" if before else ""
    told = f"{goal}: nobody can do step {number + 1}, {text_of(step)}{after}: {'; '.join(verdict.reasons)}"
    for later in steps[number + 1 :]:
        if _somebody_can(domain, step, [*before, later]):
            return f"{told}\n  after {text_of(later)}, which comes later, it could be done"
    return told


def _agents(domain: Domain) -> list[str]:
    others = [str(row[0]) for kind in ("human", "robot") for row in domain.kb.rows(kind, 1)]
    return list(dict.fromkeys([domain.partner, domain.robot, *others]))


def _history(domain: Domain, steps: Sequence[Compound]) -> History:
    return [(_of(domain.partner, step), float(at)) for at, step in enumerate(steps) if is_ground(step)]


def _of(agent: str, step: Compound) -> Compound:
    return Compound((step.functor, agent, *step.args))


def _term(step: str) -> Compound:
    found = read_statement(step)
    return Compound([Variable(f"_{at}") if isinstance(arg, Variable) else arg for at, arg in enumerate(found)])


def _of_plans_alone(domain: Domain, library: PlanLibrary) -> Domain:
    return type(domain)(domain.name, domain.folder, domain.kb, library, verifies=False)
