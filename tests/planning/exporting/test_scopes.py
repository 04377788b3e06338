"""What is read within *for all*, *there is* and *not* is read there alone: on the way in, and on the way back."""

from itertools import product

import pytest

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from planning_problems import FUEL, HOME, PLACE, VEHICLE
from unified_planning.engines.sequential_simulator import UPSequentialSimulator
from unified_planning.model import Variable
from unified_planning.model.htn import HierarchicalProblem, Method
from unified_planning.shortcuts import (
    GE,
    LT,
    And,
    Equals,
    Exists,
    Forall,
    Iff,
    InstantaneousAction,
    Not,
    Object,
    Or,
    Problem,
)

from casper import Domain
from casper.planning import import_problem, to_problem

OTHER = Object("truck-1", VEHICLE)
X, Y = Variable("x", PLACE), Variable("y", VEHICLE)


def always(v):
    return Forall(LT(FUEL(v), FUEL(v) + 1), X)


CONDITIONS = {
    "a number for all": lambda v, a: always(v),
    "the same number twice, each for all": lambda v, a: And(always(v), always(v)),
    "two numbers, each for all": lambda v, a: And(always(v), always(OTHER)),
    "for all, and then another's by itself": lambda v, a: And(always(v), GE(FUEL(OTHER), 2)),
    "by itself, and then for all": lambda v, a: And(GE(FUEL(OTHER), 2), always(v)),
    "a number under not": lambda v, a: And(Not(GE(FUEL(v), 2)), Not(GE(FUEL(OTHER), 2))),
    "not for all": lambda v, a: And(Not(Forall(GE(FUEL(v), 2), X)), Not(Forall(GE(FUEL(OTHER), 2), X))),
    "for all, one or the other": lambda v, a: Forall(Or(GE(FUEL(v), 2), GE(FUEL(OTHER), 2)), X),
    "for all of several, one or the other": lambda v, a: And(
        Forall(Or(GE(FUEL(Y), 2), Equals(HOME(Y), a)), Y), Forall(Or(GE(FUEL(Y), 1), Equals(HOME(Y), a)), Y)
    ),
    "for all there is": lambda v, a: Forall(Exists(And(Equals(HOME(Y), X), GE(FUEL(Y), 1)), Y), X),
    "for all there is, and there is": lambda v, a: And(
        Forall(Or(Equals(X, a), Exists(Equals(HOME(Y), X), Y)), X), Exists(GE(FUEL(Y), 2), Y)
    ),
    "for all for all": lambda v, a: And(Forall(Forall(Or(LT(FUEL(Y), 2), Equals(HOME(Y), X)), Y), X), GE(FUEL(v), 1)),
    "there is none": lambda v, a: And(Not(Exists(GE(FUEL(Y), 2), Y)), Not(Exists(Equals(HOME(Y), a), Y))),
    "a thing, for all": lambda v, a: And(Forall(Not(And(Equals(HOME(v), X), Equals(X, a))), X), Equals(HOME(OTHER), a)),
    "both or neither": lambda v, a: Iff(Forall(GE(FUEL(v), 2), X), Exists(GE(FUEL(Y), 2), Y)),
}


def base(problem, fuels=(1, 2), homes=(0, 1)):
    places, vehicles = [Object(f"place{n}", PLACE) for n in range(2)], [Object("truck-0", VEHICLE), OTHER]
    for fluent in (FUEL, HOME):
        problem.add_fluent(fluent)
    problem.add_objects([*places, *vehicles])
    for vehicle, fuel, home in zip(vehicles, fuels, homes):
        problem.set_initial_value(FUEL(vehicle), fuel)
        problem.set_initial_value(HOME(vehicle), places[home])
    problem.add_goal(GE(FUEL(OTHER), 5))
    return problem


def trip(condition, asked=True, **state):
    """A problem whose one action has the condition as its precondition, or as that of its effects."""
    action = InstantaneousAction("trip", v=VEHICLE, a=PLACE)
    v, a = action.parameters
    if asked:
        action.add_precondition(condition(v, a))
    action.add_increase_effect(FUEL(v), FUEL(OTHER), True if asked else condition(v, a))
    action.add_effect(HOME(v), a, True if asked else condition(v, a))
    problem = base(Problem("trips"), **state)
    problem.add_action(action)
    return problem


def unchanged(problem):
    first = import_problem(problem)
    return first.files == import_problem(to_problem(first.domain())).files


@pytest.mark.parametrize("asked", [True, False], ids=["asked before", "of an effect"])
@pytest.mark.parametrize("name", CONDITIONS)
def test_it_comes_back_unchanged(name, asked):
    assert unchanged(trip(CONDITIONS[name], asked))


@pytest.mark.parametrize("name", CONDITIONS)
def test_it_means_what_the_simulator_says(name):
    for fuels, homes in (((0, 2), (0, 1)), ((2, 1), (1, 1))):
        problem = trip(CONDITIONS[name], fuels=fuels, homes=homes)
        kb = import_problem(problem).domain().kb
        with UPSequentialSimulator(problem, error_on_failed_checks=False) as simulator:
            state = simulator.get_initial_state()
            for things in product(problem.objects(VEHICLE), problem.objects(PLACE)):
                can = simulator.is_applicable(state, problem.action("trip"), things)
                said = kb.verify(f"trip(human, '{things[0]}', {things[1]})").valid
                assert said is can, (fuels, homes, things)


def test_a_method_may_ask_for_numbers_for_all_and_by_itself():
    problem = base(HierarchicalProblem("trips"))
    action = InstantaneousAction("trip", v=VEHICLE)
    problem.add_action(action)
    task = problem.add_task("refuel", v=VEHICLE)
    method = Method("m-refuel", v=VEHICLE)
    method.set_task(task, *method.parameters)
    v = method.parameter("v")
    method.add_precondition(And(always(v), GE(FUEL(OTHER), 1)))
    method.add_subtask(action, v)
    problem.add_method(method)
    problem.task_network.add_subtask(task, OTHER)
    assert unchanged(problem)


def written(folder, condition):
    """A precondition in an author's own words, as a problem says it."""
    import_problem(trip(lambda v, a: GE(FUEL(v), 0))).write(folder)
    text = (folder / "ontology.pl").read_text()
    asked = "value(fuel(V), Fuel, now), 0 =< Fuel"
    assert asked in text
    (folder / "ontology.pl").write_text(text.replace(asked, condition))
    return str(to_problem(Domain.load(folder)).action("trip").preconditions)


def test_a_name_means_what_binds_it_behind_a_condition_too(tmp_path):
    said = written(
        tmp_path / "d", "forall(place(X), value(fuel(V), Fuel, now)), Fuel > 1, value(fuel('truck-1'), Fuel, now)"
    )
    assert said == "[Forall (place x) (fuel(v) == fuel(truck-1)), (1 < fuel(truck-1))]"


def test_a_value_that_nobody_names_is_not_compared(tmp_path):
    assert written(tmp_path / "d", "value(fuel(V), _, now), value(fuel('truck-1'), _, now)") == "[]"
