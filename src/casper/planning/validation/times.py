"""Constraints between the times of tasks, with delays: what they say of a plan's actual times."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from unified_planning.model import FNode, OperatorKind

Times = Mapping[tuple[str, bool], Fraction | None]  # by task and whether its start is meant


def holds(constraint: FNode, times: Times) -> bool | None:
    """Whether a constraint holds; None where it speaks of a task without a time, or of something else."""
    kind = constraint.node_type
    if kind in (OperatorKind.AND, OperatorKind.OR, OperatorKind.NOT):
        parts = [holds(part, times) for part in constraint.args]
        if kind is OperatorKind.NOT:
            return None if parts[0] is None else not parts[0]
        decisive = kind is OperatorKind.OR
        if decisive in parts:
            return decisive
        return None if None in parts else not decisive
    if kind not in (OperatorKind.LT, OperatorKind.LE, OperatorKind.EQUALS):
        return None
    first, second = (_number(part, times) for part in constraint.args)
    if first is None or second is None:
        return None
    if kind is OperatorKind.EQUALS:
        return first == second
    return first < second if kind is OperatorKind.LT else first <= second


def _number(expression: FNode, times: Times) -> Fraction | None:
    if expression.is_timing_exp():
        return _time(expression.timing(), times)
    if expression.is_int_constant() or expression.is_real_constant():
        return Fraction(expression.constant_value())
    parts = [_number(part, times) for part in expression.args]
    if None in parts or not parts:
        return None
    values = [part for part in parts if part is not None]
    if expression.node_type is OperatorKind.PLUS:
        return sum(values, Fraction(0))
    if expression.node_type is OperatorKind.MINUS and len(values) == 2:
        return values[0] - values[1]
    return None


def _time(timing: Any, times: Times) -> Fraction | None:
    container = timing.timepoint.container
    if container is None:
        return Fraction(timing.delay) if timing.is_from_start() else None
    base = times.get((container, timing.is_from_start()))
    return None if base is None else base + Fraction(timing.delay)
