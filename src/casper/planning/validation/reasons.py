"""Why a condition fails: its parts that fail, what they are instead, and which step made them so.

A table by kind of expression; whatever has no row is told as it stands.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import product
from typing import TypeAlias

from unified_planning.model import FNode, OperatorKind, Problem
from unified_planning.model.walkers.state_evaluator import StateEvaluator

from casper.planning.validation.history import History

Why: TypeAlias = "Callable[[Reasons, FNode], Iterator[str]]"
_MOST_INSTANCES = 10_000  # of a quantifier, that are looked at for a counterexample


class Reasons:
    """Reasons at one moment of a plan.

    ``later`` tells which step after it, if any, gives a fluent a value that is wanted.
    """

    def __init__(self, problem: Problem, history: History, later: Callable[[FNode, bool], str | None] | None = None):
        self.problem, self.history = problem, history
        self._later = later or (lambda fluent, value: None)
        self._evaluator = StateEvaluator(problem)

    def why_not(self, condition: FNode) -> list[str]:
        """Sentences that say why a condition does not hold; empty when it does."""
        return list(dict.fromkeys(self._why_not(condition)))

    def holds(self, condition: FNode) -> bool:
        """Whether a condition holds now."""
        found = self._evaluator.evaluate(condition, self.history.now)
        return bool(found.is_bool_constant() and found.bool_constant_value())

    def _why_not(self, condition: FNode) -> Iterator[str]:
        if not self.holds(condition):
            yield from _TABLE.get(condition.node_type, Reasons._as_it_stands)(self, condition)

    def _all(self, condition: FNode) -> Iterator[str]:
        for part in condition.args:
            yield from self._why_not(part)

    def _none(self, condition: FNode) -> Iterator[str]:
        parts = "; ".join(reason for part in condition.args for reason in self._why_not(part))
        yield f"none of {' or '.join(map(str, condition.args))} holds ({parts})"

    def _not(self, condition: FNode) -> Iterator[str]:
        (inner,) = condition.args
        if inner.is_fluent_exp():
            fluent = self._ground(inner)
            yield f"{fluent} holds; {self._made(fluent, 'made it so')}"
        elif inner.is_equals():
            yield f"{self._with_values(inner)}, which must not be"
        else:
            yield f"{inner} holds"

    def _fluent(self, condition: FNode) -> Iterator[str]:
        fluent = self._ground(condition)
        by, later = self.history.changed_by(fluent), self._later(fluent, True)
        told = f"nothing makes {fluent} hold" if later is None else f"{fluent} does not hold"
        if by is not None:
            told += f"; {by} took it away"
        if later is not None:
            told += f"; {later} makes it hold, but later"
        yield told

    def _comparison(self, condition: FNode) -> Iterator[str]:
        yield f"{condition} does not hold: {self._with_values(condition)}"

    def _implies(self, condition: FNode) -> Iterator[str]:
        first, then = condition.args
        for reason in self._why_not(then):
            yield f"since {first}: {reason}"

    def _exists(self, condition: FNode) -> Iterator[str]:
        names = ", ".join(f"{variable.name} - {variable.type.name}" for variable in condition.variables())
        yield f"there is no {names} with {condition.arg(0)}"

    def _forall(self, condition: FNode) -> Iterator[str]:
        for number, instance in enumerate(self._instances(condition)):
            if number >= _MOST_INSTANCES:
                break
            values, body = instance
            if not self.holds(body):
                told = ", ".join(f"{name} = {value}" for name, value in values.items())
                yield from (f"for {told}: {reason}" for reason in self._why_not(body))
                return
        yield from self._as_it_stands(condition)

    def _as_it_stands(self, condition: FNode) -> Iterator[str]:
        yield f"{condition} does not hold"

    # --- words -----------------------------------------------------------------------------------------------------

    def _made(self, fluent: FNode, what: str) -> str:
        by = self.history.changed_by(fluent)
        return "it does from the beginning, and no step before ends it" if by is None else f"{by} {what}"

    def _with_values(self, condition: FNode) -> str:
        """What the fluents of a comparison are, and since when."""
        told = []
        for fluent in dict.fromkeys(map(self._ground, _fluents_in(condition))):
            value, by = self.history.value(fluent), self.history.changed_by(fluent)
            shown = "undefined" if value is None else value
            told.append(f"{fluent} is {shown}" + (f" since {by}" if by is not None else ""))
        return ", ".join(told) or str(condition)

    def _ground(self, fluent: FNode) -> FNode:
        """The fluent with its arguments worked out, such as ``at(location(robot))``."""
        if all(argument.is_constant() for argument in fluent.args):
            return fluent
        arguments = [self._evaluator.evaluate(argument, self.history.now) for argument in fluent.args]
        return fluent.fluent()(*arguments)

    def _instances(self, condition: FNode) -> Iterator[tuple[Mapping[str, FNode], FNode]]:
        variables = condition.variables()
        manager = self.problem.environment.expression_manager
        domains = [
            [manager.ObjectExp(thing) for thing in self.problem.objects(variable.type)] for variable in variables
        ]
        for values in product(*domains):
            substitution = {manager.VariableExp(variable): value for variable, value in zip(variables, values)}
            names = {variable.name: value for variable, value in zip(variables, values)}
            yield names, condition.arg(0).substitute(substitution)


def _fluents_in(expression: FNode) -> Iterator[FNode]:
    if expression.is_fluent_exp():
        yield expression
    else:
        for argument in expression.args:
            yield from _fluents_in(argument)


_TABLE: dict[OperatorKind, Why] = {
    OperatorKind.AND: Reasons._all,
    OperatorKind.OR: Reasons._none,
    OperatorKind.NOT: Reasons._not,
    OperatorKind.FLUENT_EXP: Reasons._fluent,
    OperatorKind.LE: Reasons._comparison,
    OperatorKind.LT: Reasons._comparison,
    OperatorKind.EQUALS: Reasons._comparison,
    OperatorKind.IMPLIES: Reasons._implies,
    OperatorKind.EXISTS: Reasons._exists,
    OperatorKind.FORALL: Reasons._forall,
}
