"""Questions joined on columns: the answers of plain look-ups, in bounded memory."""

from __future__ import annotations

from collections import Counter
from contextlib import contextmanager
from itertools import islice

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.relations.tables import answers, joins
from casper.kb.store import queries
from casper.kb.terms.terms import Compound
from casper.kb.top_down import joining

VALUES = ("a", "b", 0, 1, 2, -3, 0.5, 2.5, 1 << 60, Compound(("p", 1)))
NUMBERS = (0, 1, 2, 3, -3, 7)
rows = st.lists(st.tuples(st.sampled_from(VALUES), st.sampled_from(VALUES)), max_size=8)
numeric = st.lists(st.tuples(st.sampled_from(NUMBERS), st.sampled_from(NUMBERS)), max_size=8)
mixed = st.lists(st.tuples(st.sampled_from((1, 2, 0.5, 2.5)), st.sampled_from((1.0, 2.0, -0.25, 4))), max_size=6)
CONDITIONS = ["r(X, Y)", "s(Y, Z)", "s(Z, X)", "r(X, X)", "r(X, _)", "s(_, Z)", "r(a, Y)", "s(Y, 1)", "flag", "r(_Y, Z)"]
TESTS = ["\\+ s(X, Y)", "\\+ r(Y, _)", "\\+ flag", "X \\= Y", "X = Y", "X == 1", "Y \\== a", "\\+ X = Y", "W = p(1)", "W = X", "X \\= c"]
TESTS += ["\\+ s(_, _)", "X < Y", "X >= 1", "X =:= Y", "X =\\= 0.5", "W is X + Y", "W is X * Y - 1", "Y is X + 1", "W is max(X, Y) mod 3"]
TESTS += ["W is X // Y", "W is -X", "X + 1 < Y * 2", "\\+ X < Y", "W is X / 2.0", "W is 3, W > X", "W is X div 2, s(W, _)", "2 is X", "\\+ 1 is X"]
TESTS += ["W is X + 1, \\+ s(W, W)", "W is X + 0.5, V is W * 2", "W is 1 << 3", "member(W, [1, 2])", "findall(A, r(A, A), W)"]
questions = st.tuples(st.lists(st.sampled_from(CONDITIONS), min_size=1, max_size=3), st.lists(st.sampled_from(TESTS), max_size=2))


@contextmanager
def settings(worth, first, block):
    before = joining.WORTH, queries.AT_FIRST, joins.BLOCK
    joining.WORTH, queries.AT_FIRST, joins.BLOCK = worth, first, block
    try:
        yield
    finally:
        joining.WORTH, queries.AT_FIRST, joins.BLOCK = before


def base_of(r, s, text=""):
    base = KnowledgeBase.from_text(f":- dynamic([r/2, s/2, flag/0]). flag. {text}")
    base.facts("r", r)
    base.facts("s", s)
    return base


def told(question):
    """The answers, each counted, or the sentence of what is undefined."""
    found = Counter()
    try:
        for answer in question():
            found[frozenset(answer.items())] += 1
    except Undefined as doubt:
        return found, doubt.sentence
    return found, ""


def told_of_table(base, query):
    try:
        table = base.table(query)
        return Counter(frozenset(zip(table.columns, row)) for row in table)
    except Undefined as doubt:
        return doubt.sentence


@pytest.mark.parametrize("data", [rows, numeric, mixed], ids=["anything", "whole numbers", "numbers"])
@pytest.mark.parametrize("block", [1, 3, 1 << 16])
@given(picked=st.data())
def test_columns_give_the_answers_of_rows(data, block, picked):
    r, s, (looked_up, tests) = picked.draw(data), picked.draw(data), picked.draw(questions)
    base, query = base_of(r, s), ", ".join([*looked_up, *tests])
    with settings(10**9, 10**9, block):
        try:
            plain, table = told(lambda: base.query(query)), told_of_table(base, query)
        except ProgramError:
            return
    with settings(0, 1, block):
        assert told(lambda: base.query(query)) == plain
        assert told_of_table(base, query) == table


WHOLE = [(7, 2), (-7, 2), (7, -2), (-7, -2), (0, 3), (6, 3), (5, 5)]
REAL = [(0.5, 2.0), (-0.5, 0.25), (3.5, 3.5), (0.0, -4.0)]
EXPRESSIONS = ["X + Y", "X - Y", "X * Y", "X // Y", "X div Y", "X mod Y", "min(X, Y)", "max(X, Y)", "X / Y", "-X", "+X", "abs(X)"]
ORDERS = ["X < Y", "X > Y", "X =< Y", "X >= Y", "X =:= Y", "X =\\= Y", "X = Y", "X \\= Y", "X == Y", "X \\== Y"]


@pytest.mark.parametrize("data", [WHOLE, REAL], ids=["whole numbers", "floats"])
@pytest.mark.parametrize("condition", [*(f"W is {e}" for e in EXPRESSIONS), *ORDERS, *(f"\\+ {order}" for order in ORDERS)])
def test_every_operation_and_comparison_gives_on_columns_what_it_gives_of_each_row(condition, data):
    base, query = base_of(data, []), f"r(X, Y), {condition}"
    with settings(10**9, 10**9, 1 << 16):
        plain = told(lambda: base.query(query))
    with settings(0, 1, 1 << 16):
        assert told(lambda: base.query(query)) == plain
        if not plain[1]:
            assert told_of_table(base, query) == plain[0]


@pytest.mark.parametrize(
    "condition", ["W is X * Y", "W is X + Y", "W is X - Y", "X * Y > 1", "W is -X", "X + Y =:= Y + X", "W is abs(X) * 3"]
)
@pytest.mark.parametrize("large", [2**31, 2**40, 2**53, 2**62, 10**30])
def test_whole_numbers_never_overflow_on_columns(condition, large):
    data = [(large, large), (-large, large + 1), (1 - large, 2), (0, 0)]
    base, query = base_of(data, []), f"r(X, Y), {condition}"
    with settings(10**9, 10**9, 1 << 16):
        plain = told(lambda: base.query(query))
    with settings(0, 1, 1 << 16):
        assert told(lambda: base.query(query)) == plain


def test_a_comparison_of_no_rows_at_all_has_no_answer():
    base = base_of([(1, 2)], [(5, 6)])
    with settings(0, 1, 1 << 16):
        assert list(base.query("r(X, Y), s(Y, Z), W is X * Z + Y, W < 3")) == []


def test_answers_given_before_columns_gave_up_are_not_given_again():
    rows = [(at, at + 1) for at in range(10)] + [("far", 3)]  # the last one is no number
    base = base_of(rows, [])
    with settings(10**9, 10**9, 2):
        plain = told(lambda: base.query("r(X, Y), Y < 20, W is X + 1"))
    with settings(0, 1, 2):
        assert told(lambda: base.query("r(X, Y), Y < 20, W is X + 1")) == plain
    assert len(plain[0]) == 10 and plain[1]


@pytest.mark.parametrize(
    "query",
    ["r(X, Y), s(Y, Z)", "r(X, _)", "r(X, Y), \\+ s(X, Y)", "r(X, Y), X > Y", "r(X, Y), W is X + Y, s(_, W)", "r(X, Y), s(Y, W), X \\= W"],
)
def test_large_joins_negations_comparisons_and_arithmetic_are_worked_out_on_columns(query):
    base = base_of([(at, at % 50) for at in range(2_000)], [(at % 50, at) for at in range(2_000)])
    assert "many answers, so on columns: " in str(base.plan(query))
    with settings(joining.WORTH, queries.AT_FIRST, 100):
        table = told_of_table(base, query)
        before = base.stored(("r", 2)).touched
        assert sum(1 for _ in base.query(query)) == sum(table.values()) > 1_000
        assert base.stored(("r", 2)).touched - before <= 2_000  # the first answers come row by row


@pytest.mark.parametrize(
    ("query", "reason"),
    [
        ("r(X, Y), member(Z, [X])", "member(Z, [X]) is not looked up in rows that are all settled"),
        ("r(X, f(Y))", "r(X, f(Y)) looks into terms"),
        ("r(X, Y), Z is X ** Y", "X ** Y is worked out row by row"),
    ],
)
def test_a_plan_says_what_keeps_many_answers_from_columns(query, reason):
    base = base_of([(at, at % 50) for at in range(2_000)], [])
    assert str(base.plan(query)).endswith(f"row by row, not on columns: {reason}")


def test_few_answers_are_not_worth_columns():
    assert base_of([(1, 2)], [(2, 3)]).plan("r(X, Y), s(Y, Z)").columns == ""


def test_a_change_is_seen_by_the_next_join():
    base = base_of([(at, at) for at in range(3_000)], [(at, at) for at in range(3_000)])
    assert len(base.table("r(X, Y), s(Y, Z)")) == 3_000
    base.assert_("r(1, 2)")
    base.retract("s(7, 7)")
    assert len(base.table("r(X, Y), s(Y, Z)")) == 3_000
    assert len(base.assume("s(1, 2)", without=["r(5, 5)"]).table("r(X, Y), s(Y, Z)")) == 3_000
    assert len(base.table("r(X, Y), s(Y, Z)")) == 3_000


def test_a_product_is_enumerated_block_by_block():
    base = KnowledgeBase()
    base.facts("a", [(at,) for at in range(10_000)])
    base.facts("b", [(at,) for at in range(10_000)])
    query = "a(X), b(Y)"
    assert sum(1 for _ in islice(base.query(query), 5_000)) == 5_000
    assert base.ask("a(77)") and next(iter(base.query("a(77), b(9999)")), None) == {}
    with pytest.raises(BudgetExceeded, match=r"more than 15,000,000 answers, too many for one table; kb.query"):
        base.table(query)


def test_a_table_made_row_by_row_is_bounded_too(monkeypatch):
    monkeypatch.setattr(answers, "MOST_VALUES", 100)
    base = KnowledgeBase.from_text("n(X) :- between(1, 50, X).")
    with pytest.raises(BudgetExceeded, match="more than 10 answers, too many for one table"):
        base.table("n(X)")
