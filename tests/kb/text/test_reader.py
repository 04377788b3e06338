"""The language: every form of it."""

import pytest

from casper.kb.errors import ReadError
from casper.kb.terms.clauses import Clause, Directive, Literal, Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, make_list
from casper.kb.text.reader import read_file, read_query, read_statement, read_text
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
        ("(a, b, c)", Compound((",", "a", Compound((",", "b", "c"))))),
        ("(a ; b)", Compound((";", "a", "b"))),
        ("\\+ a", Compound(("\\+", "a"))),
        ("((a))", "a"),
        ("- a", Compound(("-", "a"))),
        ("- 1", Compound(("-", 1))),
        ("-(1)", Compound(("-", 1))),
        ("- - 1", Compound(("-", Compound(("-", 1))))),
        ("1 - 1", Compound(("-", 1, 1))),
        ("1 -1", Compound(("-", 1, 1))),
        ("- = -", Compound(("=", "-", "-"))),
        ("{a}", Compound(("{}", "a"))),
        ("{a, b}", Compound(("{}", Compound((",", "a", "b"))))),
        ("{}", "{}"),
        ("{}(a)", Compound(("{}", "a"))),
        ("(a :- b)", Compound((":-", "a", "b"))),
        ("(a :- b, c ; d -> e)", Compound((":-", "a", Compound((";", Compound((",", "b", "c")), Compound(("->", "d", "e"))))))),
        ("0'a", 97),
        ("0'\\n", 10),
        ("0'''", 39),
        ("0' ", 32),
        ("0xff", 255),
        ("0b101", 5),
        ("0o17", 15),
        ("36'Zz", 1295),
        ("1_000_000", 1000000),
        (r"'\x41\'", "A"),
        (r"'\x41\\x42\'", "AB"),
        (r"'\u00e9'", "é"),
        (r"'\U0001F600'", "\U0001f600"),
        (r"'\101\'", "A"),
        (r"'\e\s\a\b\f\v\r\0\'", "\x1b \a\b\f\v\r\0"),
        ("'one \\\nline'", "one line"),
        ("'one\\\n   line'", "oneline"),
        ("`ab`", make_list([97, 98])),
        ("éclair", "éclair"),
        ("Ünal", Variable("Ünal")),
        ("_é", Variable("_é")),
        ("e\u0301", "e\u0301"),
        ("日本語", "日本語"),
        ("Αθήνα", Variable("Αθήνα")),
        ("αθήνα", "αθήνα"),
        ("→", "→"),
        ("+", "+"),
        ("[-]", make_list(["-"])),
        ("f(+, -)", Compound(("f", "+", "-"))),
        ("=..", "=.."),
        ("a =.. b", Compound(("=..", "a", "b"))),
        ("1 + 2 mod 3", Compound(("+", 1, Compound(("mod", 2, 3))))),
        ("2 ** 3 * 4", Compound(("*", Compound(("**", 2, 3)), 4))),
        ("2 ^ 3 ^ 4", Compound(("^", 2, Compound(("^", 3, 4))))),
        ("5 // 2 rem 3 xor 4", Compound(("xor", Compound(("rem", Compound(("//", 5, 2)), 3)), 4))),
        ("1 << 2 /\\ 3 \\/ 4", Compound(("\\/", Compound(("/\\", Compound(("<<", 1, 2)), 3)), 4))),
        ("\\ 1", Compound(("\\", 1))),
        ("a =:= b", Compound(("=:=", "a", "b"))),
        ("a @< b", Compound(("@<", "a", "b"))),
        ("'is'(a, b)", Compound(("is", "a", "b"))),
        ("!", "!"),
    ],
)
def test_a_term_reads_as_what_it_says(text, term):
    assert argument(text) == term
    assert type(argument(text)) is type(term)


def test_a_byte_order_mark_says_nothing():
    assert read_text("\ufeffp(a).") == read_text("p(a).")
    assert str(read_text("\ufeffp(a).")[0].place) == "<text>:1:1"
    assert read_statement("\ufeffp(a)") == read_statement("p(a)")


def test_a_file_may_begin_with_a_byte_order_mark(tmp_path):
    (tmp_path / "x.pl").write_text("p(éclair).\n", encoding="utf-8-sig")
    assert read_file(tmp_path / "x.pl") == read_text("p(éclair).")


def test_names_and_variables_are_written_in_every_script():
    (rule,) = read_text("food(éclair) :- Ünal = 'Ünal', 食物(Ünal).")
    assert rule.head == Compound(("food", "éclair"))
    assert rule.body[0].atom == Compound(("=", Variable("Ünal"), "Ünal"))
    assert program_text([rule]) == "food(éclair) :- Ünal = 'Ünal', 食物(Ünal).\n"


def test_a_full_stop_ends_nothing_within_signs_codes_and_quotes():
    assert len(read_text("p(X) :- q(X, 0'.), r('. ', \". \"), s(=.., 1.5). % . \nq. /* . */ r.")) == 3


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


def test_a_body_with_endless_alternatives_is_refused_before_they_are_made():
    body = ", ".join(f"(a{at} ; b{at})" for at in range(40))
    with pytest.raises(ReadError, match=r"this body has more than 10,000 alternatives; give groups"):
        read_text(f"p :- {body}.")


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
