"""Plans of a hierarchy: the steps must work, and come from the tasks by the methods."""

import pytest

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from unified_planning.model.htn import HierarchicalProblem, Method
from unified_planning.plans import ActionInstance, HierarchicalPlan, SequentialPlan
from unified_planning.plans.hierarchical_plan import Decomposition, MethodInstance
from unified_planning.shortcuts import BoolType, Fluent, InstantaneousAction, UserType

from casper.planning.engine import judge


class Trip:
    """Getting to a place: nothing to do when one is there, else a step there, or a step somewhere and then the rest."""

    def __init__(self) -> None:
        self.problem = problem = HierarchicalProblem("trip")
        place = UserType("place")
        self.at = Fluent("at", BoolType(), place=place)
        problem.add_fluent(self.at, default_initial_value=False)
        self.move = move = InstantaneousAction("move", a=place, b=place)
        move.add_precondition(self.at(move.a))
        move.add_effect(self.at(move.a), False)
        move.add_effect(self.at(move.b), True)
        problem.add_action(move)
        self.places = [problem.add_object(name, place) for name in ("hall", "kitchen", "garden")]
        problem.set_initial_value(self.at(self.places[0]), True)
        go = problem.add_task("go", target=place)
        self.there = Method("there", target=place)
        self.there.set_task(go)
        self.there.add_precondition(self.at(self.there.parameter("target")))
        self.direct = Method("direct", a=place, target=place)
        self.direct.set_task(go, self.direct.parameter("target"))
        self.direct.add_precondition(self.at(self.direct.parameter("a")))
        self.inner = self.direct.add_subtask(move, self.direct.parameter("a"), self.direct.parameter("target"))
        problem.add_method(self.there)
        problem.add_method(self.direct)
        self.first = problem.task_network.add_subtask(go, self.places[1])
        self.second = problem.task_network.add_subtask(go, self.places[2])
        problem.task_network.set_ordered(self.first, self.second)

    def value(self, number: int):
        return self.problem.environment.expression_manager.ObjectExp(self.places[number])

    def step(self, a: int, b: int) -> ActionInstance:
        return ActionInstance(self.move, (self.value(a), self.value(b)))

    def directly(self, step: ActionInstance, a: int, b: int) -> MethodInstance:
        return MethodInstance(self.direct, (self.value(a), self.value(b)), Decomposition({self.inner.identifier: step}))

    def plan(self, steps, **done) -> HierarchicalPlan:
        named = {self.first.identifier: done["first"], self.second.identifier: done["second"]}
        return HierarchicalPlan(SequentialPlan(list(steps)), Decomposition(named))


@pytest.fixture
def trip() -> Trip:
    return Trip()


def said(trip: Trip, steps, **done) -> str:
    judgement = judge(trip.problem, trip.plan(steps, **done))
    assert (judgement.valid is True) == (not judgement.reasons)
    return "; ".join(judgement.reasons)


def test_a_plan_that_its_methods_make_is_valid(trip: Trip) -> None:
    one, two = trip.step(0, 1), trip.step(1, 2)
    assert said(trip, [one, two], first=trip.directly(one, 0, 1), second=trip.directly(two, 1, 2)) == ""


def test_the_steps_alone_must_work(trip: Trip) -> None:
    one, two = trip.step(1, 0), trip.step(1, 2)
    assert said(trip, [one, two], first=trip.directly(one, 1, 0), second=trip.directly(two, 1, 2)).startswith("step 1, move")


def test_a_method_for_another_argument_is_told(trip: Trip) -> None:
    one, two = trip.step(0, 2), trip.step(2, 1)
    told = said(trip, [one, two], first=trip.directly(one, 0, 2), second=trip.directly(two, 2, 1))
    assert "does not do go(kitchen)" in told


def test_tasks_done_in_the_wrong_order_are_told(trip: Trip) -> None:
    one, two, three = trip.step(0, 2), trip.step(2, 1), trip.step(1, 2)
    told = said(trip, [one, two, three], first=trip.directly(two, 2, 1), second=trip.directly(one, 0, 2))
    assert "go(kitchen) must be over before go(garden) begins" in told


def test_a_step_that_no_task_asks_for_is_told(trip: Trip) -> None:
    one, two, three = trip.step(0, 1), trip.step(1, 2), trip.step(2, 0)
    told = said(trip, [one, two, three], first=trip.directly(one, 0, 1), second=trip.directly(two, 1, 2))
    assert told == "move(garden, hall) is in the plan, but no task asks for it"


def test_a_step_that_is_not_in_the_plan_is_told(trip: Trip) -> None:
    one, two = trip.step(0, 1), trip.step(1, 2)
    assert "not among the steps" in said(trip, [one], first=trip.directly(one, 0, 1), second=trip.directly(two, 1, 2))


def test_a_task_that_nothing_does_is_told(trip: Trip) -> None:
    one = trip.step(0, 1)
    plan = HierarchicalPlan(SequentialPlan([one]), Decomposition({trip.first.identifier: trip.directly(one, 0, 1)}))
    assert "nothing does go(garden)" in judge(trip.problem, plan).reasons[0]


def test_a_method_without_steps_needs_its_condition_at_some_moment_of_its_turn(trip: Trip) -> None:
    one, two, three = trip.step(0, 2), trip.step(2, 1), trip.step(1, 2)
    empty = MethodInstance(trip.there, (trip.value(2),), Decomposition({}))
    good = trip.plan([one, two, three], first=trip.directly(two, 2, 1), second=empty)
    assert "no task asks" in judge(trip.problem, good).reasons[0]  # but the method's condition holds at the end
    told = said(trip, [trip.step(0, 1)], first=MethodInstance(trip.there, (trip.value(1),), Decomposition({})), second=empty)
    assert "cannot be chosen here" in told


def test_the_framework_s_own_examples_are_valid(examples) -> None:
    for name in ("htn-go", "htn-go-temporal"):
        for plan in examples[name].valid_plans:
            assert judge(examples[name].problem, plan).valid is True


def test_a_flat_plan_of_a_hierarchy_cannot_be_judged(trip: Trip) -> None:
    judgement = judge(trip.problem, SequentialPlan([trip.step(0, 1)]))
    assert judgement.valid is None and "decomposition" in judgement.reasons[0]
