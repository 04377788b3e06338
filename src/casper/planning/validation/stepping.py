"""One step after another: the framework's simulator, with our reasons where it stops."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

from unified_planning.engines.sequential_simulator import UPSequentialSimulator
from unified_planning.exceptions import (
    UPConflictingEffectsException,
    UPInvalidActionError,
    UPProblemDefinitionError,
    UPUsageError,
)
from unified_planning.model import FNode, InstantaneousAction, Problem, State
from unified_planning.plans import ActionInstance

from casper.planning.validation.history import History
from casper.planning.validation.judgement import Judgement, action_name, step_name
from casper.planning.validation.reasons import Reasons


class Stepper:
    """States of a problem under its actions."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # parameters without bounds: nothing is enumerated here
            self.simulator = UPSequentialSimulator(problem, error_on_failed_checks=False)

    def first(self) -> State:
        """The state before any step.

        Raises:
            UPProblemDefinitionError: it breaks what must always hold.
        """
        return self.simulator.get_initial_state()

    def step(self, state: State, action: ActionInstance) -> State | list[FNode] | str:
        """The state after a step; or the conditions that fail; or what else is wrong, in words."""
        try:
            failing, _ = self.simulator.get_unsatisfied_conditions(state, action)
            return list(failing) or self.simulator.apply_unsafe(state, action)
        except UPConflictingEffectsException:
            return "it would give one fluent two values at once"
        except UPInvalidActionError as mistake:
            return _invalid(mistake)
        except UPUsageError as mistake:
            return f"it cannot be worked out: {_sentence(mistake)}"

    def failing_goals(self, state: State) -> list[FNode]:
        """The goals that do not hold."""
        return list(self.simulator.get_unsatisfied_goals(state))


def judge_sequence(problem: Problem, actions: Sequence[ActionInstance]) -> Judgement:
    """A plan whose steps stand in a row."""
    stepper = Stepper(problem)
    try:
        states = [stepper.first()]
    except UPProblemDefinitionError as mistake:
        return Judgement.shape_fails(f"at the beginning: {_sentence(mistake)}")
    names = [f"step {number}" for number in range(1, len(actions) + 1)]
    for number, action in enumerate(actions, 1):
        found = stepper.step(states[-1], action)
        if isinstance(found, (list, str)):
            history = History(states, names)
            why = [found] if isinstance(found, str) else _why(problem, history, found, actions[number - 1 :], number)
            return Judgement.step_fails(step_name(number, action), why, action, states)
        states.append(found)
    failing = stepper.failing_goals(states[-1])
    if failing:
        return Judgement.goal_fails(_why(problem, History(states, names), failing, (), len(actions) + 1), states)
    return Judgement(True, trace=states)


def _why(
    problem: Problem, history: History, failing: Sequence[FNode], coming: Sequence[ActionInstance], number: int
) -> list[str]:
    """Why conditions fail before step ``number``, the first of those that are to come."""

    def later(fluent: FNode, value: bool) -> str | None:
        for at, action in enumerate(coming[1:], number + 1):
            if _gives(action, fluent, value):
                return f"step {at}, {action_name(action)},"
        return None

    reasons = Reasons(problem, history, later)
    found = [reason for condition in failing for reason in reasons.why_not(condition)]
    return found or [f"{condition} does not hold" for condition in failing]


def _gives(action: ActionInstance, fluent: FNode, value: bool) -> bool:
    """Whether the action sets the fluent to the value without a condition."""
    if not isinstance(action.action, InstantaneousAction):
        return False
    binding = dict(zip(action.action.parameters, action.actual_parameters))
    return any(
        effect.fluent.substitute(binding) == fluent
        and effect.value.is_bool_constant()
        and effect.value.bool_constant_value() == value
        for effect in action.action.unconditional_effects
        if effect.fluent.fluent() == fluent.fluent() and not effect.is_forall()
    )


def _invalid(mistake: UPInvalidActionError) -> str:
    told = " ".join(map(str, mistake.args))
    if "invariants" in told:
        return "it would break what must always hold, such as the bounds of a number"
    return "with these arguments it is no action: its own effects or conditions contradict each other"


def _sentence(mistake: Exception) -> str:
    return " ".join(" ".join(map(str, mistake.args)).split()).rstrip(".")
