"""Terms whose parts are shared: as trees they double with every level, and no search hangs on them or fills the memory."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded
from casper.kb.terms.terms import Compound, Variable, make_list
from casper.kb.terms.unification import is_ground, substitute, unify, variables_of
from casper.kb.terms.values import sizes
from casper.kb.terms.values.sizes import check_size
from casper.kb.top_down.compiled import cells, unifying
from casper.kb.top_down.compiled.cells import UNBOUND, Trail, freeze, inward, undo, variant

DOUBLING = """
grow(0, X, X).
grow(N, X, Y) :- N > 0, M is N - 1, grow(M, f(X, X), Y).
same(N, X, Z) :- grow(N, X, A), grow(N, Z, B), A = B.
built(N, X) :- grow(N, X, f(_, _)).
refuted(N) :- grow(N, _, Y), \\+ Y = a.
tabled(Y) :- tabled(Y).
tabled(f(_, _)).
handed(N) :- grow(N, _, Y), tabled(Y).
counted(N, C) :- aggregate_all(count, grow(N, a, _), C).
identical(N, X, Z) :- grow(N, X, A), grow(N, Z, B), A == B.
different(N, X, Z) :- grow(N, X, A), grow(N, Z, B), A \\= B.
sum(0, X, X).
sum(N, X, Y) :- N > 0, M is N - 1, sum(M, X + X, Y).
value(N, V) :- sum(N, 1, E), V is E.
r(a).
found(N) :- grow(N, a, A), r(A).
"""
base = KnowledgeBase.from_text(DOUBLING)


@pytest.mark.parametrize(
    "goal", ["same(60, X, X)", "same(60, X, Z)", "same(60, X, a)", "same(60, a, a)", "built(60, X)"]
)
def test_what_is_shared_is_made_equal_once(goal):
    assert len(list(base.query(goal))) == 1


def test_what_differs_in_one_leaf_is_told_apart():
    assert not base.ask("same(60, a, b)") and base.ask("same(9, a, a)")


@pytest.mark.parametrize(("goal", "holds"), [("identical", True), ("different", False)])
def test_what_is_identical_is_told_without_going_through_it_as_a_tree(goal, holds):
    assert base.ask(f"{goal}(60, a, a)") is holds
    assert base.ask(f"{goal}(9, a, b)") is not holds


def test_an_expression_whose_parts_are_shared_has_its_value_where_it_is_small_enough():
    assert list(base.query("value(9, V)")) == [{"V": 512}]


@pytest.mark.parametrize(
    "goal",
    ["value(60, V)", "found(60)", "grow(60, X, Y)", "grow(60, a, Y)", "handed(60)", "refuted(60)", "counted(60, C)"],
)
def test_what_is_too_large_to_be_told_is_unknown(goal):
    with pytest.raises(BudgetExceeded, match=r"a term of more than 4,194,304 parts: the answer is unknown"):
        list(base.query(goal))


def test_what_is_not_asked_for_is_not_copied():
    assert len(list(base.query("grow(60, X, _Y)"))) == 1
    assert list(base.query("grow(60, a, _Y), X = b")) == [{"X": "b"}]


@given(st.integers(1, 60), st.sampled_from("ab"))
def test_terms_of_the_rest_of_the_system_are_looked_at_once_as_well(times, leaf):
    term, other = doubled(Variable("X"), times), doubled(Variable("Y"), times)
    assert unify(term, other, {}) == {Variable("X"): Variable("Y")}
    assert unify(Variable("X"), term, {}) is None
    assert list(variables_of(term)) == [Variable("X")] and not is_ground(term)
    closed = substitute(term, {Variable("X"): leaf})
    assert is_ground(closed)
    if times < 8:
        assert closed == doubled(leaf, times)


def doubled(part, times):
    for _ in range(times):
        part = Compound(("f", part, part))
    return part


def test_each_part_counts_as_often_as_it_occurs(monkeypatch):
    monkeypatch.setattr(sizes, "MOST_PARTS", 31)
    check_size([doubled("a", 5), doubled("b", 5)])
    with pytest.raises(BudgetExceeded):
        check_size([Compound(("g", doubled("a", 5)))])


def test_a_long_list_is_no_large_term_before_it_is_one(monkeypatch):
    monkeypatch.setattr(cells, "MANY", 10)
    long = make_list([Variable("X", at) for at in range(1_000)])
    assert len(variant([freeze(inward(long, {}), {})])) == len(variant([long]))


@st.composite
def shared(draw):
    """A term with variables, many of whose parts are one object."""
    parts = ["a", "b", Variable("X"), Variable("Y"), Variable("Z")]
    for _ in range(draw(st.integers(1, 8))):
        args = draw(st.lists(st.sampled_from(parts), min_size=1, max_size=3))
        parts.append(Compound((draw(st.sampled_from("fg")), *args)))
    return parts[-1]


def unified(left, right, many):
    """Whether two terms are made equal, and what they then are, when shared parts are remembered from so many on."""
    before, unifying.MANY = unifying.MANY, many
    try:
        known = {}
        both = [inward(left, known), inward(right, known)]
        trail = Trail()
        is_equal = unifying.unify(*both, trail, 1)
        holes = {}
        one, other = (freeze(term, holes, Compound) for term in both)
        assert one == other or not is_equal
        undo(trail, 0)
        assert all(cell[0] is UNBOUND for cell in known.values())
        return is_equal, variant([one, other]) if is_equal else None
    finally:
        unifying.MANY = before


@given(shared(), shared())
def test_what_is_remembered_of_shared_parts_changes_no_answer(left, right):
    assert unified(left, right, 0) == unified(left, right, 1 << 40)
