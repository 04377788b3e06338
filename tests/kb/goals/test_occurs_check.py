"""No equation makes an endless term: what would be one fails, as it does in the solver."""

from __future__ import annotations

import kanren
import pytest
from cons import cons
from equations import NAMES, X, Y, Z, terms, theirs
from hypothesis import given
from hypothesis import strategies as st
from kanren.constraints import neq

from casper.kb.goals.minikanren import conde, eq, lall, permuteo, run, var
from casper.kb.goals.occurs import unified
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import unify as unify_terms


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ((X,), X),
        (X, (X,)),
        ([X], X),
        ((1, (2, X)), X),
        (X, {"key": X}),
        (cons(1, X), X),
        ((X, Y, X), ((X,), (Y,), Y)),
        ((X, Y), ((Y,), (X,))),
        ((X, Y, Z), ((Y, Y), (Z, Z), (X, X))),
    ],
)
def test_what_would_be_an_endless_term_fails(left, right):
    assert run(0, X, eq(left, right)) == ()
    assert run(0, X, neq(Z, "other"), eq(left, right)) == ()


def test_a_circle_through_several_goals_fails():
    assert run(0, X, eq(X, (Y,)), eq(Y, (Z,)), eq(Z, X)) == ()
    assert run(0, X, lall(eq(X, [Y]), conde([eq(Y, X)], [eq(Y, 1)]))) == ([1],)


def test_no_order_of_a_list_has_the_list_in_it():
    assert run(0, X, permuteo((X,), X)) == ()


def test_a_variable_is_the_same_as_itself():
    assert run(0, X, eq(X, X), eq(X, 1)) == (1,)
    assert run(0, X, eq(X, Y), eq(Y, X), eq((X,), (Y,)), eq(Y, 1)) == (1,)


def test_a_term_that_shares_its_parts_is_looked_through_once():
    shared = var()
    goals, part = [], shared
    for _ in range(40):
        larger = var()
        goals.append(eq(larger, (part, part)))
        part = larger
    assert next(iter(lall(*goals, eq(Z, (part,)))({}))) is not None


equations = st.lists(st.tuples(terms, terms), min_size=1, max_size=4)


def ours(term):
    return Compound(("f", *map(ours, term))) if isinstance(term, tuple) else Variable(term) if term in NAMES else term


@given(equations)
def test_equations_hold_exactly_where_the_solver_unifies_them(pairs):
    bindings = {}
    for left, right in pairs:
        bindings = None if bindings is None else unify_terms(ours(left), ours(right), bindings)
    found = run(0, (X, Y, Z), *[eq(theirs(left), theirs(right)) for left, right in pairs])
    assert len(found) == (bindings is not None)
    if bindings is not None:  # then it ends in kanren, too
        assert found == kanren.run(0, (X, Y, Z), *[kanren.eq(theirs(left), theirs(right)) for left, right in pairs])


@given(equations)
def test_a_state_with_constraints_is_checked_alike(pairs):
    plain, constrained = {}, next(neq(var(), "nothing")({}))
    for left, right in pairs:
        plain = False if plain is False else unified(theirs(left), theirs(right), plain)
        constrained = False if constrained is False else unified(theirs(left), theirs(right), constrained)
    assert (plain is False) == (constrained is False)
    if plain is not False:
        assert constrained.data == plain
