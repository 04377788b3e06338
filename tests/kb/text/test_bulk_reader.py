"""Large texts are read as the grammar would read them, place by place."""

import sys

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from programs import texts

from casper.kb.errors import ReadError
from casper.kb.terms.clauses import Clause, Production
from casper.kb.terms.terms import Compound, Variable
from casper.kb.text import reader
from casper.kb.text.bulk.reader import read_large

facts = st.sampled_from(["p(a).", "q( b ,12 ).", "r(a,b,c_1).  % done.", "p(1e5).", "p(1.5).", "p(is).", "q(a,\n  b).", "p(007)."])

# --- sentences that are plain, or nearly: any blanks or comments between any two of their tokens ---------------------

BLANKS = ["\n", "\t", "  \n ", "\r\n", "\x0b", "\x1c", "\u2003", "\xa0", "% a. b(_\n", "/* c. * */", "/**/"]
SIMPLE = ["a", "cup", "is", "isa", "is_", "a_1", "g17", "X", "Xis", "_", "_", "_", "__", "_1", "A_", "0", "12", "007", "9" * 18]
OTHER = ["9" * 19, "-3", "1.5", "2e3", "\u0663", "'a. b'", "'it''s'", '"say ""hi"". "', "''", "[]", "[a | X]", "X is Y", "a:b", "\\+ a", "(a)"]
MISTAKES = ["a(b c).", "a --> .", "a(X", "a, b.", "X --> a.", "'open.", "/* open", "a. b", "a.b.", ").", "a --> b :- c.", "a(1e).", "é.", "12.", "a :- X.", "a(5is)."]


def mostly(usual, *others):
    """One of the strategies, nine times of ten or so the first; `one_of` counts a strategy once."""
    return st.sampled_from([usual] * 9 * len(others) + [*others]).flatmap(lambda chosen: chosen)


def spaced(*tokens):
    """The tokens, which may be strategies, with something between any two."""
    between = [t for token in tokens for t in (token if isinstance(token, st.SearchStrategy) else st.just(token), blanks)]
    return st.tuples(*between[:-1]).map("".join)


def series(items, most=3):
    return st.lists(st.tuples(blanks, items, blanks).map("".join), min_size=1, max_size=most).map(",".join)


def compound(arguments):
    return st.builds("{}({})".format, names, series(arguments))


blanks = mostly(st.sampled_from(["", "", " "]), st.sampled_from(BLANKS))
names = st.sampled_from(["a", "is", "g17", "put_", "isa", "goal", "claim", "a_b"])
values = mostly(st.sampled_from(SIMPLE), st.sampled_from(OTHER))
compounds = st.one_of(compound(values), compound(st.one_of(values, compound(values))))
statements = mostly(st.one_of(names, compounds), compound(compound(compound(values))), st.just("a (b)"))
items = mostly(statements, values)
conditions = mostly(statements, st.sampled_from(["\\+ a(_)", "X is 1", "a:b", "(a ; b(_))"]))
productions = spaced(statements, "-->", series(items), ".")
rules = spaced(statements, ":-", series(conditions), ".")
odd = st.one_of(
    spaced(statements, "-->", items, ";", items, "."),
    spaced(statements, ":-", conditions, ";", conditions, "."),
    spaced(":-", statements, "."),
)
gaps = st.sampled_from(["\n", "\n", " ", "\n\n", "% e. f(\n", " /* g(_). */ "])


def mixed(*others):
    """Texts of sentences that are plain, or nearly, and of others."""
    sentences = mostly(st.one_of(spaced(statements, "."), productions, rules), odd, facts, texts, *others)
    return st.lists(st.tuples(sentences, gaps).map("".join), max_size=8).map("".join)


# --- what is read of a text ------------------------------------------------------------------------------------------


def outcome(read, text):
    """Everything there is to know of the sentences, places and types too, or the mistake."""
    try:
        return [(s, s.place, exact(s)) for s in read(text, "f.pl")]
    except ReadError as mistake:
        return str(mistake), mistake.place, mistake.excerpt


def exact(sentence):
    """The terms of a sentence with their types, and the places of its conditions."""
    if isinstance(sentence, Production):
        return typed(sentence.head), typed(sentence.body)
    if isinstance(sentence, Clause):
        return typed(sentence.head), [(typed(x.atom), x.negated, x.place) for x in sentence.body]
    return typed(sentence.term)


def typed(term):
    inner = tuple(map(typed, term)) if isinstance(term, tuple) else (term.name, term.serial) if isinstance(term, Variable) else term
    return type(term), inner


def read_fast(text, file):
    return read_large(text, file, lambda part: reader.read_plainly(part, file))


def refuse(text):
    raise AssertionError(f"the grammar was asked to read {text[:200]!r}")


@given(st.lists(st.one_of(facts, texts, st.sampled_from(["% note.\n", "/* p(x). */", "p(a", "p(b)."])), max_size=8).map("\n".join))
def test_a_large_text_is_read_as_the_grammar_reads_it(text):
    before, reader.LARGE = reader.LARGE, 0
    try:
        fast = outcome(reader.read_text, text)
    finally:
        reader.LARGE = before
    assert fast == outcome(reader.read_plainly, text)


@given(mixed())
@example("a(_, _X) --> b(_),\n  is, c(f(_, 1), _).")
@example("p(a, \u0663, _) --> q(1, 9\u0663).")
@example("goal(_) :- b(_,\n _), \u2003c(is).")
def test_productions_facts_and_rules_are_read_as_the_grammar_reads_them(text):
    assert outcome(read_fast, text) == outcome(reader.read_plainly, text)


@given(mixed(st.sampled_from(MISTAKES)))
@example("p(a). q(b c).\n")
@example("p(a).q(b).\n")
@example("p(_#1) --> a(_).\n")
@example("p(X, [a]).\np(a).\nX --> a.\na(b c).\n")
@example("p(a).\n'a'.\nq(X) :- r(X\n\n% the end\n")
def test_a_mistake_is_told_as_the_grammar_tells_it(text):
    assert outcome(read_fast, text) == outcome(reader.read_plainly, text)


@pytest.mark.parametrize(
    "line",
    [
        "goal(g17).",
        "goal(g17(X, Y)).",
        "idle.",
        "g17 --> a3, a5, a1, a9.",
        "g17(X, _) --> a3( X , cup ), a5(pot(Y), 12), clean(_), is.",
        "goal(breakfast(F)) :- biscuits(F), on(F, _).",
        "g17-->a3.% a comment. And (another",
        "/* a comment */ g17 -->\n    a3,\r\n    a5\n    .",
    ],
)
def test_the_grammar_is_not_asked_about_plain_sentences(line):
    assert len(read_large(f"{line}\n\n" * 3, "f.pl", refuse)) == 3


def test_sentences_that_are_not_plain_go_to_the_grammar_together_however_they_are_scattered():
    asked = []

    def parse(part):
        asked.append(part)
        return reader.read_plainly(part, "f.pl")

    text = "g(X) --> a(X).\ngoal(g(X)) :- f(X) ; \\+ h(X).\n" * 300
    assert len(read_large(text, "f.pl", parse)) == 900
    assert len(asked) == 1 and "-->" not in asked[0]


def test_a_mistake_in_a_large_library_does_not_make_the_grammar_read_the_plain_sentences():
    asked = []

    def parse(part):
        asked.append(part)
        return reader.read_plainly(part, "f.pl")

    with pytest.raises(ReadError, match=r"f.pl:301:10"):
        read_large("g(X) --> a(X).\n" * 300 + "g(X) --> , b.  % a comment\n" + "g(X) --> a(X).\n" * 300, "f.pl", parse)
    assert all("a(X)" not in part for part in asked)


def test_the_words_of_plain_sentences_are_interned():
    [fact, production] = read_large("goal(tea(mug)).\ntea(C) --> boil, pour(C, mug).\n", "f.pl", refuse)
    words = [fact.head[0], *fact.head[1], production.head[0], production.body[1], *production.body[2][::2]]
    assert all(word is sys.intern("".join(list(word))) for word in words)


def test_the_body_of_one_plain_item_is_the_item():
    [production] = read_large("tea --> boil.", "f.pl", refuse)
    assert (production.head, production.body) == (Compound(("tea",)), "boil")


def test_anonymous_variables_are_numbered_anew_in_each_sentence():
    [first, second] = read_large("a(_) --> b(_), c.\nd --> b(_), b(_).", "f.pl", refuse)
    assert (first.head[1], first.body[1][1]) == (Variable("_#1"), Variable("_#2"))
    assert [item[1] for item in second.body[1:]] == [Variable("_#1"), Variable("_#2")]


@pytest.mark.parametrize("unfinished", ["p(" + "a" * 200, "p(X) :- " + "q(X, 1.5), /* and */ " * 60, "p(" + "'it''s', " * 60])
def test_a_last_sentence_without_its_full_stop_is_told_at_once(unfinished):
    with pytest.raises(ReadError, match=r"in the middle of a clause|expected"):
        read_fast("p(a).\n" + unfinished, "f.pl")


def test_a_mistake_deep_in_a_large_text_is_told_with_its_place():
    text = "edge(a, b).\n" * 5000 + "edge(a b).\n" + "edge(a, b).\n" * 10
    with pytest.raises(ReadError) as told:
        reader.read_text(text, "big.pl")
    assert (told.value.place.line, told.value.place.column) == (5001, 8)
