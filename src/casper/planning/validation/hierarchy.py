"""Plans of a hierarchy: every task is done by a method of it or an action, in the methods' orders, down to the plan.

A method's preconditions must hold at some moment after all that must come before the method, and not after its own
first step (as in HDDL, where they are compiled into a first step without effects).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

from unified_planning.model import FNode, State
from unified_planning.model.htn import HierarchicalProblem, Method
from unified_planning.plans import ActionInstance, HierarchicalPlan, SequentialPlan, TimeTriggeredPlan
from unified_planning.plans.hierarchical_plan import Decomposition, MethodInstance

from casper.planning.validation.history import History
from casper.planning.validation.judgement import Judgement, action_name
from casper.planning.validation.reasons import Reasons
from casper.planning.validation.stepping import judge_sequence
from casper.planning.validation.timed import judge_timed
from casper.planning.validation.times import holds

Time: TypeAlias = Fraction
Values: TypeAlias = Mapping[Any, FNode]  # of parameters, as expressions
_BEGIN, _END = Fraction(-1), Fraction(10**15)


class _Wrong(Exception):
    """What does not fit; ``unknown`` when it cannot be judged."""

    def __init__(self, sentence: str, unknown: bool = False) -> None:
        super().__init__(sentence)
        self.unknown = unknown


@dataclass(frozen=True)
class _Span:
    """When a task is done: from the start of its first step to the end of its last; None for one without steps."""

    start: Time
    end: Time


def judge_hierarchical(problem: HierarchicalProblem, plan: HierarchicalPlan) -> Judgement:
    """The steps as a plan of their own, then how they come from the tasks."""
    flat = plan.action_plan
    if isinstance(flat, SequentialPlan):
        judgement = judge_sequence(problem, flat.actions)
    else:
        judgement = judge_timed(problem, flat)
    if not judgement.valid:
        return judgement
    try:
        _Hierarchy(problem, plan, judgement.trace).check()
    except _Wrong as wrong:
        if wrong.unknown:
            return Judgement(None, (str(wrong),))
        return Judgement.shape_fails(str(wrong))
    return judgement


class _Hierarchy:
    def __init__(self, problem: HierarchicalProblem, plan: HierarchicalPlan, trace: Any) -> None:
        self.problem, self.plan = problem, plan
        self.manager = problem.environment.expression_manager
        self.moments = _moments(trace)
        self.times = dict(_times(plan.action_plan))
        self.used: set[int] = set()

    def check(self) -> None:
        """Raise `_Wrong` for the first thing that does not fit."""
        network, decomposition = self.problem.task_network, self.plan.decomposition
        values = self._variables(network, decomposition)
        self._network("the initial tasks", network, values, decomposition, _BEGIN, _END)
        left = [action for key, (action, _) in self.times.items() if key not in self.used]
        if left:
            raise _Wrong(f"{action_name(left[0])} is in the plan, but no task asks for it")

    # --- a network of tasks ----------------------------------------------------------------------------------------

    def _network(
        self, name: str, network: Any, values: Values, decomposition: Decomposition, after: Time, until: Time
    ) -> _Span | None:
        """Check the tasks of a network, all between two moments; when they are done."""
        self._complete(name, network, decomposition)
        self._constraints(name, network, values)
        order = network.partial_order()
        extents = {task.identifier: self._extent(decomposition.subtasks[task.identifier]) for task in network.subtasks}
        if order is None:
            order = self._timed(name, network, extents)
        self._ordered(name, network, extents, order)
        for task in network.subtasks:
            earlier = [extents[a] for a in _before(task.identifier, order) if extents[a]]
            later = [extents[b] for b in _after(task.identifier, order) if extents[b]]
            begin = max([after, *(span.end for span in earlier if span)])
            end = min([until, *(span.start for span in later if span)])
            self._task(name, task, values, decomposition.subtasks[task.identifier], begin, end)
        spans = [span for span in extents.values() if span]
        return _Span(min(s.start for s in spans), max(s.end for s in spans)) if spans else None

    def _complete(self, name: str, network: Any, decomposition: Decomposition) -> None:
        wanted = {task.identifier: task for task in network.subtasks}
        for identifier, task in wanted.items():
            if identifier not in decomposition.subtasks:
                raise _Wrong(f"{name}: nothing does {_told(task)}")
        for identifier in decomposition.subtasks:
            if identifier not in wanted:
                raise _Wrong(f"{name}: there is no task {identifier}")

    def _constraints(self, name: str, network: Any, values: Values) -> None:
        for constraint in network.non_temporal_constraints():
            held = constraint.substitute(values).simplify()
            if not (held.is_bool_constant() and held.bool_constant_value()):
                raise _Wrong(f"{name}: the constraint {constraint} does not hold with {_shown(values)}")

    def _ordered(self, name: str, network: Any, extents: Mapping[str, _Span | None], order: Any) -> None:
        for first, second in order:
            before, then = extents[first], extents[second]
            if before and then and before.end > then.start:
                one, other = (_told(network.get_subtask(each)) for each in (first, second))
                raise _Wrong(f"{name}: {one} must be over before {other} begins, and is not")

    def _timed(self, name: str, network: Any, extents: Mapping[str, _Span | None]) -> list[tuple[str, str]]:
        """Check an order with delays between the times of tasks; nothing is left of it to be kept."""
        times: dict[tuple[str, bool], Time | None] = {}
        for identifier, span in extents.items():
            times[identifier, True] = span.start if span else None
            times[identifier, False] = span.end if span else None
        for constraint in network.temporal_constraints():
            held = holds(constraint, times)
            if held is None:
                told = f"whether {constraint} holds cannot be told: a task in it has no step"
                raise _Wrong(f"{name}: {told}", unknown=True)
            if not held:
                raise _Wrong(f"{name}: {constraint} does not hold")
        return []

    # --- one task --------------------------------------------------------------------------------------------------

    def _task(self, name: str, task: Any, values: Values, done: Any, begin: Time, end: Time) -> None:
        wanted = [argument.substitute(values).simplify() for argument in task.parameters]
        if isinstance(done, ActionInstance):
            self._action(name, task, wanted, done)
        else:
            self._method(name, task, wanted, done, begin, end)

    def _action(self, name: str, task: Any, wanted: Sequence[FNode], done: ActionInstance) -> None:
        if task.task != done.action:
            raise _Wrong(f"{name}: {_told(task)} is not done by {action_name(done)}")
        if list(done.actual_parameters) != list(wanted):
            raise _Wrong(f"{name}: {action_name(done)} is not {task.task.name}({', '.join(map(str, wanted))})")
        if id(done) in self.used:
            raise _Wrong(f"{name}: {action_name(done)} does two tasks")
        self.used.add(id(done))

    def _method(
        self, name: str, task: Any, wanted: Sequence[FNode], done: MethodInstance, begin: Time, end: Time
    ) -> None:
        method: Method = done.method
        if method not in self.problem.methods:
            raise _Wrong(f"{name}: the problem has no method {method.name}")
        if method.achieved_task.task != task.task:
            own = method.achieved_task.task.name
            raise _Wrong(f"{name}: the method {method.name} is for {own}, not {task.task.name}")
        values = self._bound(method, done.parameters)
        given = [values[self.manager.ParameterExp(parameter)] for parameter in method.achieved_task.parameters]
        if given != list(wanted):
            shown = ", ".join(map(str, wanted))
            raise _Wrong(f"{name}: {method.name}({_shown(values)}) does not do {task.task.name}({shown})")
        span = self._extent(done)
        self._preconditions(method, values, begin, span.start if span else end)
        inner = f"the method {method.name}({_shown(values)})"
        self._network(inner, method, values, done.decomposition, begin, end)

    def _bound(self, method: Method, parameters: Sequence[FNode]) -> dict[Any, FNode]:
        if len(method.parameters) != len(parameters):
            raise _Wrong(f"the method {method.name} takes {len(method.parameters)} arguments, not {len(parameters)}")
        return {self.manager.ParameterExp(p): value for p, value in zip(method.parameters, parameters)}

    def _preconditions(self, method: Method, values: Values, begin: Time, end: Time) -> None:
        conditions = [condition.substitute(values) for condition in method.preconditions]
        if not conditions:
            return
        between = _between(self.moments, begin, end)
        for _, state in between:
            reasons = Reasons(self.problem, History([state], []))
            if all(reasons.holds(condition) for condition in conditions):
                return
        states = [state for time, state in self.moments if time <= between[-1][0]]
        names = [f"step {number}" for number in range(1, len(states))]
        last = Reasons(self.problem, History(states, names))
        why = [reason for condition in conditions for reason in last.why_not(condition)]
        told = "; ".join(why) or "its conditions hold at no moment together"
        raise _Wrong(f"the method {method.name}({_shown(values)}) cannot be chosen here: {told}")

    # --- when ------------------------------------------------------------------------------------------------------

    def _extent(self, done: Any) -> _Span | None:
        spans = [self._span(action) for action in _actions(done)]
        return _Span(min(s.start for s in spans), max(s.end for s in spans)) if spans else None

    def _span(self, action: ActionInstance) -> _Span:
        if id(action) not in self.times:
            raise _Wrong(f"{action_name(action)} does a task, but is not among the steps of the plan")
        return self.times[id(action)][1]

    def _variables(self, network: Any, decomposition: Decomposition) -> dict[Any, FNode]:
        """What the variables of the initial network are: read off what its tasks were done with."""
        values: dict[Any, FNode] = {}
        free = {self.manager.ParameterExp(variable) for variable in network.variables}
        for task in network.subtasks:
            done = decomposition.subtasks.get(task.identifier)
            for written, given in zip(task.parameters, self._arguments(done)):
                if written in free and values.setdefault(written, given) != given:
                    first = values[written]
                    raise _Wrong(f"the initial tasks: {written} is {first} in one task and {given} in another")
        return values

    def _arguments(self, done: Any) -> Sequence[FNode]:
        if isinstance(done, ActionInstance):
            return list(done.actual_parameters)
        if isinstance(done, MethodInstance):
            values = self._bound(done.method, done.parameters)
            return [values[self.manager.ParameterExp(p)] for p in done.method.achieved_task.parameters]
        return []


def _moments(trace: Any) -> list[tuple[Time, State]]:
    """From when on each state holds."""
    if isinstance(trace, dict):
        return [(time, trace[time]) for time in sorted(trace)]
    return [(Fraction(number), state) for number, state in enumerate(trace)]


def _between(moments: Sequence[tuple[Time, State]], begin: Time, end: Time) -> list[tuple[Time, State]]:
    """The states that hold at some moment from ``begin`` to ``end``: at least the one at ``begin``."""
    at = max((number for number, (time, _) in enumerate(moments) if time <= begin), default=0)
    return [moments[at], *(moment for moment in moments[at + 1 :] if moment[0] <= end)]


def _times(flat: SequentialPlan | TimeTriggeredPlan) -> Iterator[tuple[int, tuple[ActionInstance, _Span]]]:
    """When each step is done, by its identity: equal steps are told apart."""
    if isinstance(flat, SequentialPlan):
        for number, action in enumerate(flat.actions):
            yield id(action), (action, _Span(Fraction(number), Fraction(number)))
    else:
        for start, action, duration in flat.timed_actions:
            yield id(action), (action, _Span(start, start + (duration or 0)))


def _actions(done: Any) -> Iterator[ActionInstance]:
    if isinstance(done, ActionInstance):
        yield done
    else:
        for below in done.decomposition.subtasks.values():
            yield from _actions(below)


def _before(identifier: str, order: Sequence[tuple[str, str]]) -> set[str]:
    return _reached(identifier, [(b, a) for a, b in order])


def _after(identifier: str, order: Sequence[tuple[str, str]]) -> set[str]:
    return _reached(identifier, order)


def _reached(identifier: str, arrows: Sequence[tuple[str, str]]) -> set[str]:
    found: set[str] = set()
    waiting = [identifier]
    while waiting:
        here = waiting.pop()
        new = {b for a, b in arrows if a == here} - found
        found |= new
        waiting.extend(new)
    return found


def _told(task: Any) -> str:
    return f"{task.task.name}({', '.join(map(str, task.parameters))})"


def _shown(values: Values) -> str:
    return ", ".join(f"{parameter} = {value}" for parameter, value in values.items())
