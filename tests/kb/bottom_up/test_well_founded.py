"""Negation in circles: SWI-Prolog's well-founded tabling says the same of random programs, undefined atoms included."""

from __future__ import annotations

import pytest
from circles import compare
from swi import MANY, needs_swi

from casper.kb.base import KnowledgeBase
from casper.kb.checks.check import check_text
from casper.kb.errors import BudgetExceeded, Undefined


@needs_swi
def test_random_circles_of_negation_mean_what_swi_prolog_says(tmp_path):
    tally = compare(MANY, 20, tmp_path)
    assert tally.disagreements == []
    assert tally.undefined > MANY / 10
    assert tally.asked - tally.equal <= MANY / 1000  # SWI-Prolog 9.0 leaves a few answers conditional that are settled


GAME = "move(a, b). move(b, a). move(b, c). move(x, y). move(y, x). win(X) :- move(X, Y), \\+ win(Y)."


def test_a_game_has_won_lost_and_drawn_positions():
    base = KnowledgeBase.from_text(GAME)
    assert {at: base.truth(f"win({at})") for at in "abcxy"} == {
        "a": "false", "b": "true", "c": "false", "x": "undefined", "y": "undefined",
    }  # fmt: skip


def test_asking_what_is_undefined_raises_with_the_circle():
    base = KnowledgeBase.from_text(GAME)
    with pytest.raises(Undefined) as caught:
        base.ask("win(x)")
    assert caught.value.sentence == (
        "win(x) is undefined: it needs \\+ win(y), which needs \\+ win(x); that is a circle"
    )


def test_the_reason_of_what_is_undefined_prints_as_a_circle():
    assert str(KnowledgeBase.from_text(GAME).why("win(x)")).split("\n") == [
        "win(x)   [undefined]   [<text>:1]",
        "└─ \\+ win(y)   [undefined]   [<text>:1]",
        "   └─ \\+ win(x)   [undefined: back to win(x)]",
    ]


def test_true_answers_come_first_and_undefined_ones_are_never_passed_over():
    base = KnowledgeBase.from_text(GAME)
    answers = base.query("win(X)")
    assert next(answers) == {"X": "b"}
    with pytest.raises(Undefined, match=r"X = . and 1 more are undefined"):
        next(answers)
    assert list(base.query("win(X)", 1)) == [{"X": "b"}]
    assert sorted(answer["X"] for answer in base.query("win(X)", undefined=True)) == ["x", "y"]
    assert list(base.query("win(X), X = b")) == [{"X": "b"}]


def test_one_fact_settles_a_circle_and_taking_it_back_opens_it_again():
    base = KnowledgeBase.from_text(GAME)
    supposed = base.assume(("move", "x", "c"))
    assert (supposed.truth("win(c)"), supposed.truth("win(x)"), supposed.truth("win(y)")) == ("false", "true", "false")
    assert base.truth("win(x)") == "undefined"
    base.assert_("move(x, c)")
    assert base.truth("win(y)") == "false"
    base.retract("move(x, c)")
    assert base.truth("win(y)") == "undefined"


def test_what_is_undefined_can_be_mended():
    assert [str(repair) for repair in KnowledgeBase.from_text(GAME).repair("win(x)")] == ["remove move(y, x)"]


def test_a_circle_of_negation_is_a_note_of_check():
    assert [(f.severity.value, f.message) for f in check_text(GAME)] == [
        ("note", "negation runs in a circle: win/1 needs not win/1; what the facts do not settle is undefined")
    ]


def test_a_search_that_runs_out_is_a_fourth_case_and_not_undefined():
    base = KnowledgeBase.from_text("loop(X, _) :- loop(f(X), _). odd(a). p(X) :- odd(X), \\+ loop(X, X).")
    with pytest.raises(BudgetExceeded):
        base.truth("p(a)")


def test_a_long_chain_of_negations_is_settled_without_alternating_along_it():
    base = KnowledgeBase()
    base.rule("win(X) :- move(X, Y), \\+ win(Y)")
    base.facts("move", [(at, at + 1) for at in range(20_000)])
    assert base.ask(("win", 19_999)) and base.ask(("win", 1)) and not base.ask(("win", 0))


def test_a_long_circle_is_told_by_its_ends():
    base = KnowledgeBase()
    base.rule("win(X) :- move(X, Y), \\+ win(Y)")
    base.facts("move", [(at, (at + 1) % 300) for at in range(300)])
    doubt = base.why("win(0)")
    assert len(doubt.steps) == 300 and doubt.back == 0
    assert "\\+ win(4), which needs … 292 more …, which needs \\+ win(297)" in doubt.sentence


def test_an_only_undefined_answer_is_told_alone():
    base = KnowledgeBase.from_text("p(a) :- \\+ q. q :- \\+ p(a). p(b).")
    with pytest.raises(Undefined) as caught:
        list(base.query("p(X), X \\= b"))
    assert caught.value.sentence.startswith("X = a is undefined: ") and "more" not in caught.value.sentence
