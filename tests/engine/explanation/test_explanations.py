"""Explanations as data: statuses, what is yet to be done, and several goals as one."""

import pytest

from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.explanation.situation import Situation
from casper.plans.library import PlanLibrary
from casper.plans.trees.tree import tree_text


def explanation(body, *marks, binding=(), goal="g", **more):
    (plan,) = PlanLibrary.from_text(f"goal({goal}). {goal} --> {body}.").ways
    return Explanation(plan, marks, binding, 0.5, 0.25, **more)


@pytest.mark.parametrize(
    ("body", "marks", "status"),
    [
        ("a, b, c", (), "unobserved unobserved unobserved"),
        ("a, b, c", (1,), "missed observed unobserved"),
        ("a, optional(b), c", (0, 2), "observed skipped observed"),
        ("a, optional((b, c)), d", (2, 3), "missed missed observed observed"),
        ("(a, b ; c), d", (), "alternative alternative unobserved unobserved"),
        ("(a, b ; c), d", (1,), "missed observed skipped unobserved"),
        ("(a, b ; c), d", (3,), "skipped skipped missed observed"),
        ("unordered(a, b), c", (1,), "unobserved observed unobserved"),
    ],
)
def test_every_leaf_has_its_status(body, marks, status):
    found = explanation(body, *marks)
    assert " ".join(found.status) == status
    assert found.missed == status.split().count("missed")
    assert [leaf for leaf, told in enumerate(found.status) if told == "unobserved"] == list(found.open_leaves)


def test_what_is_known_of_parameters_stands_in_leaves_frontier_and_tree():
    found = explanation("take(F), eat(F, D)", 0, goal="g(F)", binding=("egg", None))
    assert [str(leaf) for leaf in found.leaves] == ["take(egg)", "eat(egg, D)"]
    assert [str(leaf) for leaf in found.frontier] == ["eat(egg, D)"]
    assert tree_text(found.tree()).split("\n") == ["╙── g(egg)", "    ├─╼ ● take(egg)", "    └─╼ ○ eat(egg, D)"]


def test_an_explanation_is_json_and_numbers_needless_observations_from_one():
    leaves = [{"action": "a", "status": "observed"}, {"action": "b", "status": "unobserved"}]
    told = {"goal": "g", "share": 0.25, "score": 0.5, "leaves": leaves}
    assert explanation("a, b", 0).to_json() == told
    assert explanation("a, b", 0, needless=(1, 2)).to_json() == {**told, "needless": [2, 3]}


def test_several_goals_are_one_row_of_leaves():
    both = Interleaved((explanation("a, b, c", 1), explanation("d, e", 0, goal="h")), 0.4, 0.3, (3,))
    assert (both.goal, both.goals, both.missed) == ("g + h", ("g", "h"), 1)
    assert both.marks == (1, 3)
    assert both.open_leaves == (2, 4)
    assert [str(leaf[0]) for leaf in both.leaves] == list("abcde")
    assert [str(leaf[0]) for leaf in both.frontier] == ["c", "e"]
    assert both.status == ("missed", "observed", "unobserved", "observed", "unobserved")
    told = both.to_json()
    assert told["goals"] == ["g", "h"] and told["needless"] == [4] and len(told["leaves"]) == 5
    assert "needless" not in Interleaved(both.parts, 0.4, 0.3).to_json()


def test_a_single_goal_is_a_row_of_one():
    alone = explanation("a")
    assert alone.parts == (alone,) and alone.goals == ("g",) and alone.goal == "g"


def situation(body, *closed, found=None):
    (plan,) = PlanLibrary.from_text(f"goal(g). g --> {body}.").ways if found is None else (found,)
    progress = plan.chart.start
    for leaf in closed:
        progress = plan.chart.close(progress, leaf)
    return Situation.of(plan, progress[0], ())


@pytest.mark.parametrize(
    ("body", "before", "later", "leads"),
    [
        ("a, b, c", (0,), (0, 1), True),
        ("a, b, c", (0,), (0, 2), True),
        ("a, b, c", (0, 1), (0,), False),
        ("a, (b ; c), d", (0,), (0, 1), True),
        ("a, (b ; c), d", (0,), (0, 2), True),
        ("a, (b ; c, d), e", (0,), (0, 2), False),
        ("a, optional((b, c)), d", (0,), (0, 1), False),
        ("a, optional(b), c", (0,), (0, 2), True),
    ],
)
def test_a_situation_leads_to_those_in_which_nothing_unexpected_was_begun(body, before, later, leads):
    start = situation(body, *before)
    assert start.leads_to(situation(body, *later, found=start.plan)) is leads


def test_no_situation_leads_to_one_of_another_plan():
    assert not situation("a, b").leads_to(situation("a, c", 0))


def test_done_is_what_is_over_for_sure():
    assert bin(situation("a, (b ; c), d", 3).done) == "0b1001"
    assert bin(situation("a, optional((b, c)), d", 1).done) == "0b11"
