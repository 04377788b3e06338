"""Plan trees as networkx graphs, their statuses, and their text."""

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.terms.terms import Variable
from casper.plans.library import PlanLibrary
from casper.plans.trees.tree import plan_tree, statuses, tree_text

TEXT = "goal(lunch(F)). lunch(F) --> prepare(F), eat(F, plate), clean(plate). prepare(F) --> cook(F), serve(F). clean(V) --> wash(V)."


def lunch():
    (plan,) = PlanLibrary.from_text(TEXT).plans
    return plan


def column(tree, attribute):
    return [tree.nodes[number][attribute] for number in sorted(tree)]


def test_nodes_are_numbered_in_pre_order_from_the_goal():
    assert column(plan_tree(lunch()), "name") == ["lunch", "prepare", "cook", "serve", "eat", "clean", "wash"]


def test_every_node_says_what_it_is():
    tree = plan_tree(lunch())
    assert column(tree, "kind") == ["goal", "task", "action", "action", "action", "task", "action"]
    assert column(tree, "leaf") == [None, None, 0, 1, 2, None, 3]
    assert column(tree, "term")[:3] == ["lunch(F)", "prepare(F)", "cook(F)"]


def test_edges_lead_from_a_task_to_what_it_is_done_by():
    tree = plan_tree(lunch())
    assert nx.is_arborescence(tree)
    assert list(tree.successors(0)) == [1, 4, 5]


def test_known_parameters_are_put_into_every_node():
    tree = plan_tree(lunch(), bindings={Variable("F"): "meal"})
    assert column(tree, "term")[:5] == ["lunch(meal)", "prepare(meal)", "cook(meal)", "serve(meal)", "eat(meal, plate)"]


def test_nothing_is_observed_at_first():
    assert set(column(plan_tree(lunch()), "status")) == {"unobserved"}


@pytest.mark.parametrize(
    ("marks", "expected"),
    [
        ([], ["unobserved"] * 4),
        ([0], ["observed", "unobserved", "unobserved", "unobserved"]),
        ([2], ["missed", "missed", "observed", "unobserved"]),
        ([0, 3], ["observed", "missed", "missed", "observed"]),
    ],
)
def test_what_lies_left_of_the_last_observation_was_missed(marks, expected):
    assert list(statuses(4, marks)) == expected


@given(st.lists(st.sampled_from(["observed", "missed", "unobserved"]), min_size=4, max_size=4))
def test_a_task_has_the_status_its_leaves_share(marks):
    tree = plan_tree(lunch(), marks)
    for number, data in tree.nodes(data=True):
        below = {tree.nodes[n]["status"] for n in nx.descendants(tree, number) if tree.nodes[n]["kind"] == "action"}
        if below:
            assert data["status"] == (below.pop() if len(below) == 1 else "unobserved")


def test_a_tree_prints_with_a_mark_for_each_action():
    tree = plan_tree(lunch(), statuses(4, [1]))
    assert tree_text(tree).split("\n") == [
        "╙── lunch(F)",
        "    ├─╼ prepare(F)",
        "    │   ├─╼ ✗ cook(F)",
        "    │   └─╼ ● serve(F)",
        "    ├─╼ ○ eat(F, plate)",
        "    └─╼ clean(plate)",
        "        └─╼ ○ wash(plate)",
    ]
