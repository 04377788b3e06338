"""The kitchen's plans as relations among the others."""

from functools import cache

import pytest

from casper.engine.domain.domain import Domain
from casper.kb.text.writer import program_text
from casper.plans.library import PlanLibrary
from casper.plans.relations import plan_clauses


@cache
def kb():
    return Domain.load("kitchen").kb


def answers(goal):
    return {tuple(map(str, answer.values())) for answer in kb().query(goal)}


def test_the_steps_of_breakfast_are_numbered_from_one():
    assert answers("step(breakfast(biscuits), N, A)") == {
        ("1", "pick_and_place(biscuits, plate)"),
        ("2", "eat(biscuits, plate)"),
        ("3", "pick_and_place(plate, sink)"),
        ("4", "wash(plate, sink)"),
    }


def test_a_step_leads_back_to_its_goals():
    assert answers("step(G, _, wash(plate, sink))") == {("breakfast(biscuits)",), ("lunch(meal)",)}


@pytest.mark.parametrize(
    ("thing", "goals"),
    [
        ("plate", {"breakfast(biscuits)", "lunch(meal)"}),
        ("glass", {"drink(bottle)"}),
        ("hobs", {"lunch(meal)"}),
        ("sink", {"breakfast(biscuits)", "lunch(meal)", "drink(bottle)"}),
        ("biscuits", {"breakfast(biscuits)"}),
    ],
)
def test_the_goals_that_use_a_thing_are_a_query(thing, goals):
    assert answers(f"uses(G, {thing})") == {(goal,) for goal in goals}


def test_goals_and_the_tasks_below_them_are_tasks():
    assert answers("task(T)") == {(t,) for t in ("breakfast", "drink", "lunch", "prepare_meal", "warm", "clean")}


def test_the_goals_are_those_the_ontology_allows():
    assert answers("goal(G)") == {("breakfast(biscuits)",), ("drink(bottle)",), ("lunch(meal)",)}


def test_plans_join_with_the_ontology():
    assert answers("uses(G, X), eatable(X)") == {("breakfast(biscuits)", "biscuits"), ("lunch(meal)", "meal")}


def test_a_use_of_a_goal_has_a_proof():
    assert "goal(lunch(meal))" in str(kb().why("uses(lunch(meal), hobs)"))


@pytest.mark.parametrize(
    ("text", "clauses"),
    [
        (
            "tea(X) --> boil(pot), pour(pot, X).",
            "step(tea(X), 1, boil(pot)) :- goal(tea(X)).\n"
            "uses(tea(X), pot) :- goal(tea(X)).\n"
            "step(tea(X), 2, pour(pot, X)) :- goal(tea(X)).\n"
            "uses(tea(X), X) :- goal(tea(X)).\n"
            "before(tea(X), 1, 2) :- goal(tea(X)).\n"
            "task(tea).\n",
        ),
        (
            "goal(tea(mug)). goal(tea(X)). tea(mug) --> boil, wash(mug, Where).",  # one plan of two goals
            "step(Goal, Number, What) :- plan_step(Goal, Number, What), goal(Goal).\n"
            "plan_step(tea(mug), 1, boil).\n"
            "step(tea(mug), 2, wash(mug, Where)) :- goal(tea(mug)).\n"
            "uses(Goal, Number) :- plan_uses(Goal, Number), goal(Goal).\n"
            "plan_uses(tea(mug), mug).\n"
            "before(Goal, Number, What) :- plan_before(Goal, Number, What), goal(Goal).\n"
            "plan_before(tea(mug), 1, 2).\n"
            "task(tea).\n",
        ),
    ],
)
def test_rows_with_parameters_are_rules_and_others_facts_each_once(text, clauses):
    assert program_text(plan_clauses(PlanLibrary.from_text(text))) == clauses
