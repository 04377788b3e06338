"""The asserts pass where they should, and fail with what one wants to see."""

import pytest

from casper.engine.domain.domain import Domain
from casper.kb.base import KnowledgeBase
from casper.testing import assert_explains, assert_recognises, assert_rejected, assert_same_answers, assert_valid

KITCHEN = Domain.load("kitchen")
LUNCH = ["pick_and_place(meal, hobs)", "cook(meal, hobs)"]


def told(check, *arguments, **named) -> str:
    with pytest.raises(AssertionError) as failed:
        check(*arguments, **named)
    return str(failed.value)


def test_what_is_valid_passes_and_is_filled_in() -> None:
    verdict = assert_valid(KITCHEN, "wash(tiago, plate, _)")
    assert repr(verdict.completed) == "wash(tiago, plate, sink)"
    assert_valid(KITCHEN.kb, "eat(human, meal, plate)")


def test_what_is_not_valid_fails_with_the_reasons_and_what_would_mend_it() -> None:
    text = told(assert_valid, KITCHEN, "eat(tiago, meal, plate)")
    assert "tiago is not a human" in text and "it would be: " in text


def test_what_is_rejected_for_the_reason_passes() -> None:
    assert_rejected(KITCHEN, "eat(tiago, meal, plate)")
    assert_rejected(KITCHEN, "eat(tiago, meal, plate)", because="not a human")


def test_what_is_not_rejected_fails_with_its_proof() -> None:
    assert "eat(human, meal, plate)" in told(assert_rejected, KITCHEN, "eat(human, meal, plate)").split("its proof:")[1]
    assert "no reason says 'hunger'" in told(assert_rejected, KITCHEN, "eat(tiago, meal, plate)", because="hunger")


def test_what_is_undefined_is_neither_valid_nor_rejected() -> None:
    base = KnowledgeBase.from_text("move(a, a). win(X) :- move(X, Y), \\+ win(Y).")
    base.declare_statements([("win", 1)])
    assert "undefined" in told(assert_valid, base, "win(a)") + told(assert_rejected, base, "win(a)")


def test_what_has_an_explanation_passes_with_the_best() -> None:
    assert assert_explains(KITCHEN, LUNCH).goal == "lunch"
    assert assert_explains(KITCHEN.reading(verification=False), ["pick_and_place"], "drink").goal == "drink"


def test_what_has_no_explanation_fails_with_the_action_and_the_reasons() -> None:
    text = told(assert_explains, KITCHEN, [*LUNCH, "sip(bottle, glass)"])
    assert text.startswith("sip(bottle, glass), action 3, has no explanation") and "not lunch: " in text
    assert "the best explanation is" in told(assert_explains, KITCHEN, LUNCH, "drink")
    assert "there are breakfast, drink, lunch" in told(assert_explains, KITCHEN, LUNCH, "dinner")


def test_a_reading_that_is_handed_over_stays_as_it_is() -> None:
    reading = KITCHEN.reading()
    assert_explains(reading, LUNCH)
    assert reading.observations == ()


def test_what_is_recognised_in_time_passes() -> None:
    assert assert_recognises(KITCHEN, LUNCH, "lunch", by=1).outcome == "lunch"


def test_what_is_not_recognised_fails_with_the_reading() -> None:
    text = told(assert_recognises, KITCHEN.reading(verification=False), ["pick_and_place"], "lunch")
    assert text.startswith("after 1 of 1 actions the goal is") and "breakfast" in text
    assert "too few" in told(assert_recognises, KITCHEN, [], "lunch")
    assert "too few" in told(assert_recognises, KITCHEN, LUNCH, "lunch", by=3)


def test_the_same_answers_pass_in_another_base_by_another_query_and_as_listed() -> None:
    base = KnowledgeBase.from_text("p(1). p(2). q(X) :- p(X).")
    assert_same_answers(base, "p(X)", "q(X)")
    assert_same_answers(base, "p(X)", KnowledgeBase.from_text("p(2). p(1)."))
    assert_same_answers(base, "p(X)", [{"X": 2}, {"X": 1}])


def test_other_answers_fail_and_are_listed_by_side() -> None:
    base = KnowledgeBase.from_text("p(1). p(2). q(2). q(3).")
    text = told(assert_same_answers, base, "p(X)", "q(X)")
    assert "only here: X = 1" in text and "only there: X = 3" in text
    many = KnowledgeBase.from_text(" ".join(f"p({n})." for n in range(20)))
    assert "… and 10 more" in told(assert_same_answers, many, "p(X)", [])
