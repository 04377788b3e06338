"""Reasons in the author's words: ``say(Term, "… {X} …")``."""

import pickle

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.reasons.says import fits, parts_of
from casper.kb.terms.terms import Variable
from casper.kb.terms.unification import is_ground, substitute, unify
from casper.kb.text.namespace import prefixed
from casper.kb.text.reader import read_statement, read_text

HOME = r"""
person(rosa). robot(tia). needs(rosa, pills). needs(tia, pills).
:- dynamic(brought/2).
take(A, P) :- person(A), needs(A, P), brought(_, P).
never("nobody takes soap") :- claim(take(_, soap)).
say(take(A, P), "{A} takes {P}").
say(\+ take(A, P), "{A} cannot take {P}").
say(\+ brought(W, P), "{W} has not brought {P}").
say(\+ brought(_, _), "nobody has brought them yet").
say(person(X), "{X} is somebody").
say(rosa, "Rosa").  say(pills, "her pills").
say(fr, pills, "ses pilules").  say(fr, \+ take(A, P), "{A} ne peut pas prendre {P}").
say(fr, never("nobody takes soap"), "personne ne prend du savon").
"""


@pytest.fixture(scope="module")
def home():
    return KnowledgeBase.from_text(HOME)


def test_a_refusal_is_told_in_the_authors_words(home):
    told = str(home.verify("take(rosa, pills)"))
    assert told == "✘ Rosa cannot take her pills   [take(rosa, pills)]\n  because nobody has brought them yet"


def test_the_opposite_of_a_sentence_is_made_of_it_where_nobody_said_it(home):
    assert "it is not so that tia is somebody" in home.why_not("take(tia, pills)").reasons


def test_a_sentence_whose_value_is_open_is_left_to_the_next_one(home):
    assert home.why_not("brought(eve, pills)").reasons == ("eve has not brought her pills",)
    assert home.why_not("brought(_, pills)").reasons == ("nobody has brought them yet",)


def test_what_has_no_sentence_is_told_as_the_term_it_is(home):
    assert "needs(eve, pills) does not hold" in home.why_not("take(eve, pills)").reasons
    assert str(home.verify("take(X, pills)")).startswith("✘ take(X, pills) is not valid")


def test_a_proof_is_told_in_words_and_its_json_in_terms(home):
    proof = home.assume("brought(tia, pills)").why("take(rosa, pills)")
    assert str(proof).splitlines()[0].startswith("Rosa takes her pills")
    assert "brought(tia, pills)" in str(proof)
    assert proof.to_json()["fact"] == "take(rosa, pills)"
    assert str(pickle.loads(pickle.dumps(proof))) == str(proof)


def test_the_language_comes_first_and_behind_it_what_is_said_in_none(home):
    french = KnowledgeBase.from_text(HOME)
    french.language = "fr"
    assert str(french.verify("take(rosa, pills)")) == (
        "✘ Rosa ne peut pas prendre ses pilules   [take(rosa, pills)]\n  car nobody has brought them yet"
    )
    assert "personne ne prend du savon" in french.why_not("take(rosa, soap)").reasons
    assert pickle.loads(pickle.dumps(french)).language == "fr"
    assert "nobody takes soap" in home.why_not("take(rosa, soap)").reasons


def test_a_snapshot_keeps_its_language():
    kb = KnowledgeBase.from_text(HOME)
    before = kb.snapshot()
    kb.language = "fr"
    assert "cannot" in str(before.verify("take(rosa, pills)")) and "ne peut pas" in str(kb.verify("take(rosa, pills)"))


def test_changes_of_sentences_are_seen_at_once():
    kb = KnowledgeBase.from_text("a(1). b(X) :- a(X), c(X). :- dynamic(c/1).")
    assert kb.why_not("b(1)").reasons == ("1 is not a c",)
    kb.rule(r'say(\+ c(X), "no c: {X}")')
    assert kb.why_not("b(1)").reasons == ("no c: 1",)


def test_a_base_without_sentences_tells_what_it_told():
    kb = KnowledgeBase.from_text("human(ann). eat(A) :- human(A).")
    assert str(kb.verify("eat(tom)")) == "✘ eat(tom) is not valid\n  because tom is not a human"


def test_a_relation_of_the_authors_own_that_is_called_say_words_nothing():
    kb = KnowledgeBase.from_text("hears(ann, hello). say(W, T) :- hears(W, T).")
    assert kb.ask("say(ann, hello)") and not kb.words


def test_brackets_are_doubled():
    assert parts_of("{{x}} and { X }.") == ("{x} and ", "X", ".")


def test_a_list_is_told_item_by_item():
    kb = KnowledgeBase.from_text('say(all(L), "all of {L}"). say(a, "A"). all([a, b]).')
    assert str(kb.why("all([a, b])")).startswith("all of A, b ")


def test_comparisons_can_be_worded():
    kb = KnowledgeBase.from_text(r'old(X) :- age(X, N), N >= 70. age(ann, 8). say(\+ N >= _, "{N} is too young").')
    assert kb.why_not("old(ann)").reasons == ("8 is too young",)


TERMS = st.recursive(
    st.sampled_from(["a", "b", "X", "Y"]),
    lambda parts: st.builds(lambda x, y: f"f({x}, {y})", parts, parts),
    max_leaves=4,
)


@given(TERMS, TERMS)
@settings(max_examples=60)
def test_a_pattern_fits_exactly_its_instances(pattern, term):
    wanted, given_ = read_statement(f"p({pattern})"), read_statement(f"p({term.replace('X', 'c').replace('Y', 'd')})")
    bindings = unify(wanted, given_, {})
    found: dict = {}
    assert is_ground(given_) and fits(wanted, given_, found) == (bindings is not None)
    if bindings is not None:
        assert found == {name: substitute(Variable(name), bindings) for name in found}


def test_sentences_of_a_used_text_are_about_its_own_predicates():
    kb = KnowledgeBase()
    kb.add(prefixed(read_text(HOME), "home"))
    assert kb.why_not("home:take(rosa, pills)").reasons == ("nobody has brought them yet",)
