"""The robot's part as a tree of py_trees: it waits, asks, does, and tells the reading."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("py_trees", reason="behaviour trees need: pip install 'casper-hri[behaviour-trees]'")

import py_trees

from casper import Domain
from casper.kb.errors import CasperError
from casper.planning import behaviour_tree

Status = py_trees.common.Status
ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def kitchen():
    return Domain.load("kitchen")


@pytest.fixture
def reading(kitchen):
    reading = kitchen.reading()
    reading.observe("pick_and_place(meal, hobs)")
    return reading


def ticked(tree, times=1):
    for _ in range(times):
        tree.tick_once()
    return tree.status


def test_nothing_is_done_before_the_partner_has_done_their_steps(kitchen, reading):
    done = []
    fillers = {name: lambda *things: done.append(things) or True for name in ("pick_and_place", "wash")}
    tree = behaviour_tree(reading.plan_for("tiago"), fillers, kitchen, reading)
    assert ticked(tree, 3) is Status.RUNNING
    for action in ("cook(meal, hobs)", "pick_and_place(meal, plate)"):
        reading.observe(action)
        assert ticked(tree) is Status.RUNNING
    assert not done
    reading.observe("eat(meal, plate)")
    assert ticked(tree) is Status.SUCCESS
    assert done == [("plate", "sink"), ("plate", "sink")]


def test_what_is_done_is_told_to_the_reading_once(kitchen, reading):
    fillers = {"pick_and_place": lambda *_: True, "wash": lambda *_: None}
    tree = behaviour_tree(reading.plan_for("tiago"), fillers, kitchen, reading)
    for action in ("cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"):
        reading.observe(action)
    assert ticked(tree, 3) is Status.RUNNING
    assert [str(each) for each in reading.observations[4:]] == ["pick_and_place(plate, sink)"]
    assert [str(each) for each in reading.frontier] == ["wash(plate, sink)"]


def test_an_action_that_is_not_valid_is_not_begun(tmp_path):
    (tmp_path / "ontology.pl").write_text(
        "human(ann). robot(bot). wait(A) :- human(A). lift(A) :- robot(A).\n"
        'never("the arm is hot") :- claim(lift(_)), did(wait(_), _).\n'
    )
    (tmp_path / "plans.pl").write_text("goal(help). help --> wait, lift.\n")
    domain = Domain.load(tmp_path)
    reading = domain.reading()
    reading.observe("wait")
    plan = type(reading.plan_for("bot"))("bot", "help", (), reading.frontier, (1,))
    tree = behaviour_tree(plan, {"lift": lambda: True}, domain, reading)
    assert ticked(tree) is Status.FAILURE
    assert "may bot lift? [✕] -- the arm is hot" in py_trees.display.unicode_tree(tree, show_status=True)


def test_a_behaviour_is_a_leaf_as_it_is(kitchen, reading):
    for action in ("cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"):
        reading.observe(action)
    wash = py_trees.behaviours.StatusQueue("washing", [Status.RUNNING, Status.SUCCESS], eventually=None)
    fillers = {"pick_and_place": py_trees.behaviours.Success, "wash": wash}
    tree = behaviour_tree(reading.plan_for("tiago"), fillers, kitchen, reading)
    assert ticked(tree) is Status.RUNNING
    assert ticked(tree) is Status.SUCCESS
    assert wash in tree.iterate() or wash in list(tree.iterate())


def test_a_mistake_in_an_action_is_a_failure_that_says_so(kitchen, reading):
    for action in ("cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"):
        reading.observe(action)

    def broken(*_):
        raise ValueError("no grip")

    tree = behaviour_tree(reading.plan_for("tiago"), {"pick_and_place": broken, "wash": broken}, kitchen, reading)
    assert ticked(tree) is Status.FAILURE
    assert "ValueError: no grip" in py_trees.display.unicode_tree(tree, show_status=True)


def test_actions_that_nothing_does_are_refused(kitchen, reading):
    with pytest.raises(CasperError, match="nothing does pick_and_place, wash: give a function or a behaviour"):
        behaviour_tree(reading.plan_for("tiago"), {}, kitchen, reading)


def test_one_behaviour_for_two_actions_is_refused(kitchen):
    reading = kitchen.reading()
    reading.observe("pick_and_place(biscuits, plate)")
    plan = reading.plan_for("tiago")
    twice = type(plan)("tiago", plan.goal, (), plan.actions[:1] * 2, (0, 1))
    one = py_trees.behaviours.Success("one")
    with pytest.raises(CasperError, match="one behaviour cannot do two actions"):
        behaviour_tree(twice, {plan.actions[0].functor: one}, kitchen, reading)


def test_the_example_runs():
    done = subprocess.run(
        [sys.executable, str(ROOT / "examples" / "behaviour_tree.py")], capture_output=True, encoding="utf-8",
        env={"PYTHONPATH": str(ROOT / "src"), "PYTHONIOENCODING": "utf-8"}, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.rstrip().endswith("wash(plate, sink) [✓]")
