"""Trees of plans with shapes: what may be left out, what is done instead, and how it is shown."""

import pytest

from casper.plans.library import PlanLibrary
from casper.plans.trees.tree import plan_tree, tree_text


def tree(body, status=None, more=""):
    (plan,) = PlanLibrary.from_text(f"goal(g). g --> {body}. {more}").ways
    return plan_tree(plan, status)


def told(graph, attribute):
    return {data["name"]: data[attribute] for _, data in graph.nodes(data=True)}


def test_what_may_be_left_out_is_marked_as_optional():
    found = tree("a, optional(t), (c ; d)", more="t --> b.")
    assert told(found, "optional") == {"g": False, "a": False, "t": True, "b": True, "c": True, "d": True}


def test_the_first_node_of_an_alternative_tells_its_number():
    found = tree("a, (b, c ; d, e ; t)", more="t --> f.")
    assert told(found, "rival") == {"g": None, "a": None, "b": 0, "c": None, "d": 1, "e": None, "t": 2, "f": None}


def test_a_choice_that_begins_an_alternative_keeps_the_number_of_its_own():
    assert told(tree("(a ; (b ; c))"), "rival") == {"g": None, "a": 0, "b": 1, "c": 1}


def test_what_is_no_part_of_the_plan_does_not_count_for_the_task():
    found = tree("t, c", ["observed", "skipped", "unobserved"], more="t --> a, optional(b).")
    assert told(found, "status")["t"] == "observed"


def test_a_task_of_nothing_but_skipped_leaves_is_skipped():
    found = tree("a, optional(t)", ["observed", "skipped", "skipped"], more="t --> b, c.")
    assert told(found, "status")["t"] == "skipped"


@pytest.mark.parametrize(
    ("status", "shown"),
    [
        (["observed", "skipped", "observed"], ["● a", "– b", "or ● c"]),
        (["unobserved", "alternative", "unobserved"], ["○ a", "◌ b", "or ○ c"]),
    ],
)
def test_rivals_are_shown_with_or(status, shown):
    lines = [line.split("─╼ ")[-1] for line in tree_text(tree("a, (b ; c)", status)).split("\n")[1:]]
    assert lines == [line.replace("or ●", "● or").replace("or ○", "○ or") for line in shown]


def test_leaves_keep_their_order_inside_shapes():
    assert list(told(tree("steps([x: a, y: b], [y < x]), optional(c)"), "leaf").items()) == [
        ("g", None),
        ("b", 0),
        ("a", 1),
        ("c", 2),
    ]
