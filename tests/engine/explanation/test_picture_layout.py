"""Where the nodes of a picture stand, and where their texts break."""

import networkx as nx
import pytest

from casper.engine.explanation.pictures import _wrapped, positions
from casper.plans.library import PlanLibrary
from casper.plans.trees.tree import plan_tree


def test_leaves_stand_at_whole_numbers_and_tasks_above_their_middle_one_row_higher():
    (plan,) = PlanLibrary.from_text("goal(g). g --> t, c. t --> a, b.").ways
    assert positions(plan_tree(plan)) == {0: (1.25, 0.0), 1: (0.5, -1.0), 2: (0.0, -2.0), 3: (1.0, -2.0), 4: (2.0, -1.0)}


def test_a_single_leaf_stands_below_its_goal():
    tree = nx.DiGraph([(0, 1)])
    assert positions(tree) == {0: (0.0, 0.0), 1: (0.0, -1.0)}


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("x" * 22, "x" * 22),
        ("x" * 23, "x" * 22 + "\nx"),
        ("pick_and_place(biscuits, plate)", "pick_and_place(\nbiscuits, plate)"),
        ("short(biscuits, plate)", "short(biscuits, plate)"),
        ("f(g(xxxxxxxxxxxxxxxxxxxxxxxx))", "f(\ng(xxxxxxxxxxxxxxxxxxxxxxxx))"),
        ("x" * 25 + "(y)", "x" * 22 + "\nxxx(y)"),
    ],
)
def test_a_long_text_breaks_at_its_first_bracket_or_after_twenty_two_letters(text, shown):
    assert _wrapped(text) == shown
