"""What is found out about a plan: whether it is valid, and if not, which step fails and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from unified_planning.engines.results import FailedValidationReason
from unified_planning.plans import ActionInstance

Trace: TypeAlias = Any  # the framework's: states in a list, or by time


@dataclass(frozen=True)
class Judgement:
    """``valid`` is None when it could not be found out within the bounds; ``reasons`` are sentences."""

    valid: bool | None
    reasons: tuple[str, ...] = ()
    failure: FailedValidationReason | None = None
    action: ActionInstance | None = None
    trace: Trace | None = None

    @classmethod
    def step_fails(cls, step: str, why: Sequence[str], action: ActionInstance, trace: Trace = None) -> Judgement:
        """A step that cannot be done."""
        reasons = tuple(f"{step}: {reason}" for reason in why)
        return cls(False, reasons, FailedValidationReason.INAPPLICABLE_ACTION, action, trace)

    @classmethod
    def goal_fails(cls, why: Sequence[str], trace: Trace = None) -> Judgement:
        """A goal that is not reached."""
        reasons = tuple(f"at the end: {reason}" for reason in why)
        return cls(False, reasons, FailedValidationReason.UNSATISFIED_GOALS, None, trace)

    @classmethod
    def shape_fails(cls, reason: str, action: ActionInstance | None = None) -> Judgement:
        """A plan that does not fit the problem, whatever holds when."""
        return cls(False, (reason,), FailedValidationReason.INAPPLICABLE_ACTION, action)


def step_name(number: int, action: ActionInstance) -> str:
    """A step as it is told: ``step 3, cook(meal, hobs)``."""
    return f"step {number}, {action_name(action)}"


def action_name(action: ActionInstance) -> str:
    """An action with its arguments."""
    values = ", ".join(map(str, action.actual_parameters))
    return f"{action.action.name}({values})" if values else str(action.action.name)
