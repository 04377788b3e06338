"""Mistakes in a plan library: every one is told, with its place and with what may have been meant."""

import pytest

from casper.kb.text.reader import read_text
from casper.plans.checks.check import check_plans, items_of

ACTIONS = {("boil", 0), ("pour", 1), ("rinse", 0)}


def told(text, knows=True):
    found = check_plans(read_text(text, "p.pl"), ACTIONS.__contains__ if knows else None)
    return [f"{f.place.line} {f.severity} {f.message}" for f in found]


def test_a_sound_library_has_no_mistakes():
    assert told("goal(tea). tea --> boil, pour(cup), clean. clean --> rinse.") == []


@pytest.mark.parametrize(
    ("text", "mistake"),
    [
        ("goal(t). t --> boil, pour.", "1 error pour/0 is no task, and no rule pour/1 says when it is valid as an action; did you mean pour?"),
        ("goal(t). t --> boil, clean(x). clean --> rinse. ", "1 error clean/1 is no task, and no rule clean/2 says when it is valid as an action; the task clean takes 0"),
        ("goal(t). t --> boil,\nzap.", "1 error zap/0 is no task, and no rule zap/1 says when it is valid as an action"),
        ("goal(t). t --> boil, steps([a: rinse, b: zap], []).", "1 error zap/0 is no task, and no rule zap/1 says when it is valid as an action"),
        ("goal(t). t --> boil, optional((rinse ; zap)).", "1 error zap/0 is no task, and no rule zap/1 says when it is valid as an action"),
        ("goal(t). goal(u).\nt --> boil.", "1 error the goal u has no production: write u --> …; did you mean t?"),
        ("goal(tea(x)). tea --> boil.", "1 error the goal tea(x) has no production: write tea --> …; the task tea takes 0"),
        ("goal(t).\nt --> boil, t.", "2 error the task t can only go on for ever (t needs t): give it a production that ends, such as t --> []"),
        ("goal(a).\na --> boil, b.\nb --> rinse, a.", "2 error the task a can only go on for ever (a needs b needs a): give it a production that ends, such as a --> []"),
        ("goal(t).\nt --> boil ; u.\nu --> rinse, u.", "3 warning the task u can only go on for ever (u needs u): give it a production that ends, such as u --> []"),
        ("goal(t).\nt --> {X > 3}, boil.", "2 error nothing binds X of the condition {X > 3}: use it in an action or a task, or bind it by a condition"),
        ("goal(t).\nt --> boil.\nu --> rinse.", "3 warning no goal leads to the task u/0; use it in a plan, or state goal(u)."),
        ("goal(t).\nt --> boil.\nu(X, Y) --> pour(X).", "3 warning no goal leads to the task u/2; use it in a plan, or state goal(u(_, _))."),
        ("goal(t).\nt --> v(a).\nv(a) --> boil.\nv(b) --> rinse.", "4 warning this way to do v(b) is part of no plan: no use of it fits its parameters"),
        ("goal(g(1)).\ng(2) --> boil.", "1 error no production fits the goal g(1)"),
        ("t --> boil, optional(3).", "1 error 3 cannot stand in a plan: an item of a plan is an action or a task, such as wash(Plate, sink)"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_once(text, mistake):
    hint = mistake.split("; did you mean")[0]
    assert [line.split("; did you mean")[0] for line in told(text)] == [hint]


def test_a_task_nobody_needs_is_told_once_however_many_productions_it_has():
    assert [line[:9] for line in told("goal(t). t --> boil.\nu --> rinse.\nu --> boil.")] == ["2 warning"]


def test_without_stated_goals_no_task_is_unused():
    assert told("t --> boil. u --> rinse.") == []


def test_errors_hide_warnings():
    assert [line[:7] for line in told("goal(t). t --> zap.\nu --> rinse.")] == ["1 error"]


def test_each_of_several_goals_that_cannot_be_expanded_is_told():
    found = told("goal(g(1)).\ngoal(h(1)).\ngoal(i).\ng(2) --> boil.\nh(2) --> boil.\ni --> boil.")
    assert found == ["1 error no production fits the goal g(1)", "2 error no production fits the goal h(1)"]


def test_each_circle_is_told_once():
    found = told("goal(a). a --> boil, b.\nb --> a.\ngoal(c).\nc --> boil, c.")
    assert sorted(line.split(" (")[0] for line in found) == ["1 error the task a can only go on for ever", "4 error the task c can only go on for ever"]


def test_recursion_that_can_end_is_no_mistake():
    assert told("goal(t). t --> boil. t --> boil, t.") == []


def test_a_condition_binds_what_it_looks_up():
    assert told("goal(t). t --> {size(X), X > 3}, boil.") == []


def test_recursion_that_is_allowed_is_no_circle():
    assert told("setting(plans, recursion, 2). goal(t). t --> boil. t --> boil, t.") == []


def test_where_nobody_knows_the_actions_only_what_resembles_a_task_is_suspected():
    found = told("tea --> boil, claen, clean(cup).\nclean --> rinse.", knows=False)
    assert found == [
        "1 warning claen/0 has no production, so it counts as an action; did you mean clean?",
        "1 warning clean/1 has no production, so it counts as an action; the task clean takes 0",
    ]


def test_the_items_of_a_body_are_those_in_all_its_brackets():
    (production,) = read_text("g --> a, (b ; c(x)), optional(d), steps([k: e, l: (f, g)], [k < l]), unordered(h, i).")
    assert [str(item[0]) for item in items_of(production.body)] == list("abcdefghi")
    assert [item.arity for item in items_of(production.body)] == [0, 0, 1, 0, 0, 0, 0, 0, 0]
