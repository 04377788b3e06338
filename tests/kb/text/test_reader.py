"""The language: every form of it, and one sentence with a place for what is not of it."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.lark import from_lark
from programs import texts

from casper.kb.errors import DomainError, ReadError
from casper.kb.terms.clauses import Clause, Directive, Literal, Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, make_list
from casper.kb.text.reader import _parser, read_file, read_query, read_statement, read_text
from casper.kb.text.writer import program_text

X, Y = Variable("X"), Variable("Y")


def argument(text):
    """The term that the text stands for."""
    (fact,) = read_text(f"p({text}).")
    return fact.head[1]


@pytest.mark.parametrize(
    ("text", "term"),
    [
        ("a", "a"),
        ("sink_2B", "sink_2B"),
        ("'Big Name'", "Big Name"),
        ("'it''s'", "it's"),
        (r"'it\'s'", "it's"),
        (r"'a\nb\tc\\d'", "a\nb\tc\\d"),
        ('"a sentence."', "a sentence."),
        ('"say ""no"""', 'say "no"'),
        ("'50% off'", "50% off"),
        ("''", ""),
        ("[]", "[]"),
        ("[ ]", "[]"),
        ("12", 12),
        ("-12", -12),
        ("2.5", 2.5),
        ("-2.5e-3", -0.0025),
        ("1E3", 1000.0),
        ("X", X),
        ("Y", Y),
        ("f(a, X)", Compound(("f", "a", X))),
        ("'F'(a)", Compound(("F", "a"))),
        ("[a, X]", make_list(["a", X])),
        ("[a | X]", make_list(["a"], X)),
        ("[a, b | [c]]", make_list(["a", "b", "c"])),
        ("1 + 2 * 3", Compound(("+", 1, Compound(("*", 2, 3))))),
        ("1 - 2 - 3", Compound(("-", Compound(("-", 1, 2)), 3))),
        ("1 - (2 - 3)", Compound(("-", 1, Compound(("-", 2, 3))))),
        ("2-1", Compound(("-", 2, 1))),
        ("2 - -1", Compound(("-", 2, -1))),
        ("a: b: c", Compound((":", "a", Compound((":", "b", "c"))))),
        ("a < b", Compound(("<", "a", "b"))),
        ("X is 1", Compound(("is", X, 1))),
        ("(a, b, c)", Compound((",", "a", "b", "c"))),
        ("(a ; b)", Compound((";", "a", "b"))),
        ("\\+ a", Compound(("\\+", "a"))),
        ("((a))", "a"),
    ],
)
def test_a_term_reads_as_what_it_says(text, term):
    assert argument(text) == term
    assert type(argument(text)) is type(term)


def test_each_anonymous_variable_is_one_of_its_own():
    (fact,) = read_text("p(_, _, _X, _X).")
    assert len(set(fact.head.args)) == 3


def test_a_fact_is_a_clause_without_a_body():
    assert read_text("rain.") == [Clause(Compound(("rain",)))]


def test_a_rule_keeps_its_conditions_in_order():
    (rule,) = read_text("p(X) :- q(X), \\+ r(X), X \\= a.")
    q, r, test = (Compound(("q", X)), Compound(("r", X)), Compound(("\\=", X, "a")))
    assert rule == Clause(Compound(("p", X)), (Literal(q), Literal(r, True), Literal(test)))


def test_alternatives_in_a_body_are_several_clauses():
    assert read_text("p :- a, (b ; c).") == read_text("p :- a, b. p :- a, c.")


def test_brackets_around_a_whole_body_say_nothing():
    assert read_text("p :- ((a, (b))).") == read_text("p :- a, b.")


def test_a_double_negation_is_none():
    assert read_text("p :- \\+ \\+ a.") == read_text("p :- a.")


def test_a_grammar_clause_is_a_production():
    assert read_text("tea --> boil, pour.") == [Production(Compound(("tea",)), Compound((",", "boil", "pour")))]


def test_a_line_that_starts_with_an_arrow_is_a_directive():
    assert read_text(":- dynamic(p/1).") == [Directive(Compound(("dynamic", Compound(("/", "p", 1)))))]


def test_comments_are_no_part_of_the_text():
    assert read_text("% one\na. /* two\n lines */ b.% three") == read_text("a. b.")


def test_a_clause_knows_its_file_line_and_column():
    _, rule = read_text("a.\n  b :- a.", "home.pl")
    assert str(rule.place) == "home.pl:2:3"
    assert str(rule.body[0].place) == "home.pl:2:8"


def test_equal_clauses_are_equal_wherever_they_stand():
    assert read_text("\n\n p(_) :- q(_, X), r(X).") == read_text("p(_) :- q(_, X), r(X).")


def test_a_query_has_alternatives_of_conditions():
    assert read_query("a, \\+ b ; c") == (
        (Literal(Compound(("a",))), Literal(Compound(("b",)), True)),
        (Literal(Compound(("c",))),),
    )


@pytest.mark.parametrize("text", ["eat(X, _)", "eat(X, _).", " ( eat(X, _) ) "])
def test_a_statement_is_one_atom_with_or_without_its_full_stop(text):
    assert term_text(read_statement(text)) == "eat(X, _)"


@pytest.mark.parametrize(
    ("text", "line", "column", "sentence"),
    [
        ("human(ann)", 1, 11, "the text ends here, in the middle of a clause; expected a full stop"),
        ("human(ann).\nhuman(bob)\n\n", 2, 11, "the text ends here"),
        ("human(ann)\nhuman(bob).", 2, 1, "'human' does not belong here; expected a full stop"),
        ("human(ann.", 1, 10, "'.' does not belong here; expected ')' or ','"),
        ("human(ann)).", 1, 11, "')' does not belong here; expected a full stop"),
        ("p([a, b).", 1, 8, "')' does not belong here; expected ']'"),
        ("p(a,).", 1, 5, "')' does not belong here"),
        ("p(a) :- .", 1, 9, "'.' does not belong here"),
        ("ok.\n  human('ann).", 2, 9, "this quote is never closed on its line"),
        ('never("no :- p.', 1, 7, "this quote is never closed on its line"),
        ("a. /* never ends", 1, 4, "this comment is never closed"),
        ("p :- q & r.", 1, 8, "'&' does not belong here"),
        ("p.\nX :- p.", 2, 1, "X cannot stand here: a name or name(arguments) is needed"),
        ("3.", 1, 1, "3 cannot stand here"),
        ("[a].", 1, 1, "[a] cannot stand here"),
        ("a = b.", 1, 1, "a = b cannot stand here"),
        ("(a, b) :- c.", 1, 2, "(a, b) cannot stand here"),
        ("(\\+ a) :- b.", 1, 2, "\\+ a cannot stand here"),
        ("X --> a.", 1, 1, "X cannot stand here"),
        ("p :- q, X.", 1, 9, "X cannot stand here"),
        ("p :- a + b.", 1, 6, "a + b cannot stand here"),
        ("p(1e999).", 1, 3, "this number is too large"),
        (f"p({'9' * 5000}).", 1, 3, "this number is too large"),
        ("p(a:-b).", 1, 4, "':-' does not belong here"),
    ],
)
def test_a_mistake_is_told_with_its_place_and_a_caret(text, line, column, sentence):
    with pytest.raises(ReadError) as caught:
        read_text(text, "home.pl")
    mistake = caught.value
    assert mistake.sentence.startswith(sentence)
    assert (mistake.place.file, mistake.place.line, mistake.place.column) == ("home.pl", line, column)
    shown, caret = mistake.excerpt.split("\n")
    assert shown == "    " + text.split("\n")[line - 1]
    assert caret.index("^") == 4 + column - 1


def test_odd_line_breaks_in_a_quote_do_not_shift_the_excerpt():
    with pytest.raises(ReadError) as caught:
        read_text("p('a\x0b\u2028b').\nq(,).")
    assert "q(,)." in caught.value.excerpt


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a, b", "one statement is needed here, not several"),
        ("a ; b", "one statement is needed here, not several"),
        ("\\+ a", "a plain statement is needed here"),
        ("X = a", "a plain statement is needed here"),
        ("", "the text ends here"),
        ("a. b.", "'b' does not belong here"),
        ("X", "X cannot stand here"),
    ],
)
def test_what_is_no_single_statement_is_refused(text, sentence):
    with pytest.raises(ReadError, match=sentence):
        read_statement(text)


@pytest.mark.parametrize("text", ["p(" + "f(" * 5000 + "a" + ")" * 5000 + ").", "p :- " + "(" * 5000 + "a" + ")" * 5000 + "."])
def test_text_nested_too_deeply_is_refused_in_words(text):
    with pytest.raises(ReadError, match="nested too deeply"):
        read_text(text)


def test_a_statement_nested_too_deeply_is_refused_in_words():
    with pytest.raises(ReadError, match="nested too deeply"):
        read_statement("f(" * 5000 + "a" + ")" * 5000)


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(DomainError, match=r"cannot read .*ontology\.pl"):
        read_file(tmp_path / "ontology.pl")


def test_a_file_that_is_no_text_is_named(tmp_path):
    (tmp_path / "x.pl").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(DomainError, match=r"cannot read .*x\.pl"):
        read_file(tmp_path / "x.pl")


# END and MINUS end in a look-ahead, which a terminal on its own can never satisfy; sentences are put together below.
_bodies = from_lark(
    _parser(), start="query", explicit={"END": st.just(""), "MINUS": st.just("-")}, alphabet=st.characters(codec="ascii")
)


@settings(max_examples=settings.default.max_examples // 16, suppress_health_check=list(HealthCheck))  # slow to draw
@given(_bodies)
def test_whatever_the_grammar_can_spell_is_read_or_refused_in_words(body):
    for text in (f"p :- {body}\n.", f"p --> {body}\n.", f":- {body}\n.", f"p(({body}\n))."):
        try:
            sentences = read_text(text)
        except ReadError:
            continue
        assert read_text(program_text(sentences)) == sentences


@given(st.text(st.sampled_from(list("pXq_0('\"[]),.;|\\+-:=<> %/*\n!é")), max_size=30))
def test_any_text_is_read_or_refused_in_words(text):
    try:
        sentences = read_text(text)
    except ReadError as mistake:
        assert mistake.place.line >= 1 and mistake.place.column >= 1
        return
    assert read_text(program_text(sentences)) == sentences


@given(texts)
def test_what_is_printed_reads_in_again_as_the_same(text):
    try:
        sentences = read_text(text)
    except ReadError:  # a body may hold what is no condition
        return
    printed = program_text(sentences)
    assert read_text(printed) == sentences
    assert program_text(read_text(printed)) == printed
