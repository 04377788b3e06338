"""Answers and sentences as text and as JSON."""

import pickle

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.relations.relation import Relation
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unknown import UNKNOWN, has_unknown, may_equal
from casper.kb.text.lines import text_of
from casper.kb.text.writer import answer_json, answer_text, program_lines, sentence_text


def test_an_answer_is_its_values_or_yes():
    assert answer_text({"T": "meal", "D": Compound(("on", "plate", "a b"))}) == 'T = meal, D = on(plate, "a b")'
    assert answer_text({}) == "yes"


def test_in_json_numbers_and_atoms_stay_and_terms_are_text():
    answer = {"A": "x", "N": 2, "F": 0.5, "T": Compound(("f", "x")), "L": (".", 1, "[]"), "V": Variable("V")}
    assert answer_json(answer) == {"A": "x", "N": 2, "F": 0.5, "T": "f(x)", "L": "[1]", "V": None}


def test_of_many_sentences_the_first_are_shown_and_the_others_counted():
    clauses = KnowledgeBase.from_text("p(a). p(b). p(c).").clauses
    assert text_of(program_lines(clauses, 2)) == "p(a).\np(b).\n% … and 1 more"
    assert text_of(program_lines(clauses, 3)) == "p(a).\np(b).\np(c)."
    assert text_of(program_lines([])) == "% nothing is stated"


def test_what_is_no_sentence_is_refused():
    with pytest.raises(TypeError, match="is no sentence of the language"):
        sentence_text("p(a).")


def test_a_refusal_prints_its_reasons_one_a_line():
    base = KnowledgeBase.from_text("human(ann). dog(rex). p(X) :- human(X), big(X). p(X) :- dog(X), small(X). :- dynamic([big/1, small/1]).")
    refusal = base.why_not("p(tom)")
    assert str(refusal).splitlines() == list(refusal.reasons) and len(refusal.reasons) > 1


def test_a_relation_says_what_it_is():
    assert repr(Relation("p", 2, [("a", "b")])) == "<p/2: 1 rows>"


def test_the_unknown_stays_the_one_it_is():
    assert pickle.loads(pickle.dumps(UNKNOWN)) is UNKNOWN
    term = Compound(("f", "a", Compound(("g", UNKNOWN))))
    assert has_unknown(UNKNOWN) and has_unknown(term) and not has_unknown("a") and not has_unknown(Compound(("f", "a")))


@pytest.mark.parametrize(
    ("left", "right", "may"),
    [
        (("f", "a", UNKNOWN), ("f", "a", ("g", 1)), True),
        (("f", "a", ("g", UNKNOWN)), ("f", "a", ("g", 1)), True),
        (("f", "a", ("g", UNKNOWN)), ("f", "b", ("g", 1)), False),
        (("f", "a", ("g", UNKNOWN)), ("f", "a", ("g", 1, 2)), False),
        (("f", UNKNOWN), "f", False),
        ("f", ("f", UNKNOWN), False),
        (1, 1.0, True),
        ("a", "b", False),
    ],
)
def test_two_terms_may_be_equal_for_some_value_of_what_is_unknown(left, right, may):
    assert may_equal(left, right) is may


def test_the_unit_of_a_place_may_be_asked_for_backwards():
    from casper.kb.text.parsing.places import Places

    places = Places("ab\ncd\n\nef", "t.pl")
    offsets = [0, 4, 7, 4, 3, 8, 0]
    assert [(places.of(at).line, places.of(at).column) for at in offsets] == [(1, 1), (2, 2), (4, 1), (2, 2), (2, 1), (4, 2), (1, 1)]
