"""A recursive minimum on columns: the rows of the fixpoint on rows, each after what it rests on."""

from __future__ import annotations

from contextlib import contextmanager

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up.circles import least_columns, minimum
from casper.kb.bottom_up.join import Join
from casper.kb.errors import BudgetExceeded, NotOnColumns
from casper.kb.relations.relation import Relation

FROM_A = ":- table(far(_, min)). far(a, 0). far(Y, D) :- far(X, C), edge(X, Y, W), D is C + W."
PROGRAMS = {
    "from one": FROM_A,
    "all pairs": ":- table(far(_, _, min)). far(X, Y, D) :- edge(X, Y, D). far(X, Y, D) :- far(X, Z, C), edge(Z, Y, W), D is C + W.",
    "right recursion": ":- table(far(_, _, min)). far(X, Y, D) :- edge(X, Y, D). far(X, Y, D) :- edge(X, Z, W), far(Z, Y, C), D is W + C.",
    "widest": ":- table(far(_, _, max)). far(X, Y, D) :- edge(X, Y, D). far(X, Y, D) :- far(X, Z, C), edge(Z, Y, W), D is min(C, W).",
    "value first": ":- table(far(min, _)). far(D, Y) :- edge(a, Y, D). far(D, Y) :- far(C, X), edge(X, Y, W), D is max(C, W) + 1.",
    "bounded": ":- table(far(_, min)). far(a, 0). far(Y, D) :- far(X, C), C < 4, edge(X, Y, W), D is C + W, \\+ shut(Y), D =< 6.",
    "two": """:- table([far(_, min), near(_, min)]). far(a, 1). near(Y, D) :- far(X, D), edge(X, Y, _).
              far(Y, D) :- near(X, C), edge(X, Y, W), D is C + W - 1.""",
    "going round": ":- table(far(_, min)). far(X, 9) :- edge(X, _, _). far(Y, D) :- far(X, C), edge(X, Y, W), D is C - 0 * W.",
    "as it is": ":- table(far(_, min)). far(X, W) :- edge(X, X, W). far(Y, D) :- far(X, D), edge(X, Y, _).",
    "one key": ":- table(far(min)). far(W) :- edge(_, _, W). far(D) :- far(C), edge(b, _, W), D is C + W.",
    "turned by a test": ":- table(far(_, min)). far(a, 0). far(Y, D) :- far(X, C), edge(X, Y, W), D is C + W, C > 2.",
    "two recursive": ":- table(far(_, _, min)). far(X, Y, D) :- edge(X, Y, D). far(X, Y, D) :- far(X, Z, B), far(Z, Y, C), D is B + C.",
}
nodes, whole = st.sampled_from("abcd"), st.integers(0, 3)
weights = st.sampled_from([whole, st.integers(-1, 3), st.sampled_from([0.5, 1.5, 2.25]), st.sampled_from([1, 0.5, 2, "far"])])
graphs = weights.flatmap(lambda weight: st.lists(st.tuples(nodes, nodes, weight), max_size=8))


@contextmanager
def columns_from(size):
    before, minimum.COLUMNS_FROM = minimum.COLUMNS_FROM, size
    try:
        yield
    finally:
        minimum.COLUMNS_FROM = before


def model(text, edges):
    base = KnowledgeBase.from_text(":- dynamic([edge/3, shut/1]). shut(d).")
    base.facts("edge", edges)
    base.rule(text)
    return base._model


def rows(text, edges):
    try:
        found = model(text, edges).relations
    except BudgetExceeded as mistake:
        return str(mistake)
    return {i: (set(relation), set(relation.undefined or ())) for i, relation in found.items()}


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=PROGRAMS.keys())
@given(edges=graphs)
def test_columns_have_the_rows_of_rows(text, edges):
    with columns_from(10**9):
        expected = rows(text, edges)
    with columns_from(0):
        assert rows(text, edges) == expected


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=PROGRAMS.keys())
@given(edges=graphs)
def test_every_row_comes_after_what_it_rests_on(text, edges):
    with columns_from(0):
        try:
            found = model(text, edges)
        except BudgetExceeded:
            return
    relations = found.relations
    for indicator in found.program.least:
        for row in relations[indicator]:
            round_ = relations[indicator].round_of(row)
            earlier = {
                i: Relation(*i, (r for r in relation if relation.round_of(r) < round_)) for i, relation in relations.items()
            }
            checks = [Join(rule, bound_head=True) for rule in found.program.rules[indicator]]
            assert row in found.given[indicator] or any(check.derives(earlier, row) for check in checks)


@pytest.mark.parametrize("name", ["turned by a test", "two recursive"])
def test_rules_in_which_the_order_may_matter_are_left_to_rows(name):
    found = model(PROGRAMS[name], [("a", "b", 1)])
    with pytest.raises(NotOnColumns):
        least_columns.least_on_columns(found.program, frozenset(found.program.least), dict(found.relations), None, 0)


def test_a_large_minimum_is_worked_out_on_columns_and_followed_best_first():
    count = 5_000
    edges = [(at, (at * 3 + step) % count, 1 + step) for at in range(count) for step in (0, 1, 2)]
    found = model(FROM_A.replace("far(a, 0)", "far(0, 0)"), edges)
    assert found.relations["far", 2].interned() is not None
    with columns_from(10**9):
        expected = model(FROM_A.replace("far(a, 0)", "far(0, 0)"), edges).relations["far", 2]
    assert set(found.relations["far", 2]) == set(expected) and len(expected) == count


def test_a_long_line_that_is_followed_row_by_row_is_left_to_rows():
    found = model(FROM_A.replace("far(a, 0)", "far(0, 0)"), [(at, at + 1, 2) for at in range(2_500)])
    assert type(found.relations["far", 2]) is Relation and (2_500, 5_000) in found.relations["far", 2]
