"""``casper check`` on sentences of authors."""

import pytest

from casper.kb.checks.check import check_text

HOME = 'person(ann). eat(A, T) :- person(A), food(T). food(jam). never("no jam") :- claim(eat(_, T)), T = salt. '


def found(text):
    return [(str(f.severity), f.message) for f in check_text(HOME + text)]


@pytest.mark.parametrize(
    ("text", "severity", "message"),
    [
        ('say(eat(A, _), "{B} eats").', "error", "the sentence has {B}, which does not occur in eat(A, _); it has {A}"),
        ('say(eat(Who, _), "{Whom} eats").', "error", "the sentence has {Whom}, which does not occur in eat(Who, _); did you mean {Who}?"),
        ('say(ann, "{X}").', "error", "the sentence has {X}, which does not occur in ann; it has no variables (write {{ and }} for brackets)"),
        ('say(person(X), "{X}") :- food(X).', "error", "a sentence has no conditions; end it with a full stop behind say(…)"),
        ('say(3, "three").', "error", '3 is nothing that can be worded: write say(eat(A, T, D), "{A} eats {T}") or say(fr, eat(A, T, D), "…")'),
        ('say(7, ann, "Ann").', "error", '7 is no language, such as fr: write say(eat(A, T, D), "{A} eats {T}") or say(fr, eat(A, T, D), "…")'),
        ('say(persn(X), "{X}").', "warning", "this sentence is never told: nothing defines persn/1; did you mean person?"),
        ('say(eat(X), "{X}").', "warning", "this sentence is never told: eat takes 2 arguments, not 1"),
        ('say(an, "Ann").', "warning", "nothing here is called an: its sentence is never told; did you mean ann?"),
        ('say(never("no jm"), "nope").', "warning", 'no constraint has this sentence, so nothing is ever told so; did you mean "no jam"?'),
        ('say(eat(A, T), "{A}, {T}"). say(eat(A, jam), "{A}").', "warning", "this sentence is never told: line 1 has one for eat(A, T) already"),
        ('say(eat(A, T), "{A}").', "warning", "T stands only once here; write _ or _T if it is meant to be anything"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_sentence_is_found(text, severity, message):
    assert (severity, message) in found(text)


@pytest.mark.parametrize(
    "text",
    [
        'say(eat(A, T), "{A} eats {T}").',
        r'say(\+ eat(A, _), "{A} cannot eat"). say(fr, eat(A, _), "{A} mange"). say(eat(_, T), "{T}").',
        'say(eat(ann, T), "Ann eats {T}"). say(eat(A, T), "{A} eats {T}").',
        'say(ann, "Ann"). say(salt, "salt"). say(never("no jam"), "none"). say(person(X), "{X}").',
        r'say(\+ eat(A, T), "{A} {T}"). say(\+ eat(_, _), "nobody eats").',
        'say(X, Y) :- person(X), food(Y).',
    ],
)  # fmt: skip
def test_nothing_is_wrong_with_sentences_of_what_there_is(text):
    assert found(text) == []


def test_goals_tasks_and_steps_of_plans_can_be_worded():
    text = 'lunch(F) --> warm(F), eat(F). say(lunch(_), "lunch"). say(warm(F), "{F}"). say(eat(F), "{F}").'
    assert not [message for _, message in found(text) if "told" in message]
