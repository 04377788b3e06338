"""Laws of readings: what they say adds up, and does not depend on how they came to it."""

from __future__ import annotations

from itertools import islice

from hypothesis import given

from casper.engine.domain.domain import Domain
from casper.engine.explanation.explanation import Explanation
from casper.engine.reading.reading import Reading
from casper.kb.terms.terms import Compound
from casper.testing.laws.law import NotApplicable, with_plans, with_rules
from casper.testing.profiles import checked
from casper.testing.strategies.pursuits import Pursuit, observations
from casper.testing.values import text_of

MOST_LOOKED_AT = 20  # explanations of a reading


def shares_add_up(domain: Domain) -> None:
    """After any observations the goals' shares sum to one, or there is no explanation and all are zero."""
    with_plans(domain)

    @checked
    @given(observations(domain, drop=0.5, needless=0.5, misread=0.3))
    def law(pursuit: Pursuit) -> None:
        reading = domain.reading()
        for action in pursuit.actions:
            reading.observe(action)
            whole = sum(reading.posterior.values())
            assert abs(whole - (reading.count > 0)) < 1e-9, f"the shares sum to {whole} after {_seen(reading)}"

    law()


def marks_stand_in_order(domain: Domain) -> None:
    """Every explanation gives each observation a leaf of its name, in an order that the plan allows."""
    with_plans(domain)

    @checked
    @given(observations(domain, drop=0.5))
    def law(pursuit: Pursuit) -> None:
        reading = domain.reading()
        for action in pursuit.actions:
            reading.observe(action)
        for explanation in islice(reading.explanations(), MOST_LOOKED_AT):
            for part in explanation.parts:
                _check_marks(part, reading)

    law()


def taking_back_is_not_having_seen(domain: Domain) -> None:
    """A reading that takes observations back, or was copied before them, is one that never had them."""
    with_plans(domain)

    @checked
    @given(observations(domain, drop=0.5, needless=0.3))
    def law(pursuit: Pursuit) -> None:
        reading, shares = domain.reading(), []
        for action in pursuit.actions:
            shares.append(dict(reading.posterior))
            copy = reading.fork()
            copy.observe(action)
            same = dict(reading.posterior) == shares[-1]
            assert same, f"a copy that observes {action} changes what it was copied from"
            reading.observe(action)
            assert dict(copy.posterior) == dict(reading.posterior), f"a copy reads {action} as something else"
        while shares:
            reading.undo()
            same = dict(reading.posterior) == shares.pop()
            assert same, f"taking back leaves something behind after {_seen(reading)}"

    law()


def robot_plans_are_valid(domain: Domain) -> None:
    """What the robot is given to do it can do, when what is waited for was done before."""
    with_plans(with_rules(domain))
    if not any(domain.kb.rows("robot", 1)):
        raise NotApplicable("the domain has no robot")

    @checked
    @given(observations(domain, drop=0.3))
    def law(pursuit: Pursuit) -> None:
        reading = domain.reading()
        for action in pursuit.actions:
            reading.observe(action)
            plan = reading.plan_for(domain.robot)
            best = reading.first
            if plan is None or best is None:
                continue
            done = [leaf for part in best.parts for at, leaf in enumerate(part.leaves) if part.situation.done >> at & 1]
            history = [*done, *plan.waiting]
            for step in plan.actions:
                after = [(_of(domain.partner, earlier), float(at)) for at, earlier in enumerate(history)]
                verdict = domain.kb.verify(_of(domain.robot, step), after)
                assert verdict.valid is not False, (
                    f"{domain.robot} is given {text_of(step)} after {_seen(reading)}: {'; '.join(verdict.reasons)}"
                )
                history.append(step)

    law()


def _check_marks(part: Explanation, reading: Reading) -> None:
    chart, progress = part.plan.chart, part.plan.chart.start
    seen = [reading.observations[at] for at in range(len(reading.observations)) if at not in part.needless]
    assert len(seen) == len(part.marks), f"{part!r} has {len(part.marks)} marks for {len(seen)} observations"
    for leaf, observation in zip(part.marks, seen):
        name = part.plan.leaves[leaf].functor
        assert name == observation.action, f"{part!r} takes {observation} for {name}"
        assert not progress[0] >> leaf & 1, f"{part!r} marks {text_of(part.plan.leaves[leaf])} when it is closed"
        progress = chart.close(progress, leaf)


def _seen(reading: Reading) -> str:
    return ", ".join(map(str, reading.observations)) or "nothing"


def _of(agent: str, step: Compound) -> Compound:
    return Compound((step.functor, agent, *step.args))


