"""Unification and its helpers."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.terms.terms import Compound, Variable, list_items, make_list, predication
from casper.kb.terms.unification import is_ground, substitute, unify, variables_of

X, Y, Z = (Variable(name) for name in "XYZ")
constants = st.sampled_from(["a", "b", 1, 2.5])
terms = st.recursive(
    st.one_of(constants, st.sampled_from([X, Y, Z])),
    lambda inner: st.lists(inner, min_size=1, max_size=2).map(lambda args: Compound(("f", *args))),
    max_leaves=5,
)


@given(terms, terms)
def test_unification_succeeds_in_both_orders_or_in_neither(left, right):
    assert (unify(left, right, {}) is None) == (unify(right, left, {}) is None)


@given(terms, terms)
def test_a_unifier_makes_both_terms_equal(left, right):
    unifier = unify(left, right, {})
    if unifier is not None:
        assert substitute(left, unifier) == substitute(right, unifier)


@given(terms, terms, terms)
def test_applying_a_unifier_twice_changes_nothing_more(left, right, other):
    unifier = unify(left, right, {})
    if unifier is not None:
        once = substitute(other, unifier)
        assert substitute(once, unifier) == once


_SMALL = ["a", "b", Compound(("f", "a")), Compound(("f", "b")), Compound(("f", "a", "b"))]


@given(terms, terms)
def test_every_small_common_instance_is_an_instance_of_the_unified_term(left, right):
    names = list(variables_of(left, right))
    for values in product(_SMALL, repeat=len(names)):
        instance = dict(zip(names, values))
        if substitute(left, instance) == substitute(right, instance):
            unifier = unify(left, right, {})
            assert unifier is not None
            assert unify(substitute(left, unifier), substitute(left, instance), {}) is not None


@given(terms, terms)
def test_the_bindings_handed_in_are_left_as_they_were(left, right):
    bindings = {Variable("W"): "a"}
    unify(left, right, bindings)
    assert bindings == {Variable("W"): "a"}


@pytest.mark.parametrize(("left", "right"), [(X, Compound(("f", X))), (Compound(("f", X)), X)])
def test_a_variable_never_becomes_a_term_that_contains_it(left, right):
    assert unify(left, right, {}) is None


def test_a_circle_through_two_variables_is_refused():
    assert unify(Compound(("p", X, Y)), Compound(("p", Compound(("f", Y)), Compound(("f", X)))), {}) is None


def test_numbers_are_equal_by_value_as_they_are_for_kanren():
    assert unify(1, 1.0, {}) == {}


def test_an_atom_never_equals_a_number():
    assert unify("1", 1, {}) is None


@given(st.lists(constants))
def test_a_list_gives_back_its_items(items):
    assert list_items(make_list(items)) == (items, "[]")


def test_a_long_list_is_no_deeper_than_python_can_go():
    left, right = make_list([*range(5000), X]), make_list([*range(5000), "a"])
    unifier = unify(left, right, {})
    assert unifier == {X: "a"}
    assert list_items(substitute(left, unifier))[0][-1] == "a"
    assert is_ground(right) and not is_ground(left)


def test_a_python_tuple_becomes_a_compound_to_the_bottom():
    statement = predication(("valid", ("eat", "human")))
    assert isinstance(statement, Compound) and isinstance(statement[1], Compound)


@pytest.mark.parametrize("nothing", [3, X, 2.5, ()])
def test_what_is_no_statement_is_refused(nothing):
    with pytest.raises(TypeError):
        predication(nothing)
