"""What is not of the language is told in one sentence with its place."""

import pytest

from casper.kb.errors import DomainError, ReadError
from casper.kb.text.reader import read_file, read_statement, read_text


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
        ("p(a = b = c).", 1, 9, "'=' does not belong here: the operator before it binds no tighter"),
        ("p :- (q -> r ; a + b).", 1, 16, "a + b cannot stand here"),
        ("p :- \\+ (q, X).", 1, 13, "X cannot stand here"),
        ("p :- a =.. b.", 1, 6, "a =.. b cannot stand here"),
        ("p :- {a}.", 1, 6, "{a} cannot stand here"),
        ("p :- (a :- b).", 1, 7, "(a :- b) cannot stand here"),
        ("p :- \\+ X.", 1, 9, "X cannot stand here"),
        ("?- p.", 1, 4, "'p' does not belong here"),
        ("p('a\\qb').", 1, 5, "\\q stands for nothing"),
        ("p(a, '\\x110000\\').", 1, 7, "there is no such character"),
        ("p(a, '\\uD800').", 1, 7, "there is no such character"),
        ("p(1r3).", 1, 3, "there are no fractions here"),
        ("p(1.5NaN).", 1, 3, "this is no finite number"),
        ("p(1.0Inf).", 1, 3, "this is no finite number"),
        ("p(7'8).", 1, 3, "8 is no number of radix 7"),
        ("p().", 1, 3, "')' does not belong here; expected a name or a variable or '('"),
        ("p(X.y).", 1, 4, "'.' does not belong here"),
        ("p(X(a)).", 1, 4, "'(' does not belong here"),
        ("p(`a).", 1, 3, "this quote is never closed on its line"),
        ("p (a).", 1, 3, "'(' does not belong here; expected a full stop"),
        ("p :- q r.", 1, 8, "'r' does not belong here; expected a full stop or ','"),
        ("p(a\u200b).", 1, 4, "'\\u200b' does not belong here"),
    ],
)
def test_a_mistake_is_told_with_its_place_and_a_caret(text, line, column, sentence):
    with pytest.raises(ReadError) as caught:
        read_text(text, "home.pl")
    mistake = caught.value
    assert mistake.sentence.startswith(sentence)
    assert (mistake.place.file, mistake.place.line, mistake.place.column) == ("home.pl", line, column)
    shown, caret = mistake.excerpt.split("\n")
    assert shown == "    " + text.split("\n")[line - 1].replace("\u200b", " ")
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


def test_a_full_stop_without_a_space_behind_it_is_told_as_what_it_is():
    with pytest.raises(ReadError, match=r"'\.' does not belong here; expected a space or a new line after a full stop"):
        read_text("p(0).p(1).")
