"""A plan validator for Unified Planning that says why: ``PlanValidator(name="casper")``.

    >>> import casper.planning                       # registers it
    >>> from unified_planning.shortcuts import PlanValidator
    >>> with PlanValidator(name="casper") as validator:
    ...     result = validator.validate(problem, plan)
    >>> [message.message for message in result.log_messages]
    ['step 3, cook(meal, hobs): nothing makes at(meal, hobs) hold; step 2 took it away']
"""

from __future__ import annotations

from typing import Any

from unified_planning.engines import Credits, Engine
from unified_planning.engines.mixins import PlanValidatorMixin
from unified_planning.engines.plan_validator import TimeTriggeredPlanValidator
from unified_planning.engines.results import (
    FailedValidationReason,
    LogLevel,
    LogMessage,
    ValidationResult,
    ValidationResultStatus,
)
from unified_planning.model import AbstractProblem, ProblemKind
from unified_planning.model.htn import HierarchicalProblem
from unified_planning.plans import Plan, PlanKind

from casper.kb.errors import CasperError
from casper.planning.validation.hierarchy import judge_hierarchical
from casper.planning.validation.instances import own_instance
from casper.planning.validation.judgement import Judgement
from casper.planning.validation.metrics import metric_values
from casper.planning.validation.orders import judge_partial_order
from casper.planning.validation.stepping import judge_sequence
from casper.planning.validation.timed import judge_timed

_CREDITS = Credits(
    name="casper",
    author="The CASPER in logic developers",
    contact="",
    website="",
    license="MIT",
    short_description="Validates plans and says why not.",
    long_description="Validates sequential, partially ordered, time-triggered and hierarchical plans; each refusal "
    "names the step, the condition, and what became of it.",
)
_STATUS = {
    True: ValidationResultStatus.VALID,
    False: ValidationResultStatus.INVALID,
    None: ValidationResultStatus.UNKNOWN,
}


class CasperValidator(Engine, PlanValidatorMixin):  # type: ignore[misc]
    """Judges plans; each reason is a log message of the result."""

    def __init__(self, **options: Any) -> None:
        Engine.__init__(self)
        PlanValidatorMixin.__init__(self)

    @property
    def name(self) -> str:
        """What it is called."""
        return "casper"

    @staticmethod
    def get_credits(**kwargs: Any) -> Credits:
        """Who made it."""
        return _CREDITS

    @staticmethod
    def supports_plan(plan_kind: PlanKind) -> bool:
        """Plans in a row, partly ordered, timed, and of a hierarchy."""
        return plan_kind in (
            PlanKind.SEQUENTIAL_PLAN,
            PlanKind.PARTIAL_ORDER_PLAN,
            PlanKind.TIME_TRIGGERED_PLAN,
            PlanKind.HIERARCHICAL_PLAN,
        )

    @staticmethod
    def supported_kind() -> ProblemKind:
        """What the framework's simulators can do, and hierarchies."""
        kind = TimeTriggeredPlanValidator.supported_kind().clone()
        kind.set_problem_class("HIERARCHICAL")
        for feature in (
            "METHOD_PRECONDITIONS",
            "TASK_NETWORK_CONSTRAINTS",
            "INITIAL_TASK_NETWORK_VARIABLES",
            "TASK_ORDER_TOTAL",
            "TASK_ORDER_PARTIAL",
            "TASK_ORDER_TEMPORAL",
        ):
            kind.set_hierarchical(feature)
        return kind

    @staticmethod
    def supports(problem_kind: ProblemKind) -> bool:
        """Whether it can judge plans of such a problem."""
        return bool(problem_kind <= CasperValidator.supported_kind())

    def _validate(self, problem: AbstractProblem, plan: Plan) -> ValidationResult:
        judgement = self._unsupported(problem, plan) or judge(problem, plan)
        metrics = metric_values(problem, plan, judgement) if judgement.valid else None
        return ValidationResult(
            _STATUS[judgement.valid],
            self.name,
            [LogMessage(LogLevel.INFO, reason) for reason in judgement.reasons],
            metrics,
            judgement.failure,
            judgement.action,
            judgement.trace,
        )


    def _unsupported(self, problem: AbstractProblem, plan: Plan) -> Judgement | None:
        """What is not supported is unknown, whatever the framework's own checks were told to do."""
        if not self.supports_plan(plan.kind):
            return Judgement(None, (f"plans of the kind {plan.kind.name} are not supported",))
        beyond = sorted(problem.kind.features - self.supported_kind().features)
        if beyond:
            return Judgement(None, (f"the problem has what is not supported: {', '.join(beyond)}",))
        return None


def judge(problem: Any, plan: Any) -> Judgement:
    """What is found out about a plan of a problem.

    Grounded actions of compilers are taken for instances of the problem's.
    """
    wrong: list[Judgement] = []

    def own(instance: Any) -> Any:
        try:
            return own_instance(problem, instance)
        except CasperError as mistake:
            wrong.append(Judgement(False, (str(mistake),), FailedValidationReason.INAPPLICABLE_ACTION, instance))
            return instance

    if not all(own(instance) is instance for instance in _instances(plan)):
        plan = plan.replace_action_instances(own)
    if wrong:
        return wrong[0]
    if plan.kind == PlanKind.HIERARCHICAL_PLAN:
        if not isinstance(problem, HierarchicalProblem):
            return Judgement.shape_fails("the plan is one of a hierarchy, and the problem has none")
        return judge_hierarchical(problem, plan)
    if isinstance(problem, HierarchicalProblem):
        return Judgement(None, ("the problem is a hierarchy: a plan without its decomposition cannot be judged",))
    if plan.kind == PlanKind.PARTIAL_ORDER_PLAN:
        return judge_partial_order(problem, plan)
    if plan.kind == PlanKind.TIME_TRIGGERED_PLAN:
        return judge_timed(problem, plan)
    return judge_sequence(problem, plan.actions)


def _instances(plan: Any) -> list[Any]:
    if plan.kind == PlanKind.SEQUENTIAL_PLAN:
        return list(plan.actions)
    if plan.kind == PlanKind.PARTIAL_ORDER_PLAN:
        return list(plan.get_adjacency_list)
    if plan.kind == PlanKind.TIME_TRIGGERED_PLAN:
        return [action for _, action, _ in plan.timed_actions]
    return [action for _, action in plan.actions()]
