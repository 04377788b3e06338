"""Goals over rows that are undefined: the certain ones first, then that more may hold."""

from __future__ import annotations

import pytest
from kanren import var

from casper.kb.base import KnowledgeBase
from casper.kb.errors import Undefined

TEXT = """
e(a, b). e(c, c). e(d, f(c)).
w(X, Y) :- e(X, Y), \\+ w(Y, X).
v(1, X) :- e(X, _), \\+ v(1, X).
v(2, a).
u(X) :- e(X, _), Y is 1 / 0, Y > 1.
"""
x, y = var(), var()


@pytest.fixture(scope="module")
def base():
    return KnowledgeBase.from_text(TEXT)


def found(goal):
    """The values of x and y in every state, and the sentence of what is undefined."""
    rows = []
    try:
        for state in goal({}):
            rows.append((state.get(x), state.get(y)))
    except Undefined as doubt:
        return rows, doubt.sentence
    return rows, ""


@pytest.mark.parametrize(
    ("args", "rows", "sentence"),
    [
        ((x, y), [("a", "b"), ("d", ("f", "c"))], "w(c, c) is undefined"),
        (("a", y), [(None, "b")], ""),
        (("c", y), [], "w(c, c) is undefined"),
        (("c", "c"), [], "w(c, c) is undefined"),
        (("a", "b"), [(None, None)], ""),
        (("d", "b"), [], ""),
        ((x, x), [], "w(c, c) is undefined"),
        ((x, ("f", y)), [("d", "c")], ""),
        (("d", ("f", "c")), [(None, None)], ""),
        (("d", ["f", "c"]), [], ""),
    ],
)
def test_the_certain_rows_come_before_what_is_undefined(base, args, rows, sentence):
    assert found(base.w(*args)) == (rows, sentence)


def test_a_row_that_holds_is_not_doubted_for_the_sake_of_others(base):
    assert found(base.v(2, "a")) == ([(None, None)], "")
    assert found(base.v(x, "a")) == ([(2, None)], "v(1, a) is undefined")
    assert found(base.v(3, "a")) == ([], "")


def test_what_rests_on_an_evaluation_without_value_is_undefined(base):
    assert found(base.u("a")) == ([], "u(a) is undefined")
    assert found(base.u("b")) == ([], "")


def test_a_predicate_says_its_name(base):
    assert repr(base.w) == "<predicate w>"
