"""What is left to do where a plan of the library is blocked, or none is left.

    >>> rest = remainder(reading, problem, "fast-downward")                 # doctest: +SKIP
    >>> print(rest)                                                         # doctest: +SKIP
    tiago's turn: pick_and_place(plate, sink), then wash(plate, sink)
    found by fast-downward, because step 2, pick_and_place(meal, plate): nothing makes clean(plate) hold
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from unified_planning.model import Problem
from unified_planning.model.htn import HierarchicalProblem
from unified_planning.plans import ActionInstance

from casper.engine.collaboration.collaboration import CollaborativePlan, collaborative_plan
from casper.engine.explanation.situation import Situation
from casper.engine.reading.reading import Reading
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound
from casper.kb.text.lines import Line, Span, line, one_line
from casper.planning.importing.vocabulary import Vocabulary, Who
from casper.planning.remaining.planners import Found, find_plan
from casper.planning.remaining.replay import Blocked, Course, agent_place, as_action, seen_action, simulated
from casper.plans.trees.nodes import Action, Shape, Task
from casper.plans.trees.plan import Plan

LABEL = "rest"
MOST_WAYS = 1000  # of doing actions with open parameters that wait to be tried


@dataclass(frozen=True)
class Remainder(CollaborativePlan):
    """The robot's part in what a planner found.

    ``planner`` is who found it (empty: the library's plan goes on as it is), ``reason`` why it was asked, ``situation``
    where the whole plan stands, which `after` can be asked with once more of it is done.
    """

    planner: str = ""
    reason: str = ""
    situation: Situation | None = None

    def to_json(self) -> dict[str, Any]:
        """As of any part, with ``planner`` and ``reason``."""
        return {**super().to_json(), "planner": self.planner or None, "reason": self.reason}

    def lines(self) -> Iterator[Line]:
        """What a person is shown: what the agent does, and why it is that."""
        yield from super().lines()
        who = f"found by {self.planner}, because " if self.planner else ""
        yield line(Span(f"{who}{self.reason}", "faint"))

    def __repr__(self) -> str:
        return one_line(f"Remainder for {self.goal}: {'; '.join(str(self).splitlines())}")


def remainder(
    reading: Reading,
    problem: Problem,
    planner: str | None = None,
    *,
    robot: str | None = None,
    agent: str | None = None,
    timeout: float | None = None,
) -> Remainder:
    """What the robot can do of what is left: of the library's plan where that goes on, else of what a planner finds.

    The observations are replayed in the problem, each done by the partner. Where the best explanation's frontier can be
    done from there and reaches the problem's goal, no planner is asked.

    Args:
        reading: what was observed.
        problem: the same place as a problem of Unified Planning, with actions of the same names; the goal is a state.
        planner: the name of an engine of the framework; None: the first that can do such a problem.
        robot: who helps (None: whom the domain says).
        agent: the type of the parameter that does an action; without it, a parameter more than the domain's action has.
        timeout: seconds for the planner.

    Raises:
        CasperError: the observations cannot have happened in this problem (which step, and why), the goal is none of a
            state, or the planner has no plan.
    """
    if isinstance(problem, HierarchicalProblem) and not problem.goals:
        raise CasperError("the problem wants tasks and no state: add a goal that says what is wanted in the end")
    if isinstance(problem, HierarchicalProblem):
        problem = _flat(problem)
    agents = reading.agents
    helper = robot or agents.robot or "robot"
    partner = agents.partner or "human"
    course = simulated(Vocabulary(problem, Who(agent, partner, helper)))
    for seen in reading.observations:
        try:
            course.do(seen_action(seen), [partner])
        except Blocked as mistake:
            told = "this cannot have happened in this problem; is it the problem of this place, as it was at first?"
            raise CasperError(f"{mistake.sentence} ({told})") from None
    why = _blocked(reading, course.fork(), [partner, helper])
    if why is None:
        return _as_it_is(reading, helper)
    found = find_plan(course.from_here(), planner, timeout)
    situation = _situation(reading, course.vocabulary, _handed_over(course, found, reading, helper), [partner, helper])
    part = collaborative_plan(helper, situation, reading.capability)
    return _remainder(part, found.planner, why, situation)


def _blocked(reading: Reading, course: Course, agents: Sequence[str]) -> str | None:
    """Why the library's plan does not do; None: it does."""
    best = reading.first
    if best is None:
        seen = bool(reading.observations)
        return "no plan of the library explains what was observed" if seen else "nothing was observed yet"
    try:
        reasons = list(_reasons(course, best.frontier, agents, best.goal))
    except CasperError as mistake:
        return mistake.sentence
    return None if None in reasons else reasons[0]


def _reasons(course: Course, actions: Sequence[Compound], agents: Sequence[str], goal: str) -> Iterator[str | None]:
    """Why each way of doing the actions does not reach the goal; None once one does."""
    waiting = [(course, 0)]
    while waiting:
        here, number = waiting.pop()
        if number == len(actions):
            missing = here.missing()
            yield f"at the end of {goal}: {missing[0]}" if missing else None
            if not missing:
                return
            continue
        ways = here.ways(actions[number], agents)
        if not ways:
            yield here.why_not(actions[number], agents)
        for instance in reversed(ways):
            waiting.append((here.after(instance), number + 1))
            if len(waiting) > MOST_WAYS:
                raise CasperError(f"the plan of {goal} has too many ways to be tried; say more of its actions")


def _as_it_is(reading: Reading, robot: str) -> Remainder:
    part, best = reading.plan_for(robot), reading.first
    assert part is not None and best is not None
    situation = next(each.situation for each in best.parts if each.goal == part.goal)
    return _remainder(part, "", f"the plan of {part.goal} goes on as it is", situation)


def _remainder(part: CollaborativePlan, planner: str, why: str, situation: Situation) -> Remainder:
    return Remainder(
        part.agent, part.goal, part.waiting, part.actions, part.leaves, part.awaited, planner, why, situation
    )


def _handed_over(course: Course, found: Found, reading: Reading, robot: str) -> Found:
    """The same plan with every step done by the robot that the problem lets it do; planners take whomever they like."""
    arities, steps = dict(reading.library.actions.keys()), list(found.steps)
    manager = course.problem.environment.expression_manager
    for number, step in enumerate(steps):
        at = agent_place(course.vocabulary, step.action, arities.get(step.action.name, -1), robot)
        if at is not None and course.problem.has_object(robot):
            arguments = list(step.actual_parameters)
            arguments[at] = manager.ObjectExp(course.problem.object(robot))
            other = ActionInstance(step.action, tuple(arguments))
            if course.reaches_goal([*steps[:number], other, *steps[number + 1 :]]):
                steps[number] = other
    return Found(found.planner, tuple(steps), found.order)


def _situation(reading: Reading, vocabulary: Vocabulary, found: Found, agents: Sequence[str]) -> Situation:
    """What was observed and what was found, as a plan of which the first part is done."""
    arities = dict(reading.library.actions.keys())
    done = [Action(seen_action(seen)) for seen in reading.observations]
    steps = []
    for instance in found.steps:
        action, who = as_action(vocabulary, instance, arities.get(instance.action.name), agents)
        steps.append(Action(action, by=who))
    best = reading.first
    label = best.goal if best is not None else LABEL
    rest: tuple[Any, ...] = tuple(steps)
    if len(steps) > 1 and found.order != {(at, at + 1) for at in range(len(steps) - 1)}:
        rest = (Shape("steps", tuple(steps), found.order),)
    plan = Plan(label, Task(Compound((label,)), (*done, *rest)))
    return Situation.of(plan, (1 << len(done)) - 1, ())


def _flat(problem: HierarchicalProblem) -> Problem:
    """The problem without its tasks: only the state counts."""
    flat = Problem(problem.name, problem.environment, initial_defaults=problem.initial_defaults)
    for kind in problem.user_types:
        flat._add_user_type(kind)
    for fluent in problem.fluents:
        flat.add_fluent(fluent, default_initial_value=problem.fluents_defaults.get(fluent))
    flat.add_objects(problem.all_objects)
    flat.add_actions(problem.actions)
    for fluent, value in problem.explicit_initial_values.items():
        flat.set_initial_value(fluent, value)
    for goal in problem.goals:
        flat.add_goal(goal)
    return flat
