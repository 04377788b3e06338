"""Large values are work: a search that makes them without end stops by its budget, long before the memory is full."""

import sys

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded

ENDLESS = [
    ("p(a). p(X) :- p(Y), atom_concat(Y, Y, X).", "p(X), X = b", "stopped after 20000 steps"),
    ("l(X) :- atom_concat(X, X, Y), l(Y).", "l(ab)", "stopped after 20000 steps"),
    ("l(X, A) :- Y is X + 2 ** 900000, l(Y, [X | A]).", "l(1, [])", "stopped after 20000 steps"),
    ("l(N, L) :- length(L, _), l(N, [N | L]).", "l(1, [])", "stopped after 20000 steps"),
    (
        "go(N) :- numlist(1, 5000, L), l(N, L). l(N, L) :- msort(L, _), M is N + 1, l(M, L).",
        "go(1)",
        "after 20000 steps",
    ),
    ("l(X) :- m(X, Y), l(Y). m(X, [X, a | X]). m(b, b).", "l([])", "the answer is unknown"),
    ("go(L) :- length(L, 1000000000).", "go(L)", "a term of more than 4,194,304 parts"),
    ("go(L) :- nth0(1000000000, L, a).", "go(L)", "a term of more than 4,194,304 parts"),
]


@pytest.mark.parametrize(("text", "goal", "told"), ENDLESS)
def test_what_grows_without_end_is_unknown_soon_and_takes_little_memory(text, goal, told):
    base, held = KnowledgeBase.from_text(text), sys.getallocatedblocks()
    with pytest.raises(BudgetExceeded, match=told):
        list(base.query(goal, budget=20_000))
    assert sys.getallocatedblocks() - held < 1_000_000


CHAINS = ["p{n}(f(X, X)) :- p{m}(X).", "p{n}(Z) :- p{m}(X), Z = f(X, X)."]


@pytest.mark.parametrize("rule", CHAINS)
def test_rows_that_double_from_rule_to_rule_are_refused_before_they_are_too_large(rule):
    rules = " ".join(rule.format(n=at + 1, m=at) for at in range(30))
    with pytest.raises(BudgetExceeded, match=r"a term of more than 4,194,304 parts"):
        list(KnowledgeBase.from_text(f":- stored(p30/1). p0(a). {rules}").query("p30(X)"))


def test_an_atom_is_never_longer_than_any_budget_lets_it_be():
    base = KnowledgeBase.from_text("l(X) :- atom_concat(X, X, Y), l(Y).")
    with pytest.raises(BudgetExceeded, match="an atom of more than 16,777,216 characters"):
        list(base.query("l(ab)", budget=10**9))


def test_a_list_may_be_long_and_looked_at_often():
    base = KnowledgeBase.from_text(
        "go(N) :- numlist(1, 50000, L), length(L, N), last(L, N), msort(L, M), nth1(N, M, N)."
    )
    assert base.ask("go(50000)")
