"""kanren's names, with kanren's answers: what hangs or recurses to death there does neither here."""

from __future__ import annotations

from collections import Counter
from itertools import count, islice

import kanren
import pytest
from cons import cons
from hypothesis import given
from hypothesis import strategies as st
from kanren.constraints import neq
from unification import isvar
from unification.core import _unify, stream_eval

from casper.kb.goals import minikanren as mk
from casper.kb.goals.minikanren import (
    Zzz,
    appendo,
    conde,
    conso,
    defrel,
    eq,
    heado,
    itero,
    lall,
    lany,
    membero,
    nullo,
    permuteo,
    rembero,
    run,
    tailo,
    var,
)
from casper.kb.goals.occurs import _Circular, _Guard, unified
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import unify as unify_terms

X, Y, Z = var("x"), var("y"), var("z")
LONG = 1_500
items = st.lists(st.sampled_from("abc"), max_size=4)
sequences = st.one_of(items, items.map(tuple))


# --- the occurs check ----------------------------------------------------------------------------------------------


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


terms = st.recursive(
    st.sampled_from(["X", "Y", "Z", "a", 1]), lambda inner: st.lists(inner, min_size=1, max_size=3).map(tuple), max_leaves=6
)
equations = st.lists(st.tuples(terms, terms), min_size=1, max_size=4)
NAMES = {"X": X, "Y": Y, "Z": Z}


def theirs(term):
    return tuple(map(theirs, term)) if isinstance(term, tuple) else NAMES.get(term, term)


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


# --- relations that call themselves --------------------------------------------------------------------------------


@defrel
def append(front, back, whole):
    """As every textbook writes it."""
    head, tail, rest = var(), var(), var()
    return conde(
        [eq(front, ()), eq(back, whole)],
        [eq(front, (head, tail)), eq(whole, (head, rest)), append(tail, back, rest)],
    )


def nested(length):
    found = ()
    for at in reversed(range(length)):
        found = (at, found)
    return found


def test_a_thousand_ways_to_append():
    assert len(run(1000, Y, append(X, Y, Z))) == 1000
    assert len(run(1000, Y, appendo(X, Y, Z))) == 1000
    assert run(100, X, append(X, Y, Z))[-1][1][1][0] is not None


def test_long_lists_are_appended_and_taken_apart():
    found = run(1, X, append(nested(500), (), X))
    depth, rest = 0, found[0]
    while rest:
        depth, rest = depth + 1, rest[1]
    assert depth == 500
    whole = list(range(400))
    assert run(1, X, appendo(whole[:350], X, whole)) == (whole[350:],)
    assert run(0, X, membero(X, whole)) == tuple(whole)


def edges(length):
    edge = mk.Relation("edge")
    mk.facts(edge, *[(at, at + 1) for at in range(length)])
    return edge


def test_a_relation_that_calls_itself_needs_no_delay():
    edge = edges(LONG)

    @defrel
    def path(a, b):
        between = var()
        return conde([edge(a, b)], [edge(a, between), path(between, b)])

    assert set(run(0, X, path(0, X))) == set(range(1, LONG + 1))


def test_a_relation_that_calls_itself_first_still_answers():
    edge = edges(5)

    @defrel
    def path(a, b):
        between = var()
        return conde([path(a, between), edge(between, b)], [edge(a, b)])

    assert set(run(5, X, path(0, X))) == {1, 2, 3, 4, 5}


def test_a_goal_that_takes_the_state_and_returns_a_stream_may_call_itself():
    edge = edges(LONG)

    def path(a, b):
        def goal(state):
            between = var()
            return conde([edge(a, b)], [edge(a, between), path(between, b)])(state)

        return goal

    assert len(run(0, X, path(0, X))) == LONG


def test_a_generator_that_hands_on_a_stream_may_call_itself():
    edge = edges(LONG)

    def path(a, b):
        def goal(state):
            between = var()
            yield from conde([edge(a, b)], [edge(a, between), path(between, b)])(state)

        return goal

    assert len(run(0, X, path(0, X))) == LONG


def test_a_generator_that_looks_at_what_it_hands_on_is_heeded():
    def first(goal_):
        def goal(state):
            yield from islice(goal_(state), 1)

        return goal

    def last_word(goal_):
        def goal(state):
            yield from goal_(state)
            yield {**state, X: "end"}

        return goal

    choice = lany(eq(X, 1), eq(X, 2))
    assert run(0, X, first(choice)) == (1,)
    assert Counter(run(0, X, last_word(choice))) == Counter([1, 2, "end"])


def test_clauses_may_come_from_an_iterator_without_end():
    assert run(3, X, conde([eq(X, n)] for n in count())) == (0, 1, 2)
    assert run(3, X, lany(eq(X, n) for n in count())) == (0, 1, 2)
    assert "other" in run(9, X, lany(lany(eq(X, n) for n in count()), eq(X, "other")))


def test_goals_of_an_iterator_hold_again_and_again():
    goal = lall(eq(X, n) for n in (1, 1))
    assert run(0, X, goal) == run(0, X, goal) == (1,)
    either = lany(eq(X, n) for n in (1, 2))
    assert run(0, X, either) == run(0, X, either) == (1, 2)


def test_zzz_is_known():
    def ones(x):
        return lany(eq(x, 1), Zzz(ones, x=x))

    assert run(3, X, ones(X)) == (1, 1, 1)


def test_a_filter_sees_the_answers():
    assert run(0, X, membero(X, [1, 2, 1]), results_filter=lambda found: iter(dict.fromkeys(found))) == (1, 2)


# --- the same answers as kanren's ----------------------------------------------------------------------------------


def hashable(answer):
    return tuple(map(hashable, answer)) if isinstance(answer, (list, tuple)) else "_" if isvar(answer) else answer


def agree(answers, name, *args):
    """Ours and kanren's own goal of that name, asked for the same, with types and numbers of answers."""
    found = run(0, answers, getattr(mk, name)(*args))
    wanted = kanren.run(0, answers, getattr(kanren, name)(*args))
    assert Counter(map(hashable, found)) == Counter(map(hashable, wanted))
    assert Counter(type(x) for x in found) == Counter(type(x) for x in wanted)


@given(sequences, sequences, st.sampled_from("abc"))
def test_goals_about_ground_sequences_answer_as_kanrens(left, right, item):
    whole = type(left)([*left, *right]) if type(left) is type(right) else left
    agree(X, "membero", X, left)
    agree(X, "membero", item, left)
    agree(X, "appendo", left, right, X)
    agree(X, "appendo", left, X, whole)
    agree((X, Y), "appendo", X, Y, whole)
    agree(X, "appendo", left, right, whole)
    agree(X, "rembero", item, left, X)
    agree(X, "itero", left)
    agree(X, "nullo", left, X)
    agree(X, "permuteo", left, X)
    agree(X, "permuteo", left, right)
    agree(X, "permuteo", left, type(left)(reversed(left)))
    agree(X, "heado", X, left)
    agree(X, "tailo", X, left)
    agree(X, "conso", item, left, X)


goals = st.recursive(
    st.tuples(st.just("eq"), terms, terms),
    lambda inner: st.tuples(st.sampled_from(["lall", "conde"]), st.lists(inner, min_size=1, max_size=3)),
    max_leaves=5,
)


def built(goal, names):
    if goal[0] == "eq":
        return names.eq(theirs(goal[1]), theirs(goal[2]))
    parts = [built(part, names) for part in goal[1]]
    return names.lall(*parts) if goal[0] == "lall" else names.conde(*[[part] for part in parts])


def ends(goal):
    """Whether kanren comes to an end: no equation, in any choice, leads to an endless term."""
    if goal[0] == "eq":
        return [[goal[1:]]]
    parts = [ends(part) for part in goal[1]]
    if goal[0] == "conde":
        return [choice for part in parts for choice in part]
    choices = [[]]
    for part in parts:
        choices = [[*before, *choice] for before in choices for choice in part]
    return choices


def circular(pairs):
    """Whether the equations, taken in order, come to a variable that would be bound to a term that contains it."""
    state = {}
    for left, right in pairs:
        try:
            state = stream_eval(_unify(theirs(left), theirs(right), state), _Guard(state))
        except _Circular:
            return True
        if state is False:
            return False
    return False


@given(goals)
def test_goals_of_any_shape_answer_as_kanrens_where_those_end(goal):
    if not any(circular(choice) for choice in ends(goal)):
        found = run(0, (X, Y, Z), built(goal, mk))
        assert Counter(map(hashable, found)) == Counter(map(hashable, kanren.run(0, (X, Y, Z), built(goal, kanren))))


def test_every_name_of_kanrens_is_here():
    wanted = {name for name in vars(kanren) if not name.startswith("_")} - {"core", "facts", "goals", "term", "version"}
    wanted -= {"constraints", "util", "cons", "arguments", "operator", "unifiable_with_term", "graph", "assoccomm"}
    assert wanted <= set(dir(mk)), wanted - set(dir(mk))
    assert {heado, tailo, conso, nullo, itero, rembero, permuteo} <= {getattr(mk, name) for name in mk.__all__}
