"""Reasons in words: what fails, as a person would say it."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.reasons.wording import failure_sentence, noun_phrase
from casper.kb.text.reader import read_query


@pytest.mark.parametrize(
    ("condition", "sentence"),
    [
        ("human(tia)", "tia is not a human"),
        ("\\+ human(tia)", "tia is a human"),
        ("agent(tia)", "tia is not an agent"),
        ("eatable(egg)", "egg is not eatable"),
        ("biscuits(egg)", "egg is not biscuits"),
        ("human(X)", "nothing is a human"),
        ("on(a, b)", "on(a, b) does not hold"),
        ("\\+ on(a, b)", "on(a, b) holds"),
        ("rain", "rain does not hold"),
        ("\\+ rain", "rain holds"),
        ("human(f(X))", "human(f(X)) does not hold"),
        ("a = b", "a is not b"),
        ("a == b", "a is not b"),
        ("a \\= a", "both are a"),
        ("X \\= a", "X is a"),
        ("\\+ a = a", "both are a"),
        ("\\+ X = a", "X is a"),
        ("\\+ a \\= b", "a is not b"),
        ("3 < 2", "3 < 2 does not hold"),
        ("\\+ 2 < 3", "2 < 3 holds"),
        ("4 is 1 + 2", "4 is 1 + 2 does not hold"),
    ],
)
def test_why_a_condition_does_not_hold_is_one_sentence(condition, sentence):
    ((literal,),) = read_query(condition)
    assert failure_sentence(literal) == sentence


@pytest.mark.parametrize(
    ("name", "phrase"),
    [
        ("vessel", "a vessel"), ("agent", "an agent"), ("glass", "a glass"), ("hobs", "hobs"), ("food", "food"),
        ("open", "open"), ("broken", "broken"), ("washable", "washable"), ("table", "a table"), ("ring", "a ring"),
        ("empty", "empty"), ("plant", "a plant"), ("useful", "useful"), ("coffee_table", "coffee table"), ("old", "old"),
    ],
)  # fmt: skip
def test_a_predicates_name_says_what_something_is(name, phrase):
    assert noun_phrase(name) == phrase


def test_a_proof_as_a_graph_has_what_is_proved_as_its_first_node():
    kb = KnowledgeBase.from_text("q(a).\nr(a).\ns(X) :- q(X).\np(X) :- q(X), s(X), r(X).")
    graph = kb.why("p(a)").to_networkx()
    assert sorted(graph)[0] == 0
    assert {(graph.nodes[a]["text"], graph.nodes[b]["text"]) for a, b in graph.edges} == {
        ("p(a)", "q(a)"), ("p(a)", "s(a)"), ("p(a)", "r(a)"), ("s(a)", "q(a)"),
    }  # fmt: skip
    assert graph.nodes[0] == {"text": "p(a)", "by": "rule", "place": "<text>:4"}
