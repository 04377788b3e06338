"""Plain resolution on goals about goals: what they ask for, item by item, and what is not followed."""

from __future__ import annotations

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Variable
from casper.kb.terms.unification import substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.text.reader import read_query
from casper.kb.top_down.plain import PlainSolver

TEXT = """
n(1). n(2). e(1, a). e(2, b). t(1, a, x).
add(X, Y, Z) :- Z is X + Y.
u(X) :- n(X), Y is 1 / 0, Y > X.
"""


def solver():
    base = KnowledgeBase.from_text(TEXT).solver()
    return PlainSolver(base.relations, base.clauses, base.computed, 5_000)


def found(question):
    """The values of X in every answer, those that are undefined with a question mark."""
    [body] = read_query(question)
    answers = solver().possible(list(body))
    return [f"{term_text(substitute(Variable('X'), answer))}{'?' if DOUBT in answer else ''}" for answer in answers]


@pytest.mark.parametrize(
    ("question", "values"),
    [
        ("maplist(n, [1, X])", ["1", "2"]),
        ("maplist(e, [1, 2], X)", ["[a, b]"]),
        ("maplist(e, X, [b, a])", ["[2, 1]"]),
        ("maplist(t, [1], X, [x])", ["[a]"]),
        ("maplist(add(1), [1, 2], X)", ["[2, 3]"]),
        ("maplist(n, []), X = yes", ["yes"]),
        ("maplist(e, [1, 2], [X])", []),
        ("maplist(n, [1, 3]), X = yes", []),
        ("X = 3, maplist(<(1), [2, X])", ["3"]),
        ("maplist(integer, [1, 2]), X = yes", ["yes"]),
        ("maplist(u, [X])", ["1?", "2?"]),
        ("call(n, X)", ["1", "2"]),
        ("call(e(X), b)", ["2"]),
        ("call(e, X, b)", ["2"]),
        ("call(5, 1), X = yes", []),
        ("n(X), not(e(X, a))", ["2"]),
        ("n(X), not(not(e(X, a)))", ["1"]),
        ("n(X), not(\\+ e(X, a))", ["1"]),
        ("n(X), call(\\+ e(X, a))", ["2"]),
        ("n(X), not(u(X))", ["1?", "2?"]),
        ("n(X), call(<, X, 2)", ["1"]),
        ("G = n, call(G, X)", ["1", "2"]),
        ("member(X, [1, 3]), n(X)", ["1"]),
        ("length(L, 1), L = [X], n(X)", ["1", "2"]),
    ],
)
def test_a_goal_about_goals_asks_for_each_of_them(question, values):
    assert found(question) == values


@pytest.mark.parametrize(
    "question",
    ["maplist(n, X)", "maplist(e, X, _)", "foldl(add, [1, 2], 0, X)", "include(n, [1, 5], X)", "G = once, call(G, n(X))"],
)
def test_what_is_not_followed_is_unknown(question):
    with pytest.raises(BudgetExceeded, match="beside something undefined is not followed: the answer is unknown"):
        found(question)


@pytest.mark.parametrize("question", ["call(G, X)", "maplist(G, [X])"])
def test_a_goal_that_nothing_makes_known_is_refused(question):
    with pytest.raises(ProgramError, match="cannot be decided"):
        found(question)


def test_what_is_valid_is_asked_for_and_its_doubts_are_kept():
    text = 'n(1). n(2). n(0). w(X) :- n(X). never("no twos") :- claim(w(X)), X = 2. never("ratio") :- claim(w(X)), Y is 1 / X, Y > 5.'
    base = KnowledgeBase.from_text(text).solver()
    plain = PlainSolver(base.relations, base.clauses, base.computed, 5_000)
    [body] = read_query("valid(w(X))")
    answers = [(answer.get(Variable("X")), DOUBT in answer) for answer in plain.possible(list(body))]
    assert (1, False) in answers and (2, False) not in answers and (None, True) in answers


@pytest.mark.parametrize(
    ("limit", "sentence"),
    [({"deadline": 0.0}, "stopped when its time was up"), ({"cancelled": lambda: True}, "the search was cancelled")],
)
def test_plain_resolution_stops_when_it_is_told_to(limit, sentence):
    base = KnowledgeBase.from_text("r(a). p(X) :- q(X), X = X. q(X) :- p(X), X = X.").solver()
    plain = PlainSolver({}, base.clauses, {}, 10**6, **limit)
    [body] = read_query("p(X)")
    with pytest.raises(BudgetExceeded, match=sentence):
        list(plain.possible(list(body)))


def test_over_other_relations_it_begins_anew_and_keeps_its_bounds():
    plain = solver()
    plain.steps, plain.doubts_hold = 7, True
    other = plain.over({}, floundering_fails=True)
    assert (other.steps, other.doubts_hold, other.floundering_fails, other.budget) == (0, False, True, 5_000)
    assert other.relations == {} and plain.steps == 7 and not plain.over({}).floundering_fails
    assert plain.plain() is plain


def test_what_nothing_binds_fails_where_that_is_asked_for():
    [body] = read_query("X < Y")
    assert list(solver().over({}, floundering_fails=True).possible(list(body))) == []


def test_the_steps_of_built_ins_are_counted_and_bounded():
    plain = solver()
    [body] = read_query("between(1, inf, X), X < 0")
    with pytest.raises(BudgetExceeded):
        list(plain.possible(list(body)))
    assert plain.steps >= 5_000
