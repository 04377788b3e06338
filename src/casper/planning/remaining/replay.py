"""Actions of a reading as actions of a problem, done one after another in the framework's simulator."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from unified_planning.engines.sequential_simulator import UPSequentialSimulator
from unified_planning.model import Problem
from unified_planning.model.fluent import get_all_fluent_exp
from unified_planning.plans import ActionInstance

from casper.engine.verification.observation import Observation, Uncertain
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.planning.importing.names import inward, outward
from casper.planning.importing.vocabulary import Vocabulary
from casper.planning.validation.history import History
from casper.planning.validation.judgement import step_name
from casper.planning.validation.reasons import Reasons

MOST_INSTANCES = 10_000  # that an action with unknown arguments may stand for


class Blocked(CasperError):
    """An action that cannot be done where it stands."""


@dataclass
class Course:
    """The states so far, and the names of the steps between them."""

    vocabulary: Vocabulary
    simulator: Any
    states: list[Any] = field(default_factory=list)
    steps: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.states = [self.simulator.get_initial_state()]

    @property
    def problem(self) -> Problem:
        """The problem whose states they are."""
        return self.vocabulary.problem

    def fork(self) -> Course:
        """A course that goes its own way from here."""
        other = Course(self.vocabulary, self.simulator)
        other.states, other.steps = list(self.states), list(self.steps)
        return other

    def do(self, action: Compound, agents: Sequence[str]) -> None:
        """Do an action of a reading, by the first of the agents who can.

        Raises:
            Blocked: nobody can, with the reasons.
            CasperError: the problem has no such action, or it is not clear which one is meant.
        """
        able = self.ways(action, agents)
        if not able:
            raise Blocked(self.why_not(action, agents))
        if len(able) > 1 and any(isinstance(argument, Variable) for argument in action.args):
            shown = " or ".join(str(each) for each in able[:3])
            raise CasperError(f"{term_text(as_term(action))} may be {shown}: say which one it is")
        later = self.after(able[0])
        self.states, self.steps = later.states, later.steps

    def ways(self, action: Compound, agents: Sequence[str]) -> list[ActionInstance]:
        """The actions of the problem that an action may be and that can be done now."""
        found = [instance for agent in agents for instance in self._instances(action, agent)]
        able = [each for each in found if self.simulator.is_applicable(self.states[-1], each)]
        return list({str(each): each for each in able}.values())

    def after(self, instance: ActionInstance) -> Course:
        """The course with one step more."""
        other = self.fork()
        other.states.append(self.simulator.apply(self.states[-1], instance))
        other.steps.append(step_name(len(self.steps) + 1, instance))
        return other

    def reaches_goal(self, steps: Sequence[ActionInstance]) -> bool:
        """Whether the steps can be done from here, one after the other, and the goal holds then."""
        state = self.states[-1]
        for step in steps:
            if not self.simulator.is_applicable(state, step):
                return False
            state = self.simulator.apply(state, step)
        return bool(self.simulator.is_goal(state))

    def missing(self) -> list[str]:
        """What of the goal does not hold, in sentences."""
        reasons = Reasons(self.problem, History(self.states, self.steps))
        return [reason for goal in self.problem.goals for reason in reasons.why_not(goal)]

    def from_here(self) -> Problem:
        """The problem with the state that is reached as its first one."""
        problem = self.problem.clone()
        for fluent in problem.fluents:
            for expression in get_all_fluent_exp(problem, fluent):
                problem.set_initial_value(expression, self.states[-1].get_value(expression))
        return problem

    # --- which action it is ------------------------------------------------------------------------------------------

    def _instances(self, action: Compound, agent: str) -> Iterator[ActionInstance]:
        """What an action may be in the problem, done by an agent."""
        named = self.problem.action(self._name(action))
        at = agent_place(self.vocabulary, named, len(action.args), agent)
        arguments: list[Term] = list(action.args)
        if at is not None:
            arguments.insert(at, agent)
        if len(arguments) != len(named.parameters):
            told = f"{len(named.parameters)} arguments, and {term_text(as_term(action))} has {len(arguments)}"
            raise CasperError(f"{named.name} of the problem takes {told}: is it the problem of this domain?")
        choices = [self._things(argument, p.type) for argument, p in zip(arguments, named.parameters)]
        for count, things in enumerate(product(*choices)):
            if count >= MOST_INSTANCES:
                raise CasperError(f"{term_text(as_term(action))} may be too many actions: say more of it")
            if _agrees(arguments, things):
                manager = self.problem.environment.expression_manager
                yield ActionInstance(named, tuple(manager.ObjectExp(thing) for thing in things))

    def _name(self, action: Compound) -> str:
        for name in (inward(action.functor), action.functor):
            if self.problem.has_action(name):
                return name
        known = ", ".join(sorted(each.name for each in self.problem.actions)) or "none"
        raise CasperError(f"the problem has no action {action.functor}; it has {known}: is it of this domain?")

    def _things(self, argument: Term, kind: Any) -> list[Any]:
        there = list(self.problem.objects(kind)) if kind.is_user_type() else []
        if isinstance(argument, Variable):
            return there
        found = [thing for thing in there if thing.name == argument]
        if not found:
            raise CasperError(f"the problem has no {kind} {term_text(argument)}: is it the problem of this domain?")
        return found

    def why_not(self, action: Compound, agents: Sequence[str]) -> str:
        """Why nobody can do it, told of the first who might."""
        found = [instance for agent in agents for instance in self._instances(action, agent)]
        name = f"step {len(self.steps) + 1}, {term_text(as_term(action))}"
        reasons = Reasons(self.problem, History(self.states, self.steps))
        for instance in found[:1]:
            values = dict(zip(instance.action.parameters, instance.actual_parameters))
            conditions = [condition.substitute(values) for condition in instance.action.preconditions]
            why = [reason for condition in conditions for reason in reasons.why_not(condition)]
            return f"{name}: {'; '.join(why) or 'it would leave a fluent out of its bounds'}"
        return f"{name}: there is no such action in the problem"


def agent_place(vocabulary: Vocabulary, action: Any, given: int, agent: str) -> int | None:
    """Where an action of a problem says who does it; None: it does not.

    It is the first parameter of the stated type of agents. Where none is stated and the action has one argument more
    than in the domain, it is the first parameter that the agent fits.
    """
    stated = vocabulary.agent_index(action)
    if stated is not None or vocabulary.agent_type is not None or len(action.parameters) != given + 1:
        return stated
    return next((at for at, p in enumerate(action.parameters) if _fits(vocabulary.problem, agent, p.type)), None)


def _fits(problem: Problem, name: str, kind: Any) -> bool:
    return kind.is_user_type() and any(thing.name == name for thing in problem.objects(kind))


def _agrees(arguments: Sequence[Term], things: Sequence[Any]) -> bool:
    """Whether the same variable is the same thing everywhere."""
    known: dict[Term, Any] = {}
    return all(not isinstance(a, Variable) or known.setdefault(a, t) == t for a, t in zip(arguments, things))


def as_action(vocabulary: Vocabulary, instance: ActionInstance, arity: int | None, agents: Iterable[str]) -> tuple[
    Compound, str | None
]:
    """An action of the problem as one of the domain, and who does it, where it says so.

    ``arity`` is how many arguments the domain's action takes without its agent; None: the domain does not know it.
    """
    names = [str(value.object().name) for value in instance.actual_parameters]
    at = vocabulary.agent_index(instance.action)
    if at is None and arity is not None and len(names) == arity + 1:
        places = [agent_place(vocabulary, instance.action, arity, agent) for agent in agents]
        at = next((place for place in places if place is not None), None)
    who = None if at is None else names.pop(at)
    return Compound((outward(instance.action.name), *names)), who


def seen_action(seen: Observation | Uncertain) -> Compound:
    """What was observed as an action with variables for what is not known.

    Raises:
        CasperError: it is not known which action it was.
    """
    if isinstance(seen, Uncertain):
        raise CasperError(f"it is not certain what was seen ({seen}), so the state after it is not known")
    if seen.args is None:
        raise CasperError(f"of {seen} no arguments were seen, so the state after it is not known: observe it with them")
    return Compound((seen.action, *seen.args))


def simulated(vocabulary: Vocabulary) -> Course:
    """A course that begins with the problem's first state.

    Raises:
        CasperError: the framework's simulator cannot do such a problem.
    """
    if not UPSequentialSimulator.supports(vocabulary.problem.kind):
        beyond = sorted(vocabulary.problem.kind.features - UPSequentialSimulator.supported_kind().features)
        raise CasperError(f"such a problem cannot be simulated: {', '.join(beyond)}")
    return Course(vocabulary, UPSequentialSimulator(vocabulary.problem))
