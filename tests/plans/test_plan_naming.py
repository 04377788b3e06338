"""The parameters of plans: what becomes of each, and what the open ones are called."""

from unittest.mock import patch

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.errors import PlanError
from casper.plans.grammar.expansion import _Grammar
from casper.plans.library import PlanLibrary
from casper.plans.trees.nodes import actions_below

_ARGUMENTS = st.sampled_from(["X", "X", "Y", "Y", "X2", "_", "cup", "3", "3.0", "[cup]", "f(X)", "f(Y, _)"])


def _statements(names, arity):
    return st.tuples(st.sampled_from(names), *[_ARGUMENTS] * arity).map(lambda t: f"{t[0]}({', '.join(t[1:])})")


_GOALS = _statements(["tea", "soup"], 2)
_BODIES = st.lists(_statements(["pour", "mix"], 3), min_size=1, max_size=3).map(", ".join)
_PRODUCTIONS = st.lists(st.tuples(_GOALS, _BODIES).map(" --> ".join), min_size=1, max_size=2)


def _plans(text):
    """Everything a library's plans are, places too; where it has none, the sentence that says why."""
    try:
        ways = PlanLibrary.from_text(text).ways
    except PlanError as mistake:
        return str(mistake)
    return [(plan, repr(plan.root), plan.place, [leaf.place for leaf in actions_below(plan.root)]) for plan in ways]


@given(_PRODUCTIONS, st.lists(_GOALS.map("goal({})".format), max_size=3))
def test_goals_of_nothing_but_actions_have_the_plans_that_unification_gives_them(productions, goals):
    text = "".join(f"{sentence}.\n" for sentence in (*goals, *productions))
    with patch.object(_Grammar, "plain", lambda grammar, goal: None):
        by_unification = _plans(text)
    assert _plans(text) == by_unification


@pytest.mark.parametrize(
    ("text", "plan"),
    [
        ("tea(X, Y) --> pour(X, cup), stir(Y, Z).", "tea(X, Y): pour(X, cup), stir(Y, Z)"),
        ("goal(tea(Y, X)). tea(X, Y) --> pour(X), stir(Y).", "tea(Y, X): pour(Y), stir(X)"),
        ("goal(tea(mug)). tea(X) --> pour(X), stir(X, Spoon).", "tea(mug): pour(mug), stir(mug, Spoon)"),
        ("goal(tea(Cup)). tea(X) --> pour(X, Cup).", "tea(Cup): pour(Cup, Cup2)"),
        ("goal(tea(of(Cup))). tea(X) --> pour(in(X), Cup).", "tea(of(Cup)): pour(in(of(Cup)), Cup2)"),
        ("goal(mix(A, B)). mix(X, X) --> pour(X).", "mix(B, B): pour(B)"),
        ("goal(tea(A)). tea(mug) --> pour(mug).", "tea(mug): pour(mug)"),
        ("goal(tea(A)). tea(X) --> t(X, Y), stir(Y). t(Y, X) --> pour(Y, X, Z).", "tea(A): pour(A, Y, Z), stir(Y)"),
    ],
)
def test_open_parameters_keep_their_authors_names_where_no_other_has_them(text, plan):
    assert [repr(way) for way in PlanLibrary.from_text(text).ways] == [f"<Plan {plan}>"]


def test_a_parameter_that_is_nested_too_deeply_is_refused():
    text = f"goal(tea(X)). tea(Y) --> pour(Y, [{', '.join(['cup'] * 20_000)}])."
    with pytest.raises(PlanError, match="the plans of tea are nested too deeply"):
        _ = PlanLibrary.from_text(text).ways


def test_a_large_library_that_is_built_in_python_is_the_one_of_its_text():
    rows = [(f"g{n}(X, Y)", [f"a{n % 7}(X, cup)", f"a{n % 5}(Y, pot)", f"b{n % 3}(X, Y)"]) for n in range(300)]
    built = PlanLibrary()
    for head, body in rows:
        built.plan(head, *body)
    read = PlanLibrary.from_text("".join(f"{head} --> {', '.join(body)}.\n" for head, body in rows))
    assert built.ways == read.ways
    assert all(plan.place.line == line for line, plan in enumerate(read.ways, 1))
