"""Partly ordered plans: valid when every row of their steps that keeps the order is.

What was done by a moment is a set of steps; which states it can have led to is counted set by set, each pair once. So
steps that do not touch each other cost little, whatever their number of orders. Beyond a bound the answer is unknown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from unified_planning.exceptions import UPProblemDefinitionError
from unified_planning.model import FNode, Problem, State
from unified_planning.plans import ActionInstance, PartialOrderPlan

from casper.planning.validation.judgement import Judgement
from casper.planning.validation.stepping import Stepper, judge_sequence

MOST = 20_000  # pairs of a set of steps and a state


@dataclass(frozen=True)
class _Moment:
    """A state, and a row of steps that leads to it."""

    state: State
    row: tuple[ActionInstance, ...]


def judge_partial_order(problem: Problem, plan: PartialOrderPlan, most: int = MOST) -> Judgement:
    """A plan whose steps are partly ordered: every row, or the first that fails."""
    steps = list(plan.get_adjacency_list)
    before = _before(plan, steps)
    stepper = Stepper(problem)
    try:
        first = stepper.first()
    except UPProblemDefinitionError:
        return judge_sequence(problem, ())
    changing = _fluents(problem, steps)
    moments: dict[int, dict[tuple[object, ...], _Moment]] = {0: {(): _Moment(first, ())}}
    looked_at = 0
    for _ in range(len(steps)):
        following: dict[int, dict[tuple[object, ...], _Moment]] = {}
        for done, states in moments.items():
            for at, step in enumerate(steps):
                if done >> at & 1 or before[at] & ~done:
                    continue
                for moment in states.values():
                    looked_at += 1
                    if looked_at > most:
                        return Judgement(None, (f"there are more than {most} states in which its steps may stand",))
                    row = (*moment.row, step)
                    found = stepper.step(moment.state, step)
                    if isinstance(found, (list, str)):
                        return _in_that_order(judge_sequence(problem, row), row)
                    key = tuple(_values(found, changing))
                    following.setdefault(done | 1 << at, {}).setdefault(key, _Moment(found, row))
        moments = following
    for states in moments.values():
        for moment in states.values():
            if stepper.failing_goals(moment.state):
                return _in_that_order(judge_sequence(problem, moment.row), moment.row)
    return Judgement(True)


def _in_that_order(judgement: Judgement, row: tuple[ActionInstance, ...]) -> Judgement:
    order = ", ".join(str(action) for action in row)
    reasons = tuple(f"in the order {order}, which the plan allows: {reason}" for reason in judgement.reasons)
    return Judgement(False, reasons, judgement.failure, judgement.action)


def _before(plan: PartialOrderPlan, steps: list[ActionInstance]) -> list[int]:
    """For each step the mask of those directly before it."""
    number = {id(step): at for at, step in enumerate(steps)}
    before = [0] * len(steps)
    adjacent: Mapping[ActionInstance, list[ActionInstance]] = plan.get_adjacency_list
    for step, followers in adjacent.items():
        for follower in followers:
            before[number[id(follower)]] |= 1 << number[id(step)]
    return before


def _fluents(problem: Problem, steps: list[ActionInstance]) -> list[FNode]:
    """Every ground fluent that some step may change."""
    from unified_planning.model.fluent import get_all_fluent_exp

    changed = {effect.fluent.fluent() for step in steps for effect in step.action.effects}
    simulated = any(step.action.simulated_effect is not None for step in steps)
    fluents = [fluent for fluent in problem.fluents if simulated or fluent in changed]
    return [ground for fluent in fluents for ground in get_all_fluent_exp(problem, fluent)]


def _values(state: State, fluents: list[FNode]) -> list[object]:
    from casper.planning.validation.history import History

    history = History([state], [])
    return [history.value(fluent) for fluent in fluents]
