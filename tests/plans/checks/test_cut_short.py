"""Worst cases whose search stops at its bound say so; those that were searched to the end do not."""

from unittest.mock import patch

import pytest

from casper.plans.checks import telling_apart
from casper.plans.checks.telling_apart import findings, inseparable_goals, worst_case_distinctiveness
from casper.plans.library import PlanLibrary


def library(*bodies):
    return PlanLibrary.from_text(" ".join(f"g{n} --> {body}." for n, body in enumerate(bodies)))


def told(*bodies):
    return [finding.message.split("worst case before a goal is certain, ")[-1] for finding in findings(library(*bodies))]


def test_a_search_to_the_end_tells_both_worst_cases_without_reserve():
    assert told("a, b, c", "a, d, c") == [
        "if every step is seen: g0 and g1 may both be pursued after 1 observations: a",
        "even if steps go unseen: g0 and g1 may both be pursued after 2 observations: a, c",
    ]


def test_goals_that_share_nothing_have_no_worst_case():
    assert told("a, b", "c, d") == []
    assert worst_case_distinctiveness(library("a", "b")) is None


def test_a_search_through_too_many_states_says_at_least():
    with patch.object(telling_apart, "MOST_STATES", 1):
        seen, unseen = told("a, b, c, d", "a, b, c, e")
    assert seen.endswith(" (at least; the search was cut short)")
    assert unseen.endswith(" (at least; the search was cut short)")


@pytest.mark.parametrize(("pairs", "exact"), [(3, True), (2, False)])
def test_pairs_of_goals_that_were_not_looked_at_make_it_a_bound(pairs, exact):
    with patch.object(telling_apart, "MOST_PAIRS", pairs):
        worst = worst_case_distinctiveness(library("a, b", "a, c", "a, d"))
    assert worst.is_exact is exact
    assert worst.goals == ("g0", "g1")


def test_a_bound_stays_one_although_a_later_pair_is_searched_to_the_end():
    with patch.object(telling_apart, "MOST_STATES", 3):
        worst = worst_case_distinctiveness(library("a, b, c, d, e", "a, b, c, d, f", "x, y", "x, z"))
    assert not worst.is_exact


def test_two_ways_to_one_goal_need_not_be_told_apart():
    text = "goal(g(X)). g(tea) --> a, b. g(milk) --> a, c. goal(h). h --> d."
    assert worst_case_distinctiveness(PlanLibrary.from_text(text)) is None


def test_parameters_of_two_goals_are_their_own():
    worst = worst_case_distinctiveness(PlanLibrary.from_text("goal(g(X)). goal(h(X)). g(X) --> a(X, cup). h(X) --> a(mug, X)."))
    assert [str(action) for action in worst.observations] == ["a(X, cup)"]


def test_the_order_of_open_steps_is_searched():
    worst = worst_case_distinctiveness(library("unordered(a, b), c", "b, a, d"))
    assert [str(action) for action in worst.observations] == ["b", "a"]


@pytest.mark.parametrize(("ways", "told_"), [(2, ["no observations can tell g1 from g0: their plans have the same actions"]), (1, [])])
def test_plans_that_are_written_otherwise_are_compared_up_to_a_number_of_ways(ways, told_):
    with patch.object(telling_apart, "MOST_WAYS", ways):
        assert [f.message for f in inseparable_goals(library("unordered(a, b)", "(a, b ; b, a)"))] == told_


def test_only_goals_whose_parameters_have_conditions_are_left_alone():
    text = "goal(g(X)) :- p(X). goal(h(X)) :- q(X). goal(i) :- r. goal(j). g(X) --> a(X). h(X) --> a(X). i --> b. j --> b."
    assert [f.message.split(":")[0] for f in inseparable_goals(PlanLibrary.from_text(text))] == ["no observations can tell j from i"]


@pytest.mark.parametrize(("a", "b", "row"), [("a, b", "b, a", "a"), ("a, b, c", "c, a, b", "a b"), ("a, a", "a, b, a", "a a")])
def test_a_step_that_was_passed_over_is_no_part_of_the_row(a, b, row):
    worst = worst_case_distinctiveness(library(a, b), missing=True)
    assert " ".join(map(str, worst.observations)) == row


def test_a_worst_case_stands_at_the_first_of_its_goals():
    text = "goal(x).\ngoal(g).\ngoal(h).\nx --> z.\ng --> a, b.\nh --> a, c.\n"
    assert [f.place.line for f in findings(PlanLibrary.from_text(text))] == [2, 2]
