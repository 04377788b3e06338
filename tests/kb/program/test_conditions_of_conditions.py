"""Conditions that are made of other conditions: what they mean, negated too."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError

FACTS = "n(1). n(2). m(2). k(3)."


def values(condition):
    base = KnowledgeBase.from_text(f"{FACTS} p(X) :- {condition}.")
    found = [answer["X"] for answer in base.query("p(X)")]
    assert sorted(x for (x,) in base.rows("p", 1)) == sorted(found)
    return found


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("forall(n(Y), Y < 3)", True),
        ("forall(n(Y), Y < 2)", False),
        ("forall(n(Y), m(Y))", False),
        ("\\+ forall(n(Y), Y < 3)", False),
        ("\\+ forall(n(Y), Y < 2)", True),
        ("\\+ \\+ forall(n(Y), Y < 3)", True),
        ("not(forall(n(Y), Y < 2))", True),
        ("findall(Y, n(Y), [1, 2])", True),
        ("\\+ findall(Y, n(Y), [1, 2])", False),
        ("\\+ findall(Y, n(Y), [3])", True),
        ("\\+ aggregate_all(count, n(_), 2)", False),
        ("\\+ aggregate_all(count, n(_), 3)", True),
        ("call((n(1), n(2)))", True),
        ("call((n(1), n(3)))", False),
        ("call((n(5) ; m(2)))", True),
        ("not((n(1), m(1)))", True),
        ("\\+ (n(5) ; m(2))", False),
        ("\\+ (n(5) ; m(5))", True),
        ("\\+ (n(5) ; m(5) ; k(5))", True),
        ("\\+ (n(5) ; m(5) ; k(3))", False),
        ("(n(5) ; m(5) ; k(3))", True),
        ("(n(1) -> m(1) ; k(3))", False),
        ("(n(5) -> m(1) ; k(3))", True),
        ("\\+ (n(1) -> m(1) ; k(3))", True),
        ("\\+ (n(1), m(1))", True),
        ("\\+ (n(Y), m(Y))", False),
        ("true", True),
        ("fail", False),
        ("false", False),
        ("\\+ true", False),
        ("\\+ fail", True),
        ("\\+ \\+ n(1)", True),
        ("\\+ not(n(1))", True),
        ("call(call(n, 1))", True),
        ("(n(1), n(2))", True),
        ("(n(5) -> true ; (n(6) -> true ; n(2)))", True),
    ],
)
def test_a_condition_of_conditions_holds_or_does_not(condition, holds):
    assert values(f"k(X), {condition}") == [3] * holds


@pytest.mark.parametrize(
    ("condition", "found"),
    [
        ("(n(X) ; m(X) ; k(X))", [1, 2, 3]),
        ("(n(X), \\+ m(X) ; k(X))", [1, 3]),
        ("n(X), (m(X) -> true ; X < 2)", [1, 2]),
        ("(n(2) -> k(X) ; n(X))", [3]),
        ("(n(5) -> k(X) ; n(X))", [1, 2]),
        ("call(n, X), forall(m(Y), Y > X)", [1]),
        ("n(X), \\+ forall(n(Y), Y =< X)", [1]),
        ("aggregate_all(count, n(_), X)", [2]),
        ("findall(Y, m(Y), [X])", [2]),
        ("k(Z), aggregate_all(count, (n(Y), Y < Z), X)", [2]),
        ("m(Z), aggregate_all(count, (n(Y), Y < Z), X)", [1]),
        ("m(Z), aggregate_all(count, Z > 1, X)", [1]),
        ("n(Z), aggregate_all(count, \\+ m(Z), X)", [0, 1]),
        ("n(Z), aggregate_all(count, (k(_), \\+ m(Z)), X)", [0, 1]),
        ("n(Z), findall(W, (k(W), \\+ m(Z)), [X])", [3]),
        ("m(Z), findall(Y-Z, (n(Y), Y < Z), [X-2])", [1]),
        ("n(Z), Z > 1, aggregate_all(max(Y), (n(Y), Y =< Z), X)", [2]),
    ],
)
def test_a_condition_of_conditions_finds_values(condition, found):
    assert sorted(values(condition)) == found


@pytest.mark.parametrize("condition", ["findall(Y, 5, X)", "aggregate_all(count, 5, X)", "aggregate_all(every, n(Y), X)", "call(5, X)"])
def test_what_is_no_goal_is_refused(condition):
    with pytest.raises(ProgramError):
        KnowledgeBase.from_text(f"{FACTS} p(X) :- {condition}.").compile()
