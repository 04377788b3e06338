"""Goals that a used text hands to built-ins are its own, whatever the text that uses it defines under that name."""

from __future__ import annotations

import re

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.builtins import MOST_EXTRA
from casper.kb.terms.syntax import term_text
from casper.kb.text.namespace import prefixed
from casper.kb.text.reader import read_text

OWN = """
small(1). small(2). two(1, 3). two(2, 3).
add(X, A, B) :- B is A + X. add(X, Y, A, B) :- B is A + X * Y.
three(X, Y, Z) :- Z is X + Y.
"""
OTHERS = "small(5). two(5, 5). add(_, A, A). add(_, _, A, A). three(_, _, 0)."
RULES = {
    "p(L) :- include(small, [1, 5, 2], L).": "[1, 2]",
    "p(L) :- exclude(small, [1, 5, 2], L).": "[5]",
    "p(L) :- partition(small, [1, 5, 2], _, L).": "[5]",
    "p(S) :- foldl(add, [1, 2, 3], 0, S).": "6",
    "p(S) :- foldl(add, [1, 2, 3], [4, 5, 6], 0, S).": "32",
    "p(yes) :- maplist(small, [1, 2]).": "yes",
    "p(L) :- maplist(two, [1, 2], L).": "[3, 3]",
    "p(L) :- maplist(three, [1, 2], [3, 4], L).": "[4, 6]",
    "p(L) :- maplist(three(10), [1, 2], L).": "[11, 12]",
    "p(X) :- call(small, X), X > 1.": "2",
    "p(X) :- call(small(X)), X > 1.": "2",
    "p(X) :- call(add(1), 2, X).": "3",
    "p(L) :- findall(X, small(X), L).": "[1, 2]",
    "p(N) :- aggregate_all(count, small(_), N).": "2",
    "p(yes) :- forall(small(X), two(X, 3)).": "yes",
    "p(X) :- (small(5) -> X = 0 ; small(2) -> X = 1).": "1",
    "p(X) :- small(X), \\+ (small(Y), Y > X).": "2",
    "p(L) :- include(<(1), [1, 5], L).": "[5]",  # a built-in stays one
    "p(L) :- include(integer, [1, a], L).": "[1]",
}


def answers(sentences, question):
    return [term_text(answer["X"]) for answer in KnowledgeBase(list(sentences)).query(question)]


@pytest.mark.parametrize("rule", RULES)
def test_the_goals_of_a_used_text_are_its_own(rule):
    used = prefixed(read_text(OWN + rule), "home")
    assert answers([*used, *read_text(OTHERS)], "home:p(X)") == [RULES[rule]] == answers(read_text(OWN + rule), "p(X)")


@pytest.mark.parametrize("rule", RULES)
def test_a_goal_with_a_prefix_is_the_used_text_s(rule):
    meant = re.sub(r"\b(small|two|add|three)\b", r"home:\1", rule)
    assert answers([*prefixed(read_text(OWN), "home"), *read_text(f"{OTHERS} {meant}")], "p(X)") == [RULES[rule]]


def test_a_built_in_that_a_text_defines_itself_takes_no_goal():
    used = prefixed(read_text("include(a, b). small(1). p(X) :- include(X, b)."), "home")
    assert answers(used, "home:p(X)") == ["a"]


@pytest.mark.parametrize(
    ("condition", "needed"),
    [
        *[("include(no, [1], _)", "no/1"), ("exclude(no(1), [1], _)", "no/2"), ("partition(no, [1], _, _)", "no/1")],
        *[("foldl(no, [1], 0, _)", "no/3"), ("foldl(no, [1], [2], 0, _)", "no/4"), ("foldl(no(1), [1], 0, _)", "no/4")],
        *[("maplist(no, [1])", "no/1"), ("maplist(no, [1], _)", "no/2"), ("maplist(no, [1], _, _)", "no/3")],
    ],
)
def test_a_goal_that_nothing_defines_is_named_with_the_arguments_that_it_gets(condition, needed):
    with pytest.raises(CasperError, match=f"nothing defines {needed}"):
        KnowledgeBase.from_text(f"p :- {condition}.").compile()


def test_call_adds_as_many_arguments_as_it_may():
    most = ", ".join("abcdefghi"[:MOST_EXTRA])
    base = KnowledgeBase.from_text(f"q({most}). p(G) :- call(G, {most}).")
    assert MOST_EXTRA == 7 and base.ask("p(q)")
    with pytest.raises(CasperError, match="nothing defines call/9"):
        KnowledgeBase.from_text(f"p(G) :- call(G, {most}, x).").compile()
