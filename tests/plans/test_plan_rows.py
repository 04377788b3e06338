"""The rows that plans with shapes give: what comes before what, what may be left out, what is done instead."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.plans.library import PlanLibrary
from casper.plans.relations import RELATIONS, plan_clauses


def answers(body, goal, more=""):
    kb = KnowledgeBase.from_text("goal(g).")
    kb.add(plan_clauses(PlanLibrary.from_text(f"goal(g). g --> {body}. {more}")))
    return sorted(tuple(answer.values()) for answer in kb.query(goal))


@pytest.mark.parametrize(
    ("body", "rows"),
    [
        ("a, b, c", [(1, 2), (2, 3)]),
        ("unordered(a, b), c", [(1, 3), (2, 3)]),
        ("a, unordered((b, c), d)", [(1, 2), (1, 4), (2, 3)]),
        ("a, b, unordered(c, d)", [(1, 2), (2, 3), (2, 4)]),
    ],
)
def test_before_relates_leaves_that_follow_one_another(body, rows):
    assert answers(body, "before(g, N, M)") == rows


def test_optional_leaves_are_those_in_a_part():
    assert answers("a, optional(b), (c ; d), e", "optional(g, N)") == [(2,), (3,), (4,)]


def test_alternatives_are_numbered_with_their_choices_and_leaves():
    rows = [(1, 1, 2), (1, 2, 3), (1, 2, 4), (2, 1, 5), (2, 2, 6)]
    assert answers("a, (b ; c, d), (e ; f)", "alternative(g, C, A, N)") == rows


def test_a_leaf_in_a_choice_within_a_choice_stands_in_an_alternative_of_each():
    assert answers("(a ; b, (c ; d))", "alternative(g, C, A, 4)") == [(1, 2), (2, 2)]


def test_nothing_holds_of_a_goal_that_the_knowledge_base_does_not_allow():
    kb = KnowledgeBase.from_text(":- dynamic(goal/1).")
    kb.add(plan_clauses(PlanLibrary.from_text("goal(g). g --> a, b.")))
    assert list(kb.query("step(g, N, A)")) == []


def test_a_thing_used_twice_is_told_once():
    clauses = [str(clause.head) for clause in plan_clauses(PlanLibrary.from_text("goal(g). g --> a(mug), b(mug)."))]
    assert clauses.count("plan_uses(g, mug)") == 1


def test_the_relations_are_all_that_clauses_are_made_of():
    shaped = PlanLibrary.from_text("goal(g). g --> a(mug), optional(b), (c ; d), e.")
    open_ = PlanLibrary.from_text("goal(g(X)). g(X) --> a(X), b(X).")
    made = {clause.head.indicator for library in (shaped, open_) for clause in plan_clauses(library)}
    assert made == set(RELATIONS)
