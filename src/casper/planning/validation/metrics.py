"""What a valid plan costs: the framework's own evaluation of a problem's quality metric."""

from __future__ import annotations

from typing import Any

from unified_planning.engines.plan_validator import get_temporal_metric_evaluations
from unified_planning.engines.sequential_simulator import (
    evaluate_quality_metric,
    evaluate_quality_metric_in_initial_state,
)
from unified_planning.plans import PlanKind

from casper.planning.validation.judgement import Judgement
from casper.planning.validation.stepping import Stepper


def metric_values(problem: Any, plan: Any, judgement: Judgement) -> dict[Any, Any] | None:
    """The value of each metric; None where there is none, or the plan has no one row of states."""
    if plan.kind == PlanKind.HIERARCHICAL_PLAN:
        plan = plan.action_plan
    if not problem.quality_metrics or judgement.trace is None:
        return None
    if plan.kind == PlanKind.TIME_TRIGGERED_PLAN:
        found: dict[Any, Any] | None = get_temporal_metric_evaluations(problem, plan, judgement.trace)
        return found
    if len(problem.quality_metrics) > 1:
        return None
    (metric,) = problem.quality_metrics
    simulator, states = Stepper(problem).simulator, judgement.trace
    value = evaluate_quality_metric_in_initial_state(simulator, metric)
    for number, action in enumerate(plan.actions):
        before, after = states[number], states[number + 1]
        value = evaluate_quality_metric(
            simulator, metric, value, before, action.action, action.actual_parameters, after
        )
    return {metric: value}
