"""Plans with times: the framework's own validator for the verdict, and why what it stopped at does not hold."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from unified_planning.engines.plan_validator import TimeTriggeredPlanValidator
from unified_planning.engines.results import ValidationResult, ValidationResultStatus
from unified_planning.model import FNode, Problem, State
from unified_planning.plans import TimeTriggeredPlan

from casper.planning.validation.history import History
from casper.planning.validation.judgement import Judgement, action_name
from casper.planning.validation.reasons import Reasons


class _Recording(TimeTriggeredPlanValidator):  # type: ignore[misc]
    """Remembers the condition that failed last, and the state in which it did: the one it stopped at."""

    failed: tuple[FNode, State] | None = None

    def _check_condition(self, state: State, se: Any, condition: FNode) -> bool:
        holds = bool(super()._check_condition(state, se, condition))
        if not holds:
            self.failed = condition, state
        return holds


def judge_timed(problem: Problem, plan: TimeTriggeredPlan) -> Judgement:
    """A plan whose steps have times, perhaps durations."""
    validator = _Recording(environment=problem.environment)
    result: ValidationResult = validator._validate(problem, plan)
    if result.status is ValidationResultStatus.VALID:
        return Judgement(True, trace=result.trace)
    action = result.inapplicable_action
    name = "at the end" if action is None else _named(plan, action)
    reasons = tuple(f"{name}: {why}" for why in _why(problem, plan, validator, result))
    return Judgement(False, reasons, result.reason, action, result.trace)


def _why(problem: Problem, plan: TimeTriggeredPlan, validator: _Recording, result: ValidationResult) -> list[str]:
    if result.log_messages:  # effects that clash
        return ["it gives a fluent a value at the same time as another step does"]
    assert validator.failed is not None and result.trace is not None
    condition, state = validator.failed
    times = sorted(time for time in result.trace if isinstance(time, Fraction))
    at = next((n for n, time in enumerate(times) if result.trace[time] is state), len(times) - 1)
    states = [result.trace[time] for time in times[: at + 1]]
    steps = [_at(plan, time) for time in times[1 : at + 1]]
    when = "" if times[at] < 0 else f" (after {_seconds(times[at])})"
    found = Reasons(problem, History(states, steps)).why_not(condition)
    return [f"{why}{when}" for why in found] or [f"{condition} does not hold{when}"]


def _at(plan: TimeTriggeredPlan, time: Fraction) -> str:
    """The steps that change something at a time: those that begin or end there, else the time alone."""
    found = [
        action_name(action)
        for start, action, duration in plan.timed_actions
        if time == start or (duration is not None and time == start + duration)
    ]
    return f"{' or '.join(found)} at {_seconds(time)}" if found else f"what happens at {_seconds(time)}"


def _named(plan: TimeTriggeredPlan, wanted: Any) -> str:
    for number, (start, action, _) in enumerate(plan.timed_actions, 1):
        if action is wanted:
            return f"step {number}, {action_name(action)} at {_seconds(start)}"
    return action_name(wanted)


def _seconds(time: Fraction) -> str:
    return f"{float(time):g}"
