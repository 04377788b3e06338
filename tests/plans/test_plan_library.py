"""Plan grammars: what plans they expand to, and what is refused."""

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.errors import PlanError, ReadError
from casper.kb.text.reader import read_text
from casper.plans.library import PlanLibrary


def leaves(text):
    """Every plan as its actions, in order."""
    return [" ".join(map(str, plan.leaves)) for plan in PlanLibrary.from_text(text).plans]


def test_a_goal_is_done_by_its_actions_in_order():
    assert leaves("goal(tea). tea --> boil, pour.") == ["boil pour"]


@pytest.mark.parametrize(
    ("body", "plans"),
    [
        ("a, b", ["a b"]),
        ("a, (b, c)", ["a b c"]),
        ("a, (b ; c)", ["a b", "a c"]),
        ("(a ; b), (c ; d)", ["a c", "a d", "b c", "b d"]),
        ("a, b ; c", ["a b", "c"]),
        ("a, optional(b)", ["a b", "a"]),
        ("optional(a), b, optional(c)", ["a b c", "a b", "b c", "b"]),
        ("unordered(a, b)", ["a b", "b a"]),
        ("unordered(a, (b, c))", ["a b c", "b a c", "b c a"]),
        ("unordered(a, b, c)", ["a b c", "a c b", "b a c", "b c a", "c a b", "c b a"]),
        ("unordered(a, optional(b))", ["a b", "a", "b a"]),
        ("steps([x: a, y: b], [x < y])", ["a b"]),
        ("steps([x: a, y: b], [y < x])", ["b a"]),
        ("steps([x: a, y: b], [])", ["a b", "b a"]),
        ("steps([x: a, y: (b, c)], [x < y])", ["a b c"]),
        ("steps([x: a, y: (b ; c)], [x < y])", ["a b", "a c"]),
        ("steps([x: (a, b), y: c, z: d], [x < z])", ["a b c d", "a b d c", "a c b d", "c a b d"]),
        ("steps([x: a, y: optional(b), z: c], [x < y, y < z])", ["a b c", "a c"]),
    ],
)
def test_a_shape_stands_for_the_orders_it_allows(body, plans):
    library = PlanLibrary.from_text(f"goal(g). g --> {body}.")
    assert sorted(" ".join(leaf.functor for leaf in plan.leaves) for plan in library.plans) == sorted(plans)


@given(st.integers(1, 5), st.data())
def test_steps_keep_every_stated_pair_and_lose_no_order(count, data):
    names = "abcde"[:count]
    pairs = data.draw(st.lists(st.sampled_from([(x, y) for x in names for y in names if x < y] or [None]), unique=True))
    pairs = [pair for pair in pairs if pair]
    labelled = ", ".join(f"{n}: do_{n}" for n in names)
    text = f"goal(g). g --> steps([{labelled}], [{', '.join(f'{x} < {y}' for x, y in pairs)}])."
    orders = ["".join(leaf.functor[-1] for leaf in plan.leaves) for plan in PlanLibrary.from_text(text).plans]
    expected = {"".join(p) for p in permutations(names) if all(p.index(x) < p.index(y) for x, y in pairs)}
    assert len(orders) == len(set(orders))
    assert set(orders) == expected


def test_a_task_that_stays_together_in_an_order_keeps_its_node_there():
    library = PlanLibrary.from_text("goal(g). g --> unordered(t, c). t --> a, b.")
    assert [[type(node).__name__ for node in plan.root.children] for plan in library.plans] == [
        ["Task", "Action"],
        ["Action", "Action", "Action"],
        ["Action", "Task"],
    ]


def test_several_productions_of_a_task_are_alternatives():
    text = "goal(g). g --> t, c. t --> a. t --> b."
    assert leaves(text) == ["a c", "b c"]


def test_the_ways_of_one_goal_are_numbered():
    plans = PlanLibrary.from_text("goal(g). goal(h). g --> a ; b. h --> c.").plans
    assert [(plan.label, plan.way) for plan in plans] == [("g", 0), ("g", 1), ("h", 0)]


def test_a_parameter_flows_from_the_goal_to_the_leaves():
    assert leaves("goal(g(cup)). g(X) --> t(X), wash(X). t(Y) --> take(Y, sink).") == ["take(cup, sink) wash(cup)"]


def test_a_production_may_settle_a_parameter_of_the_goal():
    plans = PlanLibrary.from_text("goal(g(X)). g(X) --> t(X). t(tea) --> boil. t(milk) --> pour.").plans
    assert [str(plan.goal) for plan in plans] == ["g(tea)", "g(milk)"]


def test_a_parameter_chosen_in_one_task_is_known_in_the_next():
    assert leaves("goal(g). g --> pick(X), put(X). pick(tea) --> reach(tea). pick(milk) --> reach(milk).") == [
        "reach(tea) put(tea)",
        "reach(milk) put(milk)",
    ]


def test_an_open_parameter_is_one_variable_in_goal_and_leaves():
    (plan,) = PlanLibrary.from_text("goal(g(F)). g(X) --> a(X), t(X). t(Z) --> b(Z, _, _).").plans
    assert str(plan.goal) == "g(F)"
    assert [str(leaf) for leaf in plan.leaves] == ["a(F)", "b(F, _, _)"]
    assert len(plan.variables) == 3


def test_parameters_of_one_name_in_two_productions_stay_apart():
    (plan,) = PlanLibrary.from_text("goal(g). g --> a(X), t. t --> b(X).").plans
    assert len(plan.variables) == 2


def test_goals_that_share_a_name_are_labelled_by_their_terms():
    library = PlanLibrary.from_text("goal(g(tea)). goal(g(milk)). goal(h). g(X) --> pour(X). h --> a.")
    assert library.goals == ("g(tea)", "g(milk)", "h")


@pytest.mark.parametrize(
    "goals", ["goal(g(X)) :- a(X). goal(g(Y)) :- b(Y).", "goal(g(X)) :- (a(X) ; b(X)).", "goal(g(X)). goal(g(X))."]
)
def test_a_goal_with_several_conditions_is_one_goal(goals):
    library = PlanLibrary.from_text(f"{goals} g(X) --> pour(X).")
    assert library.goals == ("g",)
    assert len(library.plans) == 1


def test_goals_with_a_repeated_parameter_are_told_from_those_without():
    assert len(PlanLibrary.from_text("goal(g(X, X)). goal(g(X, Y)). g(X, Y) --> mix(X, Y).").plans) == 2


def test_without_stated_goals_every_task_that_no_other_uses_is_one():
    assert PlanLibrary.from_text("tea --> boil, t. t --> pour. milk --> t.").goals == ("tea", "milk")


def test_a_task_inside_a_shape_is_used():
    assert PlanLibrary.from_text("g --> a, optional(s). s --> b. h --> steps([x: t], []). t --> c.").goals == ("g", "h")


def test_a_parameter_that_is_called_like_a_task_does_not_use_it():
    assert PlanLibrary.from_text("tea --> pour(coffee). coffee --> grind.").goals == ("tea", "coffee")


def test_a_task_named_like_a_shape_is_a_task():
    assert leaves("goal(g). g --> optional(a). optional(X) --> do(X).") == ["do(a)"]


def test_tasks_and_actions_are_told_apart():
    library = PlanLibrary.from_text("goal(g). g --> a(x), t. t --> b.", "home.pl")
    assert library.tasks == {("g", 0), ("t", 0)}
    assert {action: place.line for action, place in library.actions.items()} == {("a", 1): 1, ("b", 0): 1}


def test_a_library_built_in_python_is_that_of_the_text():
    library = PlanLibrary()
    library.goal("clean(plate)")
    library.plan("clean(V)", "move(V, sink)", "wash(V)")
    assert [str(leaf) for leaf in library.plans[0].leaves] == ["move(plate, sink)", "wash(plate)"]
    assert library.to_text() == "goal(clean(plate)).\nclean(V) --> move(V, sink), wash(V).\n"


@pytest.mark.parametrize(
    "text",
    [
        "goal(g(X)) :- food(X). g(X) --> a(X, _), (b ; c, d), optional((e, f)), unordered(a(1, 2), (b, c)).",
        "goal(g). g --> steps([x: a, y: (b, c), z: 'Odd name'], [x < y, x < z]).",
        "g --> a ; b, c. h(_, X) --> i(X, _).",
    ],
)
def test_a_library_prints_as_text_that_is_the_same_library(text):
    library = PlanLibrary.from_text(text)
    again = PlanLibrary.from_text(library.to_text())
    assert again.productions == library.productions
    assert again.goal_clauses == library.goal_clauses
    assert again.plans == library.plans


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("goal(g).", "home.pl:1:1: the goal g has no production: write g --> …"),
        ("goal(g(1)). g(2) --> a.", "home.pl:1:1: no production fits the goal g(1)"),
        ("goal(X). g --> a.", "home.pl:1:1: goal(X) does not name a goal"),
        ("goal(3). g --> a.", "home.pl:1:1: goal(3) does not name a goal"),
        ("g --> a.\nh --> i. i --> h.\n goal(h).", "home.pl:2:1: the task h can only go on for ever (h needs i needs h): give it a production that ends, such as h --> []"),
        ("g --> a, g.", "home.pl:1:1: the task g can only go on for ever (g needs g)"),
        ("setting(plans, recursion, 2). g --> g, a.", "home.pl:1:31: the task g can only go on for ever (g needs g)"),
        ("g --> a, h. h --> g. h --> b.", "every task is part of another one: say which are goals"),
        ("goal(g). g --> a, {}.", "home.pl:1:10: {} asks nothing: write {Goal}"),
        ("goal(g). g --> by(3, a).", "home.pl:1:10: 3 does nothing: by takes an agent, a variable or robot"),
        ("goal(g). g --> by(ann, b). b --> a.", "home.pl:1:10: by says whose step an action is, and b is a task: put by into the productions of b"),
        ("goal(g). g --> by(ann, (a, b)).", "home.pl:1:10: by(ann, (a, b)) cannot stand in a plan: by takes who, and an action"),
        ("goal(g). g --> optional(a).", "home.pl:1:1: a plan of g has no action at all"),
        ("goal(g). g --> t(a). t(b) --> x.", "home.pl:1:1: no choice of productions completes the goal g"),
        ("goal(g). g --> a, X.", "home.pl:1:10: X cannot stand in a plan"),
        ("goal(g). g --> a, 3.", "home.pl:1:10: 3 cannot stand in a plan"),
        ("goal(g). g --> a, X = 3.", "home.pl:1:10: X = 3 cannot stand in a plan"),
        ("goal(g). g --> a, X is 3.", "home.pl:1:10: X is 3 cannot stand in a plan"),
        ("goal(g). g --> \\+ a.", "home.pl:1:10: \\+ a cannot stand in a plan"),
        ("goal(g). g --> [a].", "home.pl:1:10: [a] cannot stand in a plan"),
        ("goal(g). g --> steps([a], []).", "home.pl:1:10: a has no label: write it as name: a"),
        ("goal(g). g --> steps([x: a, x: b], []).", "two steps are labelled x"),
        ("goal(g). g --> steps([x: a], [x < y]).", "x < y is no pair of step labels"),
        ("goal(g). g --> steps([x: a], [x]).", "x is no pair of step labels"),
        ("goal(g). g --> steps([x: a, y: b], [x < y, y < x]).", "the order of these steps runs in a circle"),
        ("goal(g). g --> steps([x: a, y: b]).", "steps takes a list of labelled items and a list of pairs"),
        ("goal(g). g --> steps(a, b).", "steps takes a list of labelled items and a list of pairs"),
        ("goal(g). g --> steps([x: a | T], []).", "steps takes a list of labelled items and a list of pairs"),
    ],
)
def test_a_library_with_a_mistake_is_refused_with_its_place(text, sentence):
    with pytest.raises(PlanError) as caught:
        PlanLibrary.from_text(text, "home.pl")
    assert sentence in str(caught.value)
    assert caught.value.place is not None and caught.value.place.file == "home.pl"


def test_a_library_with_too_many_plans_is_refused():
    body = ", ".join(f"a{n}" for n in range(12))
    library = PlanLibrary(read_text(f"goal(g). g --> unordered({body})."), most_plans=1000)
    with pytest.raises(PlanError, match="more than 1000 plans when all orders are spelled out; g alone has 1001"):
        _ = library.plans


def test_a_production_head_that_is_no_name_is_refused():
    with pytest.raises(ReadError, match="X cannot stand here"):
        PlanLibrary.from_text("X --> a.")
