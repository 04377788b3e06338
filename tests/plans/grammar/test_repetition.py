"""Repetition and recursion in plans, and the bounds of both."""

import pytest

from casper.kb.errors import Place, PlanError
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_text
from casper.plans.grammar.expansion import expand
from casper.plans.grammar.shapes import partial_order
from casper.plans.library import PlanLibrary


def rows(text):
    return sorted(" ".join(map(str, plan.leaves)) for plan in PlanLibrary.from_text(text).plans)


@pytest.mark.parametrize(
    ("body", "plans"),
    [
        ("repeat(a, 1, 3)", ["a", "a a", "a a a"]),
        ("repeat(a, 2, 2)", ["a a"]),
        ("b, repeat(a, 0, 1)", ["b", "b a"]),
        ("repeat((a, b), 1, 2)", ["a b", "a b a b"]),
    ],
)
def test_repeat_does_an_item_from_so_often_to_so_often(body, plans):
    assert rows(f"goal(g). g --> {body}.") == plans


@pytest.mark.parametrize("bounds", ["2, 1", "-1, 2", "0, 0", "1.0, 2", "1, x", "1"])
def test_bounds_that_are_none_are_refused(bounds):
    with pytest.raises(PlanError, match="repeat takes an item and two whole numbers"):
        PlanLibrary.from_text(f"goal(g). g --> a, repeat(b, {bounds}).")


def test_a_thousand_times_is_allowed_and_once_more_is_not():
    (plan,) = PlanLibrary.from_text("goal(g). g --> repeat(a, 1000, 1000).").ways
    assert len(plan.leaves) == 1000
    with pytest.raises(PlanError, match="at most 1000 times, not 1001"):
        PlanLibrary.from_text("goal(g). g --> repeat(a, 1, 1001).")


def test_a_goal_of_too_many_steps_is_refused():
    with pytest.raises(PlanError, match="a goal has more than 20000 steps"):
        _ = PlanLibrary.from_text("goal(g). g --> repeat(repeat(a, 150, 150), 150, 150).").ways


def test_each_goal_has_its_own_share_of_steps():
    body = ", ".join(["repeat(repeat(a, 100, 100), 100, 100)"])
    assert len(PlanLibrary.from_text(f"goal(g). goal(h). goal(i). g --> {body}. h --> {body}. i --> {body}.").ways) == 3


@pytest.mark.parametrize(
    ("depth", "plans"), [(1, ["a", "a a"]), (2, ["a", "a a", "a a a"]), (3, ["a", "a a", "a a a", "a a a a"])]
)
def test_a_task_may_stand_inside_itself_as_often_as_is_stated(depth, plans):
    assert rows(f"setting(plans, recursion, {depth}). goal(g). g --> a. g --> a, g.") == plans


def test_recursion_of_depth_zero_is_none():
    with pytest.raises(PlanError, match="the task g contains itself"):
        PlanLibrary.from_text("setting(plans, recursion, 0). goal(g). g --> a. g --> a, g.")


def test_no_depth_stated_is_no_recursion_and_no_hindrance():
    goal, productions = [(Compound(("g",)), Place())], read_text("g --> a, t. t --> b.")
    assert [[str(leaf) for leaf in plan.leaves] for plan in expand(goal, productions)] == [["a", "b"]]


@pytest.mark.parametrize("setting", ["setting(plans, recursion, -1)", "setting(plans, recursion, x)", "setting(plans, recursion, 1.5)", "setting(plans, recursion, 1) :- p"])
def test_a_depth_that_is_none_is_refused(setting):
    with pytest.raises(PlanError, match="takes a whole number"):
        PlanLibrary.from_text(f"{setting}. goal(g). g --> a.")


def test_other_settings_of_plans_are_left_alone():
    assert rows("setting(plans, begin, x). goal(g). g --> a.") == ["a"]


@pytest.mark.parametrize("kind", ["unordered(a, b)", "steps([x: a, y: b], [])"])
def test_a_shape_keeps_its_name_in_the_tree(kind):
    (plan,) = PlanLibrary.from_text(f"goal(g). g --> {kind}.").ways
    assert plan.root.children[0].kind == kind.split("(")[0]


def test_unordered_items_stay_as_written_and_steps_are_sorted():
    unordered, steps = (sentence.body for sentence in read_text("g --> unordered(b, a). h --> steps([x: b, y: a], [y < x])."))
    assert partial_order(unordered, None) == (("b", "a"), frozenset())
    assert partial_order(steps, None) == (("a", "b"), frozenset({(0, 1)}))


def test_a_library_may_have_as_many_plans_as_are_allowed_and_no_more():
    text = "goal(g(X)). g(a) --> do(a). g(b) --> do(b). g(c) --> do(c)."
    assert len(PlanLibrary(read_text(text), most_plans=3).ways) == 3
    with pytest.raises(PlanError, match="the library has more than 2 plans; g alone has 3"):
        _ = PlanLibrary(read_text(text), most_plans=2).ways
    with pytest.raises(PlanError, match="when all orders are spelled out; g alone has 3"):
        _ = PlanLibrary(read_text("goal(g). g --> a ; b ; c."), most_plans=2).plans
    assert len(PlanLibrary(read_text("goal(g). g --> a ; b ; c."), most_plans=3).plans) == 3


def leaves_of_ways(text):
    return [" ".join(map(str, way.leaves)) for way in PlanLibrary.from_text(text).ways]


def test_a_choice_that_settles_a_parameter_of_the_goal_makes_a_plan_of_its_own():
    text = "goal(g(X)). g(X) --> t(X), b(X). t(tea) --> a. t(milk) --> c. t(Y) --> d(Y). t(_) --> e."
    assert leaves_of_ways(text) == ["a b(tea)", "c b(milk)", "d(X) e b(X)"]


def test_a_choice_that_settles_no_more_than_its_own_stays_one():
    text = "goal(g). g --> t(Y), b(Y). t(tea) --> a. t(milk) --> c."
    assert leaves_of_ways(text) == ["a b(tea) c b(milk)"]


def test_an_optional_part_that_settles_a_parameter_is_done_or_not_in_plans_of_their_own():
    assert leaves_of_ways("goal(g(X)). g(X) --> optional(t(X)), b(X). t(tea) --> a.") == ["a b(tea)", "b(X)"]
