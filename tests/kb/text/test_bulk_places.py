"""Where the plain sentences of large texts stand."""

import pytest

from casper.kb.text.bulk.reader import read_large


def refuse(text):
    raise AssertionError(f"the grammar was asked to read {text!r}")


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("\np(a).", [(2, 1)]),
        ("p(a). q(b).\n  r(c).", [(1, 1), (1, 7), (2, 3)]),
        ("\n\n% a note\n p(a).\n\nq(b).", [(4, 2), (6, 1)]),
    ],
)
def test_a_plain_sentence_stands_at_its_line_and_column(text, places):
    found = read_large(text, "f.pl", refuse)
    assert [(s.place.file, s.place.line, s.place.column) for s in found] == [("f.pl", *place) for place in places]


def test_each_condition_of_a_rule_stands_at_its_own():
    (rule,) = read_large("\np(X) :- q(X),\n  r(X), s.", "f.pl", refuse)
    assert [(x.place.line, x.place.column) for x in rule.body] == [(2, 9), (3, 3), (3, 9)]
