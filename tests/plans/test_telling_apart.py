"""Which goals observations can tell apart, and after how many at worst."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.plans.checks.telling_apart import findings, inseparable_goals, worst_case_distinctiveness
from casper.plans.library import PlanLibrary


def library(*plans):
    found = PlanLibrary()
    for number, plan in enumerate(plans):
        found.plan(f"g{number}", *plan)
    return found


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("goal(g). goal(h). g --> a, b. h --> a, b.", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> a, b. h --> t, b. t --> a.", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> a(X), b(X). h --> a(Y), b(Y).", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> a(X), b(X). h --> a(Y), b(Z).", []),
        ("goal(g). goal(h). g --> a, b. h --> b, a.", []),
        ("goal(g). goal(h). g --> unordered(a, b). h --> unordered(a, b).", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> unordered(a, b). h --> unordered(b, a).", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> a, (b ; c). h --> t. t --> a, c. t --> a, b.", ["no observations can tell h from g"]),
        ("goal(g). goal(h). g --> a, (b ; c). h --> a, b.", []),
        ("goal(g). goal(h). g --> a, optional(b). h --> a, b.", []),
        ("goal(g(X)) :- p(X). goal(h(X)) :- q(X). g(X) --> a(X). h(X) --> a(X).", []),
    ],
)
def test_goals_with_the_same_plans_are_inseparable(text, told):
    found = list(inseparable_goals(PlanLibrary.from_text(text)))
    assert [f.message.split(":")[0] for f in found] == told


def common(a, b, missing):
    """The longest common subsequence, or prefix where nothing is missed, by trying all."""
    if not missing:
        return next((n for n in range(min(len(a), len(b)), 0, -1) if a[:n] == b[:n]), 0)
    rows = {row for n in range(len(a) + 1) for row in combinations(a, n)}
    return max(len(row) for row in rows if row in set(combinations(b, len(row))))


@given(st.lists(st.text("abc", min_size=1, max_size=6), min_size=2, max_size=4), st.booleans())
def test_the_worst_case_is_the_longest_row_that_two_plans_share(plans, missing):
    worst = worst_case_distinctiveness(library(*plans), missing)
    longest = max(common(a, b, missing) for a, b in combinations(plans, 2))
    assert (worst.length if worst else 0) == longest
    if worst:
        assert worst.is_exact
        row = tuple(action.functor for action in worst.observations)
        first, second = (plans[int(goal[1:])] for goal in worst.goals)
        assert row in set(combinations(first, len(row))) and row in set(combinations(second, len(row)))


def test_findings_say_both_worst_cases():
    told = [str(f.message) for f in findings(library("abc", "abd"))]
    assert len(told) == 2
    assert all("g0 and g1 may both be pursued after 2 observations: a, b" in message for message in told)


def test_one_goal_needs_no_telling_apart():
    assert list(findings(library("abc"))) == []
