"""``PlanValidator(name="casper")``: the framework's verdicts, with a reason for every refusal."""

import random
from fractions import Fraction

import pytest
from hypothesis import settings

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from unified_planning.engines.plan_validator import SequentialPlanValidator, TimeTriggeredPlanValidator
from unified_planning.engines.results import ValidationResultStatus
from unified_planning.model.htn import HierarchicalProblem
from unified_planning.plans import ActionInstance, PartialOrderPlan, PlanKind, SequentialPlan, TimeTriggeredPlan
from unified_planning.shortcuts import (
    And,
    BoolType,
    CompilationKind,
    Compiler,
    Fluent,
    InstantaneousAction,
    IntType,
    Not,
    Object,
    PlanValidator,
    Problem,
    UserType,
)

import casper.planning  # noqa: F401 (registers the engine)
from casper.planning.engine import CasperValidator, judge

VALID, INVALID, UNKNOWN = (ValidationResultStatus[name] for name in ("VALID", "INVALID", "UNKNOWN"))


def validated(problem, plan):
    with PlanValidator(name="casper") as validator:
        return validator.validate(problem, plan)


def reasons(problem, *actions, order=None) -> list[str]:
    """What is said of some steps, in a row or in a partial order."""
    plan = SequentialPlan(list(actions)) if order is None else PartialOrderPlan(order)
    return [message.message for message in validated(problem, plan).log_messages]


class Kitchen:
    """A meal is carried to the hobs and cooked there; the robot has one hand, and may carry so many things a day."""

    def __init__(self) -> None:
        thing, place = UserType("thing"), UserType("place")
        self.at = Fluent("at", BoolType(), thing=thing, place=place)
        self.cooked, self.free = Fluent("cooked", BoolType(), thing=thing), Fluent("free")
        self.carried = Fluent("carried", IntType(0, 2))
        self.problem = problem = Problem("kitchen")
        for fluent, value in ((self.at, False), (self.cooked, False), (self.free, True), (self.carried, 0)):
            problem.add_fluent(fluent, default_initial_value=value)
        carry = InstantaneousAction("carry", thing=thing, from_=place, to=place)
        carry.add_precondition(self.at(carry.thing, carry.from_))
        carry.add_effect(self.at(carry.thing, carry.from_), False)
        carry.add_effect(self.at(carry.thing, carry.to), True)
        carry.add_increase_effect(self.carried, 1)
        cook = InstantaneousAction("cook", thing=thing, place=place)
        cook.add_precondition(And(self.at(cook.thing, cook.place), Not(self.cooked(cook.thing))))
        cook.add_effect(self.cooked(cook.thing), True)
        problem.add_actions([carry, cook])
        self.meal, self.hobs, self.sink = Object("meal", thing), Object("hobs", place), Object("sink", place)
        problem.add_objects([self.meal, self.hobs, self.sink])
        problem.set_initial_value(self.at(self.meal, self.sink), True)
        problem.add_goal(self.cooked(self.meal))
        self._carry, self._cook = carry, cook

    def carry(self, *places: Object) -> ActionInstance:
        objects = [self.meal, *places]
        return ActionInstance(self._carry, tuple(map(self.problem.environment.expression_manager.ObjectExp, objects)))

    def cook(self, place: Object) -> ActionInstance:
        objects = [self.meal, place]
        return ActionInstance(self._cook, tuple(map(self.problem.environment.expression_manager.ObjectExp, objects)))


@pytest.fixture
def kitchen() -> Kitchen:
    return Kitchen()


# --- reasons --------------------------------------------------------------------------------------------------------


def test_a_plan_that_works_is_valid_and_needs_no_reason(kitchen: Kitchen) -> None:
    assert reasons(kitchen.problem, kitchen.carry(kitchen.sink, kitchen.hobs), kitchen.cook(kitchen.hobs)) == []


def test_what_nothing_makes_hold_is_told_with_the_step_that_took_it_away(kitchen: Kitchen) -> None:
    k = kitchen
    assert reasons(k.problem, k.cook(k.hobs)) == ["step 1, cook(meal, hobs): nothing makes at(meal, hobs) hold"]
    there_and_back = (k.carry(k.sink, k.hobs), k.carry(k.hobs, k.sink), k.cook(k.hobs))
    assert reasons(k.problem, *there_and_back) == [
        "step 3, cook(meal, hobs): nothing makes at(meal, hobs) hold; step 2 took it away"
    ]


def test_a_later_step_that_would_help_is_named(kitchen: Kitchen) -> None:
    k = kitchen
    (told,) = reasons(k.problem, k.cook(k.hobs), k.carry(k.sink, k.hobs))
    assert told.endswith("at(meal, hobs) does not hold; step 2, carry(meal, sink, hobs), makes it hold, but later")


def test_what_must_not_hold_is_told_with_the_step_that_made_it_so(kitchen: Kitchen) -> None:
    k = kitchen
    assert reasons(k.problem, k.cook(k.sink), k.cook(k.sink)) == [
        "step 2, cook(meal, sink): cooked(meal) holds; step 1 made it so"
    ]


def test_a_goal_that_is_not_reached_is_told(kitchen: Kitchen) -> None:
    assert reasons(kitchen.problem) == ["at the end: nothing makes cooked(meal) hold"]


def test_a_number_out_of_bounds_is_told(kitchen: Kitchen) -> None:
    k = kitchen
    there, back = k.carry(k.sink, k.hobs), k.carry(k.hobs, k.sink)
    (told,) = reasons(k.problem, there, back, there)
    assert told.startswith("step 3, carry(meal, sink, hobs)") and "bounds of a number" in told


def test_a_comparison_that_fails_is_told_with_its_values(kitchen: Kitchen) -> None:
    kitchen.problem.add_goal(kitchen.carried().Equals(2))
    told = reasons(kitchen.problem, kitchen.cook(kitchen.sink), kitchen.carry(kitchen.sink, kitchen.hobs))
    assert told == ["at the end: (carried == 2) does not hold: carried is 1 since step 2"]


def test_quantifiers_are_told_with_the_instance_that_fails(examples) -> None:
    problem = examples["basic_forall"].problem
    (told,) = reasons(problem)
    assert "for " in told or "hold" in told


def test_an_order_that_a_partial_plan_allows_and_that_fails_is_shown(kitchen: Kitchen) -> None:
    k = kitchen
    carry, cook = k.carry(k.sink, k.hobs), k.cook(k.hobs)
    assert reasons(k.problem, order={carry: [cook]}) == []
    (told,) = reasons(k.problem, order={carry: [], cook: []})
    assert "in the order cook(meal, hobs)" in told and "nothing makes" not in told.split(":")[0]


def test_what_is_not_supported_is_unknown_and_says_why(examples) -> None:
    for name in ("robot_continuous", "sched:basic"):
        result = CasperValidator()._validate(examples[name].problem, examples[name].valid_plans[0])
        assert result.status is UNKNOWN and "supported" in result.log_messages[0].message


# --- plans of others ------------------------------------------------------------------------------------------------


def test_a_plan_of_a_grounded_problem_is_one_of_the_lifted_problem(kitchen: Kitchen) -> None:
    k = kitchen
    with Compiler(problem_kind=k.problem.kind, compilation_kind=CompilationKind.GROUNDING) as compiler:
        grounded = compiler.compile(k.problem, CompilationKind.GROUNDING).problem
    by_name = {action.name: ActionInstance(action) for action in grounded.actions}
    good = SequentialPlan([by_name["carry_meal_sink_hobs"], by_name["cook_meal_hobs"]])
    assert validated(k.problem, good).status is VALID
    bad = SequentialPlan([by_name["cook_meal_hobs"]])
    assert validated(k.problem, bad).log_messages[0].message.startswith("step 1, cook(meal, hobs): nothing makes")


def test_an_action_that_the_problem_has_not_is_told(kitchen: Kitchen) -> None:
    (told,) = reasons(kitchen.problem, ActionInstance(InstantaneousAction("dance")))
    assert told == "the problem has no action dance; it has carry, cook"


def test_a_grounded_name_that_may_mean_two_things_is_told() -> None:
    problem, thing = Problem("two"), UserType("thing")
    one = InstantaneousAction("put", a=thing, b=thing)
    problem.add_action(one)
    problem.add_objects([Object(name, thing) for name in ("x", "x_y", "y_z", "z")])
    (told,) = reasons(problem, ActionInstance(InstantaneousAction("put_x_y_z")))
    assert "put(x, y_z)" in told and "put(x_y, z)" in told


def test_a_plan_of_a_copy_of_the_problem_is_taken(kitchen: Kitchen) -> None:
    k = kitchen
    plan = SequentialPlan([k.carry(k.sink, k.hobs), k.cook(k.hobs)])
    assert validated(Kitchen().problem, plan).status is VALID


# --- the framework's own validators ---------------------------------------------------------------------------------


def mutated(rng: random.Random, problem, plan):
    """A plan with something changed: a step dropped, doubled, moved, swapped with another, given another argument or
    another time; sometimes left as it is."""
    timed = isinstance(plan, TimeTriggeredPlan)
    steps = list(plan.timed_actions) if timed else [(None, action, None) for action in plan.actions]
    for _ in range(rng.choice([0, 1, 1, 1, 2])):
        if not steps:
            break
        at = rng.randrange(len(steps))
        kind = rng.choice(["drop", "double", "swap", "other", "argument", "time"])
        start, action, duration = steps[at]
        if kind == "drop":
            del steps[at]
        elif kind == "double":
            steps.insert(at, (start, ActionInstance(action.action, action.actual_parameters), duration))
        elif kind == "swap":
            other = rng.randrange(len(steps))
            a, b = steps[at], steps[other]
            steps[at], steps[other] = (a[0], b[1], b[2]), (b[0], a[1], a[2])
        elif kind == "argument":
            steps[at] = (start, with_another_argument(rng, problem, action), duration)
        elif kind == "time" and timed:
            steps[at] = (max(start + Fraction(rng.randint(-8, 8), 2), Fraction(0)), action, duration)
        elif kind == "other":
            others = [a for _, a, _ in steps]
            chosen = rng.choice(others)
            steps[at] = (start, ActionInstance(chosen.action, chosen.actual_parameters), duration)
    if timed:
        durative = [(s, a, d if hasattr(a.action, "duration") else None) for s, a, d in steps]
        fits = [(s, a, d) for s, a, d in durative if d is not None or not hasattr(a.action, "duration")]
        return TimeTriggeredPlan(fits, problem.environment)
    return SequentialPlan([action for _, action, _ in steps], problem.environment)


def with_another_argument(rng: random.Random, problem, action: ActionInstance) -> ActionInstance:
    values = list(action.actual_parameters)
    objects = [at for at, value in enumerate(values) if value.is_object_exp()]
    if objects:
        at = rng.choice(objects)
        same = list(problem.objects(action.action.parameters[at].type))
        values[at] = problem.environment.expression_manager.ObjectExp(rng.choice(same))
    return ActionInstance(action.action, tuple(values))


def test_random_plans_are_judged_as_the_framework_judges_them(examples) -> None:
    """Two hundred of them, in the thorough profile two thousand."""
    many = min(4 * settings.default.max_examples, 2000)
    rng, compared, refused = random.Random(20261130), 0, 0
    fitting = [
        (example.problem, plan)
        for example in examples.values()
        for plan in example.valid_plans
        if CasperValidator.supports(example.problem.kind)
        and not isinstance(example.problem, HierarchicalProblem)
        and plan.kind in (PlanKind.SEQUENTIAL_PLAN, PlanKind.TIME_TRIGGERED_PLAN)
    ]
    while compared < many:
        problem, plan = rng.choice(fitting)
        plan = mutated(rng, problem, plan)
        timed = plan.kind is PlanKind.TIME_TRIGGERED_PLAN
        theirs = (TimeTriggeredPlanValidator() if timed else SequentialPlanValidator()).validate(problem, plan)
        ours = judge(problem, plan)
        assert ours.valid == (theirs.status is VALID), (problem.name, plan, ours.reasons, theirs.log_messages)
        compared += 1
        if not ours.valid:
            refused += 1
            assert ours.reasons and all(reason.startswith(("step ", "at the end: ")) for reason in ours.reasons)
            assert ours.failure is theirs.reason
            assert all(reason.partition(": ")[2] for reason in ours.reasons)
    assert many / 4 < refused < many * 9 / 10  # both kinds were there


def test_a_partial_order_is_valid_exactly_when_all_its_rows_are(examples) -> None:
    from itertools import permutations

    rng = random.Random(7)
    small = [
        (e.problem, plan) for e in examples.values() for plan in e.valid_plans
        if plan.kind is PlanKind.SEQUENTIAL_PLAN and 1 < len(plan.actions) <= 4 and CasperValidator.supports(e.problem.kind)
    ]  # fmt: skip
    verdicts = set()
    for _ in range(settings.default.max_examples):
        problem, plan = rng.choice(small)
        steps = [ActionInstance(a.action, a.actual_parameters) for a in plan.actions]
        order = {step: [later for later in steps[at + 1 :] if rng.random() < 0.7] for at, step in enumerate(steps)}
        rows = [
            row for row in permutations(steps)
            if all(row.index(a) < row.index(b) for a, followers in order.items() for b in followers)
        ]  # fmt: skip
        expected = all(judge(problem, SequentialPlan(list(row))).valid for row in rows)
        assert judge(problem, PartialOrderPlan(order)).valid == expected
        verdicts.add(expected)
    assert verdicts == {True, False}
