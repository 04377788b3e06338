"""Operators that a text declares: for itself and what it includes, from the line on; mistakes have a place."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.checks.check import check_text
from casper.kb.errors import ReadError
from casper.kb.terms.clauses import Clause, Directive
from casper.kb.terms.operators import STANDARD
from casper.kb.terms.terms import Compound
from casper.kb.text import reader
from casper.kb.text.reader import read_text
from casper.kb.text.recovery import read_tolerantly
from casper.kb.text.sources import Sources

LIKES = ":- op(700, xfx, likes).\n"


def heads(sentences):
    return [s.head for s in sentences if isinstance(s, Clause)]


def test_a_declared_operator_makes_statements():
    assert read_text(LIKES + "ann likes tea. p(X) :- X likes tea, \\+ bob likes X.") == read_text(
        "likes(ann, tea). p(X) :- likes(X, tea), \\+ likes(bob, X)."
    )


def test_a_base_with_an_operator_answers_and_prints_what_reads_in_again():
    kb = KnowledgeBase.from_text(LIKES + "ann likes tea. happy(X) :- X likes tea.")
    assert kb.ask("happy(ann)")
    assert KnowledgeBase.from_text(kb.to_text()).clauses == kb.clauses


@pytest.mark.parametrize(
    ("declared", "text", "term"),
    [
        ("op(200, xfy, to)", "a to b to c", Compound(("to", "a", Compound(("to", "b", "c"))))),
        ("op(200, yfx, to)", "a to b to c", Compound(("to", Compound(("to", "a", "b")), "c"))),
        ("op(300, fy, [not, all])", "not all a", Compound(("not", Compound(("all", "a"))))),
        ("op(300, xf, ++)", "a ++", Compound(("++", "a"))),
        ("op(300, yf, ++)", "a ++ ++", Compound(("++", Compound(("++", "a"))))),
        ("op(700, xfx, ===>)", "a + b ===> c", Compound(("===>", Compound(("+", "a", "b")), "c"))),
        ("op(400, xfx, 'Big')", "a + 'Big'(b, c)", Compound(("+", "a", Compound(("Big", "b", "c"))))),
        ("op(0, xfx, is)", "f(is, a)", Compound(("f", "is", "a"))),
    ],
)
def test_every_type_of_operator_reads_as_declared(declared, text, term):
    (fact,) = read_text(f":- {declared}. p({text}).")
    assert fact.head[1] == term


def test_an_operator_that_was_taken_away_is_none_any_more():
    with pytest.raises(ReadError, match=r"1:30: 'is' does not belong here"):
        read_text(":- op(0, xfx, is). p(X) :- X is 1.")


def test_it_is_in_force_from_its_line_on_and_in_its_text_only():
    with pytest.raises(ReadError, match=r"1:5: 'likes' does not belong here"):
        read_text("ann likes tea. " + LIKES)
    read_text(LIKES)
    assert "likes" not in STANDARD
    with pytest.raises(ReadError):
        read_text("ann likes tea.")


def test_a_large_text_reads_with_its_operators():
    rows = "".join(f"p(a{at}).\nann likes a{at}.\n" for at in range(2000))
    assert len(LIKES + rows) > reader.LARGE
    assert heads(read_text(LIKES + rows))[-2:] == [Compound(("p", "a1999")), Compound(("likes", "ann", "a1999"))]
    with pytest.raises(ReadError, match=r"^<text>:2:5: 'likes' does not belong here"):
        read_text(rows + LIKES)


@pytest.mark.parametrize(
    ("directive", "sentence"),
    [
        ("op(1201, xfx, foo)", "an operator's priority is a whole number from 0 to 1200, not 1201"),
        ("op(-1, xfx, foo)", "an operator's priority is a whole number from 0 to 1200, not -1"),
        ("op(a, xfx, foo)", "an operator's priority is a whole number from 0 to 1200, not a"),
        ("op(700, xxx, foo)", "an operator's type is one of xfx, xfy, yfx, fy, fx, xf, yf, not xxx"),
        ("op(700, xfx, f(a))", "f(a) is no name"),
        ("op(700, xfx, [a, X])", "X is no name"),
        ("op(700, xfx, ',')", ", is part of the language"),
        ("op(1100, xfy, '|')", "| is part of the language"),
        ("op(700, xfx, :-)", ":- is part of the language"),
        ("op(700, xfx, [])", "[] is part of the language"),
        ("op(300, xf, +)", "+ clashes with itself"),
    ],
)
def test_a_declaration_that_makes_no_sense_is_refused_with_its_place(directive, sentence):
    with pytest.raises(ReadError) as told:
        read_text(f"a.\n:- {directive}.", "ops.pl")
    assert told.value.sentence.startswith(sentence)
    assert str(told.value.place) == "ops.pl:2:1"


@pytest.mark.parametrize("text", ["p(a = b = c).", "p(- a : - b :- c).", "p(2 ** 3 ** 4).", "p :- a < b < c."])
def test_operators_that_clash_are_told_with_their_place(text):
    with pytest.raises(ReadError, match="does not belong here") as told:
        read_text(text)
    assert told.value.place.column > 5


def test_a_clash_says_what_to_do():
    with pytest.raises(ReadError, match="put one of the two in brackets"):
        read_text("p(a = b = c).")


def test_check_reads_on_with_the_operators_after_a_mistake():
    read = read_tolerantly(LIKES + "ann likes tea.\np(a b).\nbob likes tea.\n")
    assert [str(m.place) for m in read.mistakes] == ["<text>:3:5"]
    assert heads(read.sentences) == [Compound(("likes", "ann", "tea")), Compound(("likes", "bob", "tea"))]
    assert check_text(LIKES + "ann likes tea. p(X) :- X likes tea.") == []


def test_several_predicates_may_be_declared_in_one_line():
    one_by_one = [Directive(Compound(("dynamic", Compound(("/", name, 1))))) for name in "pq"]
    for line in (":- dynamic p/1, q/1.", ":- dynamic([p/1, q/1])."):
        assert read_text(line) == one_by_one
    assert KnowledgeBase.from_text(":- dynamic p/1, q/1.").ask("p(a)") is False


# --- in several files -----------------------------------------------------------------------------------------------


def written(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.pl").write_text(text)
    return folder / "main.pl"


def test_what_is_included_is_read_with_the_operators_of_the_text(tmp_path):
    main = written(tmp_path, main=LIKES + ':- include("other.pl").\n', other="ann likes tea.\n")
    assert heads(Sources().sentences(main)) == [Compound(("likes", "ann", "tea"))]


def test_what_an_included_file_declares_is_in_force_after_the_line(tmp_path):
    main = written(tmp_path, main=':- include("ops.pl").\nann likes tea.\n', ops=LIKES)
    assert heads(Sources().sentences(main)) == [Compound(("likes", "ann", "tea"))]


def test_and_not_before_it(tmp_path):
    main = written(tmp_path, main='ann likes tea.\n:- include("ops.pl").\n', ops=LIKES)
    with pytest.raises(ReadError, match=r"main.pl:1:5: 'likes' does not belong here"):
        Sources().sentences(main)


def test_a_used_text_has_operators_of_its_own(tmp_path):
    main = written(tmp_path, main=':- use("other.pl", as(o)).\nann likes tea.\n', other=LIKES + "bob likes tea.")
    with pytest.raises(ReadError, match=r"main.pl:2:5"):
        Sources().sentences(main)
    main = written(tmp_path, main=LIKES + ':- use("other.pl", as(o)).\n', other="bob likes tea.")
    with pytest.raises(ReadError, match=r"other.pl:1:5"):
        Sources().sentences(main)


def test_two_files_of_a_domain_are_two_texts(tmp_path):
    written(tmp_path, main=LIKES, other="ann likes tea.")
    sources = Sources()
    sources.sentences(tmp_path / "main.pl")
    with pytest.raises(ReadError):
        sources.sentences(tmp_path / "other.pl")


def test_a_mistake_in_an_included_file_is_its_own(tmp_path):
    main = written(tmp_path, main='p(a).\n:- include("bad.pl").\n' + "p(b).\n" * 5000, bad="q(a b).\n")
    with pytest.raises(ReadError, match=r"bad.pl:1:5"):
        Sources().sentences(main)


@pytest.mark.parametrize(
    ("declared", "text", "same"),
    [
        ("op(700, yf, holds)", "a = b holds", "holds(a = b)"),
        ("op(500, yf, ++)", "a * b ++", "'++'(a * b)"),
        ("op(500, yf, ++)", "a + b ++", "'++'(a + b)"),
        ("op(200, xf, ++)", "- a ++", "- ('++'(a))"),
        ("op(200, xf, ++)", "f(a ++, b)", "f('++'(a), b)"),
        ("op(200, xf, ++)", "a ^ b ++", "a ^ '++'(b)"),
        ("op(200, xf, ++)", "(a ++) ++", "'++'('++'(a))"),
        ("op(200, xf, ++)", "[a ++ | b]", "['++'(a) | b]"),
        ("op(300, xf, ++)", "a ++ - b", "'++'(a) - b"),
        ("op(200, xf, ++)", "[a, b] ++", "'++'([a, b])"),
        ("op(200, xf, ++)", "{a} ++", "'++'({a})"),
        ("op(200, xf, ++)", "{} ++", "'++'({})"),
        ("op(200, xf, ++)", '"a b" ++', "'++'('a b')"),
        ("op(1, xf, ++)", "f(a) ++", "'++'(f(a))"),
        ("op(1, xf, ++)", "X ++", "'++'(X)"),
        ("op(1, xf, ++)", "-1 ++", "'++'(-1)"),
    ],
)
def test_an_operator_behind_its_operand_takes_as_much_as_in_swi_prolog(declared, text, same):
    assert heads(read_text(f":- {declared}. p({text}).")) == heads(read_text(f"p({same})."))


@pytest.mark.parametrize(
    ("declared", "text"),
    [
        ("op(700, xf, holds)", "a = b holds"),
        ("op(500, xf, ++)", "a + b ++"),
        ("op(200, xf, ++)", "a ++ ^ b"),
        ("op(200, xf, ++)", "a ++ ++"),
        ("op(1000, xf, ++)", "f(a ++)"),
    ],
)
def test_an_operator_behind_its_operand_takes_no_more_than_its_priority(declared, text):
    with pytest.raises(ReadError, match="does not belong here"):
        read_text(f":- {declared}. p({text}).")
