"""How terms are written: brackets where the priorities ask for them, quotes where the syntax does, and no others."""

import pytest

from casper.kb.terms.syntax import atom_text, term_text
from casper.kb.terms.terms import Compound, Variable, make_list
from casper.kb.text.reader import read_query, read_statement, read_text
from casper.kb.text.writer import program_text

WRITTEN = [
    "p(a + b - c)",
    "p(a - b + c)",
    "p(a - (b + c))",
    "p(a + (b - c))",
    "p(a * b / c)",
    "p(a / b * c)",
    "p(a / (b * c))",
    "p(a + b * c)",
    "p((a + b) * c)",
    "p(a: b: c)",
    "p((a: b): c)",
    "p(a: b + c)",
    "p(a: b * c)",
    "p((a = b): c)",
    "p(a * b: c)",
    "p(X < Y)",
    "p(X + 1 < Y * 2)",
    "p((X < Y) + 1)",
    "p([a, b | T])",
    "p([X < Y])",
    "p('it''s')",
    'p("a sentence")',
    "p(is)",
    "p('is' = a)",
    "p([])",
    "p(-1)",
]


@pytest.mark.parametrize("text", WRITTEN)
def test_a_term_is_written_with_the_brackets_it_needs_and_no_others(text):
    assert term_text(read_statement(text)) == text


@pytest.mark.parametrize(
    "text",
    [
        "p :- X is 1 + 2, X < 3, \\+ q(X), \\+ X = 1.\n",
        "g --> a, (b ; c), optional((d, e)).\n",
        "g --> a, b ; c.\n",
        "g --> steps([x: a, y: (b, c)], [x < y]).\n",
        ":- dynamic(p / 2).\n",
        "p(a).\n",
    ],
)
def test_a_sentence_is_written_as_it_was_read(text):
    assert program_text(read_text(text)) == text


@pytest.mark.parametrize(
    ("term", "limit", "text"),
    [
        (Compound(("<", "a", "b")), 700, "a < b"),
        (Compound(("<", "a", "b")), 699, "(a < b)"),
        (Compound(("+", "a", "b")), 500, "a + b"),
        (Compound(("+", "a", "b")), 499, "(a + b)"),
        (Compound(("-", "a", "b")), 500, "a - b"),
        (Compound(("-", "a", "b")), 499, "(a - b)"),
        (Compound(("*", "a", "b")), 400, "a * b"),
        (Compound(("*", "a", "b")), 399, "(a * b)"),
        (Compound(("/", "a", "b")), 400, "a / b"),
        (Compound(("/", "a", "b")), 399, "(a / b)"),
        (Compound((":", "a", "b")), 600, "a: b"),
        (Compound((":", "a", "b")), 599, "(a: b)"),
        (Compound((",", "a", "b")), 1000, "a, b"),
        (Compound((",", "a", "b")), 999, "(a, b)"),
        (Compound((";", "a", "b")), 1100, "a ; b"),
        (Compound((";", "a", "b")), 1099, "(a ; b)"),
        (Compound(("\\+", "a")), 900, "\\+ a"),
        (Compound(("\\+", "a")), 899, "(\\+ a)"),
    ],
)
def test_an_operator_stands_without_brackets_up_to_its_priority(term, limit, text):
    assert term_text(term, limit) == text


@pytest.mark.parametrize(
    ("term", "text"),
    [
        (Compound(("*", "a")), "'*'(a)"),
        (Compound(("+", "a")), "+ a"),
        (Compound(("+", "a", "b", "c")), "'+'(a, b, c)"),
        (Compound((",", "a")), "','(a)"),
        (Compound((".", "a")), "'.'(a)"),
        (Compound(("rain",)), "rain"),
        (Compound((",", Compound((",", "a", "b")), "c")), "(a, b), c"),
        (Compound((";", Compound((",", "a", "b")), "c")), "a, b ; c"),
        (Compound(("<", Compound(("<", "a", "b")), "c")), "(a < b) < c"),
        (make_list(["a", Compound((",", "b", "c"))]), "[a, (b, c)]"),
        (make_list(["a"], Variable("T")), "[a | T]"),
    ],
)
def test_a_functor_is_an_operator_at_its_own_arity_only(term, text):
    assert term_text(term, 1200) == text


@pytest.mark.parametrize(
    ("atom", "text"),
    [
        ("plate", "plate"),
        ("sink_2", "sink_2"),
        ("is", "is"),
        ("éclair", "éclair"),
        ("Ünal", "'Ünal'"),
        ("[]", "[]"),
        ("Big", "'Big'"),
        ("a b", '"a b"'),
        ('say "a"', '"say ""a"""'),
        ("it's", "'it''s'"),
        ("a\nb", "'a\\nb'"),
        ("a\\b", "'a\\\\b'"),
        ("", "''"),
    ],
)
def test_an_atom_is_quoted_where_the_syntax_needs_it(atom, text):
    assert atom_text(atom) == text


def test_a_variable_is_written_by_its_authors_name_and_tells_its_copies_apart():
    assert str(Variable("X")) == "X"
    assert str(Variable("X", 3)) == "X_3"
    assert str(Variable("_#1")) == "_"


def test_a_condition_reads_as_what_it_was():
    ((literal,),) = read_query("\\+ X = sink")
    assert literal.negated and literal.is_comparison
    ((plain,),) = read_query("p(X)")
    assert not plain.negated and not plain.is_comparison
