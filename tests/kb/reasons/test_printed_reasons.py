"""Verdicts, proofs, refusals and repairs print themselves in the domain's words, and are told apart in one line."""

import pytest

from casper import KnowledgeBase
from casper.kb.reasons.proof import Proof
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound

HOME = KnowledgeBase.from_text(
    "human(ann). robot(tim). plate(p). cup('a:x:b'). food('[bold]').\n"
    "eat(A, T, D) :- human(A), food(T), plate(D).\n"
    "fill(A, C) :- human(A), cup(C).\n"
    "loop(X) :- loop(s(X)), Open = Open. loop(_) :- loop(_).\n"
    "never(\"the [red]cup is hot[/] :smile:\") :- claim(fill(_, C)), cup(C).\n"
)


def test_a_valid_statement_is_told_with_what_was_filled_in():
    assert str(HOME.verify("eat(ann, _, p)")) == "✔ eat(ann, _, p) is valid\n  so it is eat(ann, '[bold]', p)"


def test_a_valid_statement_without_gaps_is_one_line():
    assert str(HOME.verify("human(ann)")) == "✔ human(ann) is valid"


def test_a_statement_that_is_not_valid_is_told_with_every_reason():
    assert str(HOME.verify("eat(tim, '[bold]', p)")) == "✘ eat(tim, '[bold]', p) is not valid\n  because tim is not a human"


def test_an_unknown_statement_is_neither_ticked_nor_crossed_out():
    told = str(HOME.verify("loop(a)")).splitlines()
    assert told[0] == "? loop(a) is unknown"
    assert told[1].startswith("  because ")


def test_codes_of_markup_and_emoji_in_atoms_and_sentences_are_printed_as_they_are():
    told = str(HOME.verify("fill(ann, 'a:x:b')"))
    assert told == "✘ fill(ann, 'a:x:b') is not valid\n  because the [red]cup is hot[/] :smile:"


def test_a_proof_is_printed_as_a_tree():
    assert str(HOME.why("fill(ann, 'a:x:b')")).splitlines() == [
        "fill(ann, 'a:x:b')   [<text>:3]",
        "├─ human(ann)   [given]   [<text>:1]",
        "└─ cup('a:x:b')   [given]   [<text>:1]",
    ]


@pytest.mark.parametrize(
    ("thing", "shown"),
    [
        (HOME.verify("eat(ann, _, p)"), "<Verdict: eat(ann, _, p) is valid>"),
        (HOME.verify("eat(tim, _, p)"), "<Verdict: eat(tim, _, p) is not valid>"),
        (HOME.verify("loop(a)"), "<Verdict: loop(a) is unknown>"),
        (HOME.why_not("human(tim)"), "<Refusal of human(tim): no fact or rule gives human(tim)>"),
        (HOME.repair("human(tim)"), "[<Repair: add human(tim)>]"),
    ],
    ids=lambda thing: thing if isinstance(thing, str) else "",
)
def test_the_repr_is_one_line_that_says_what_it_is(thing, shown):
    assert repr(thing) == shown


def test_the_repr_of_a_proof_deeper_than_pythons_stack_is_one_line_with_what_is_proved():
    proof = Proof(Literal(Compound(("far", 0))))
    for at in range(1, 2000):
        proof = Proof(Literal(Compound(("far", at))), premises=(proof,))
    assert "far(1999)" in repr(proof)
    assert len(repr(proof)) < 200 and len(repr(proof).splitlines()) == 1
