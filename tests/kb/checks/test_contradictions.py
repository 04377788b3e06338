"""Bodies that can never hold, against all the values there are; clauses that say the same."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.checks.bodies import contradictions, duplicates
from casper.kb.terms.clauses import Clause
from casper.kb.text.reader import read_text

HOLDS = {
    "<": lambda x, y: x < y,
    ">": lambda x, y: x > y,
    "=<": lambda x, y: x <= y,
    ">=": lambda x, y: x >= y,
}
MIRRORED = {"<": ">", ">": "<", "=<": ">=", ">=": "=<"}
signs = st.sampled_from(list(HOLDS))


def told(text):
    return [finding.message for s in read_text(text) if isinstance(s, Clause) for finding in contradictions(s)]


@given(signs, st.integers(0, 3), signs, st.integers(0, 3), st.booleans())
def test_two_bounds_exclude_each_other_when_no_number_keeps_both(one, low, two, high, turned):
    second = f"{high} {MIRRORED[two]} X" if turned else f"X {two} {high}"
    possible = any(HOLDS[one](x / 2, low) and HOLDS[two](x / 2, high) for x in range(-2, 9))
    assert bool(told(f"p(X) :- q(X), X {one} {low}, {second}.")) is not possible


@given(signs, signs, st.booleans())
def test_two_comparisons_of_two_unknowns_exclude_each_other_when_no_numbers_keep_both(one, two, turned):
    second = f"Y {MIRRORED[two]} X" if turned else f"X {two} Y"
    possible = any(HOLDS[one](x, y) and HOLDS[two](x, y) for x in range(3) for y in range(3))
    assert bool(told(f"p(X) :- q(X, Y), X {one} Y, {second}.")) is not possible


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ("q(X), X \\= X", "X \\= X can never hold; the rule gives nothing"),
        ("q(X), X = a, X = b", "X = a and X = b can never hold together; the rule gives nothing"),
        ("q(X), X = a, X \\= a", "X = a and X \\= a can never hold together; the rule gives nothing"),
        ("q(X), Y = 1, X = a, X = b", "X = a and X = b can never hold together; the rule gives nothing"),
        ("q(X), \\+ q(X)", "q(X) and \\+ q(X) can never hold together; the rule gives nothing"),
        ("q(X), X < 1, X > 2", "X < 1 and X > 2 can never hold together; the rule gives nothing"),
        ("q(X), 2 < 1", "2 < 1 can never hold; the rule gives nothing"),
        ("q(X), a == b", "a == b can never hold; the rule gives nothing"),
    ],
)
def test_a_contradiction_is_told_with_the_conditions_it_is_between(body, sentence):
    assert told(f"p(X) :- {body}.") == [sentence]


@pytest.mark.parametrize(
    "body",
    [
        "q(X), X = X", "q(X), X == X", "q(X), X =< X", "q(X), X >= X", "q(X), \\+ X < X", "q(X), \\+ q(b)", "q(_), \\+ q(_)",
        "q(X), \\+ X = a, X = b", "q(X), q(Y), X < 1, Y > 2", "q(X), X < 1, X \\= 3", "q(X), X < a, X > b", "q(X), \\+ X < 1, X > 2",
    ],
)  # fmt: skip
def test_what_some_values_keep_is_no_contradiction(body):
    assert told(f"p(X) :- {body}.") == []


def test_a_constraint_that_can_never_be_broken_is_told():
    assert told('never("x") :- q(X), X < 1, X > 2.') == ["X < 1 and X > 2 can never hold together; the constraint can never be broken"]


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("p(X) :- q(X).\np(Y) :- q(Y).", [2]),
        ("p(X, Y) :- q(X, Y).\np(X, Y) :- q(Y, X).", []),
        ("p(X) :- q(X).\np(X) :- \\+ q(X).", []),
        ("p --> q.\np --> q.\np :- q.", [2]),
        ("p(a).\np(b).\np(a).", [3]),
        (":- dynamic(p/1).\n:- dynamic(p/1).", []),
        ("p :- q ; q.", []),
    ],
)
def test_what_was_said_before_is_told_with_its_line(text, lines):
    found = list(duplicates(read_text(text)))
    assert [finding.place.line for finding in found] == lines
    assert all(finding.message.startswith("this says the same as line 1;") for finding in found)


def test_what_another_file_says_is_told_with_its_file():
    sentences = [*read_text("p(a).", "home/first.pl"), *read_text("\np(a).", "home/second.pl")]
    (finding,) = duplicates(sentences)
    assert finding.message == "this says the same as first.pl:1; take one of them out"
