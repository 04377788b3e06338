"""What is looked up in stored rows while searching: arguments that are known, open, or terms that are partly so."""

import pytest

from casper.kb.base import KnowledgeBase

FACTS = "n(1). n(2). e(f(1, a)). e(f(2, b)). e(f(2, c)). e(g(1, d)). e(k)."


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("n(Y), e(f(Y, Z))", [(1, "a"), (2, "b"), (2, "c")]),
        ("n(Y), X = f(Y, V), V = a, e(X), Z = V", [(1, "a")]),
        ("X = f(Y, Z), n(Y), e(X)", [(1, "a"), (2, "b"), (2, "c")]),
        ("n(Y), Y > 1, e(f(Y, Z)), \\+ e(g(Y, Z))", [(2, "b"), (2, "c")]),
        ("e(g(Y, Z)), e(f(Y, _))", [(1, "d")]),
        ("n(Y), e(Z), Z = k", [(1, "k"), (2, "k")]),
    ],
)
def test_a_term_in_a_look_up_agrees_with_the_rows_that_fit_it(body, expected):
    base = KnowledgeBase.from_text(f"{FACTS} p(Y, Z, _) :- {body}.")  # with an open argument it is searched for
    assert base.stored(("p", 3)) is None
    assert sorted((answer["Y"], answer["Z"]) for answer in base.query("p(Y, Z, any)")) == expected
