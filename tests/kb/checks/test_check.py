"""Mistakes in a text are all told at once, each with its place and what may have been meant."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import programs, texts

from casper.kb.base import KnowledgeBase
from casper.kb.checks.check import Context, check_sentences, check_text
from casper.kb.checks.finding import Severity, sorted_findings
from casper.kb.errors import CasperError, ReadError
from casper.kb.terms.clauses import Clause
from casper.kb.text.reader import read_text
from casper.kb.text.recovery import read_tolerantly


def found(text):
    return [(f.place.line, str(f.severity), f.message) for f in check_text(text, "t.pl")]


def messages(text):
    return [message for _, _, message in found(text)]


SOUND = """\
human(ann). robot(rob). plate(plate).
agent(X) :- human(X).
agent(X) :- robot(X).
wave(A) :- agent(A), \\+ plate(A).
never("nobody waves at plates") :- claim(wave(A)), plate(A).
never("nothing is both") :- human(X), plate(X).
"""


def test_a_sound_text_has_no_findings():
    assert found(SOUND) == []


def test_every_mistake_is_told_not_only_the_first():
    lines = ["human(ann).", "a(X) :- humn(X).", "b(X :- human(X).", "c(X) :- robot(X).", "never(\"x\").", "claim(x)."]
    assert [line for line, severity, _ in found("\n".join(lines)) if severity == "error"] == [2, 3, 4, 5, 6]


# --- reading on -----------------------------------------------------------------------------------------------------


def test_after_a_syntax_error_reading_goes_on_behind_the_next_full_stop():
    read = read_tolerantly("p(a). q(b c, 'd. '). r(1.5). s(x", "t.pl")
    assert [str(m.place) for m in read.mistakes] == ["t.pl:1:11", "t.pl:1:33"]
    assert read.sentences == read_text("p(a). r(1.5).")


def test_a_missing_full_stop_costs_no_clause():
    read = read_tolerantly("human(ann)\nagent(X) :- human(X)\n\nrobot(rob).\n", "t.pl")
    assert [m.place.line for m in read.mistakes] == [2, 4]
    assert read.sentences == read_text("human(ann). agent(X) :- human(X). robot(rob).")


def test_what_an_unreadable_clause_would_have_defined_is_not_called_undefined():
    assert [line for line, *_ in found("human(ann.\nagent(X) :- human(X).")] == [1]


def test_the_line_of_a_syntax_error_is_shown_whole():
    (mistake,) = read_tolerantly("p(a). q(b c).\n", "t.pl").mistakes
    assert mistake.excerpt == "    p(a). q(b c).\n              ^"


def test_an_open_comment_or_quote_is_told_once():
    assert len(read_tolerantly("p(a). /* never closed\nq(b).").mistakes) == 1
    assert read_tolerantly("p('a).\nq(b).").sentences == read_text("q(b).")


@given(texts)
def test_what_can_be_read_is_read_tolerantly_as_strictly(text):
    try:
        strict = read_text(text)
    except ReadError:
        assert read_tolerantly(text).mistakes
    else:
        assert read_tolerantly(text).sentences == strict
        broken = read_tolerantly(f"{text}\n p(.")  # cut at full stops, piece by piece
        assert broken.sentences == strict


@given(st.text(st.sampled_from(list("pX(),.:- '\"%\n/*a1")), max_size=60))
def test_no_text_makes_the_check_fail(text):
    check_text(text)


# --- names ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("human(ann). p(X) :- humn(X).", "nothing defines humn/1; did you mean human?"),
        ("human(ann). p(X) :- human(X, X).", "human takes 1 argument, not 2"),
        ("p(X) :- zebra(X).", "nothing defines zebra/1; add a fact or a rule for it"),
        ("q(a). p(X) :- q(X), \\+ q(Y).", "Y stands only under a negation; bind it by a condition, or write _"),
        ("human(ann). human(ann, bob). human(eve).", "human has 2 arguments here, and 1 elsewhere (line 1); they are two different relations"),
        ("q(a, b). p(X) :- q(X, Other).", "Other stands only once here; write _ or _Other if it is meant to be anything"),
        ("q(a, b). p(A, B) :- q(C, D).", "A, B, C and D stand only once here; write _ or _A if they are meant to be anything"),
        ("q(a, b). p :- q(_A, _A).", "_A starts with _ but is used twice"),
        ("greet(X) --> wave(X, Y).", "Y stands only once here; write _ or _Y if it is meant to be anything"),
        ("never(X) :- claim(X).", 'a constraint starts with its sentence: never("…") :- …'),
        ("q(a). p(X) :- q(X), findall(Y, qq(Y), _L).", "nothing defines qq/1; did you mean q?"),
        ("q(a). p(X) :- q(X), \\+ (q(X), qq(X)).", "nothing defines qq/1; did you mean q?"),
        ("q(a). p(X) :- q(X), aggregate_all(mean(X), q(X), _N).", "aggregate_all cannot work out mean(X); write count"),
        ("q(a). p(X) :- q(X), write(X).", "write/1 is not part of the language; print from Python"),
        ("q(a). p(X) :- \\+ q(X).", "nothing here binds the variables of \\+ q(X): p/1 must be asked with them"),
        ("q(a). p(X, Y) :- q(X), Y > X.", "nothing here binds the variables of Y > X: p/2 must be asked with them"),
        (":- module(x).", "the only directive is :- dynamic(name/arity), not module(x)"),
    ],
)  # fmt: skip
def test_a_name_that_is_wrong_is_told(text, message):
    assert any(message in told for told in messages(text))


@pytest.mark.parametrize(
    "text",
    [
        ":- dynamic(later/1). p(X) :- later(X).",
        "q(a, b). p(X) :- q(X, _).",
        "q(a, b). p(X) :- q(X, _Other).",
        "q(a). r(b). s(X) :- q(X) ; r(X).",
        "q(a). r(a). p :- q(X), (r(X) ; X = a).",
        "n(1, a). n(X) :- n(X, _).",  # one is defined by the other
        "q(1). p(X, Y) :- q(X), Y is X + 1, Y > X, Y = Z, Z \\= 3, \\+ q(Z).",
        "goal(tea(C)) :- cup(C). cup(mug). tea(C) --> boil, pour(C).",
    ],
)
def test_what_is_meant_so_is_not_told(text):
    assert found(text) == []


# --- bodies ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "body",
    [
        "X = a, X = b", "X = a, X \\= a", "X = Y, q(Y), X \\= Y", "X \\= X", "1 > 2", "X = a, b = c", "\\+ q(X)",
        "X < 1, X > 2", "X < 1, X >= 1", "1 > X, X > 3", "q(Y), X < Y, Y < X", "X =< 2, X > 2", "X = 3, X < 2", "X = f(Y), q(Y), X = g(Y)",
    ],
)  # fmt: skip
def test_a_body_that_contradicts_itself_is_told(body):
    told = [m for m in messages(f"q(a). q(1). q(2). q(3). p(X) :- q(X), {body}.") if "can never hold" in m]
    assert len(told) == 1
    assert told[0].endswith("; the rule gives nothing")


@pytest.mark.parametrize("body", ["X = a, X \\= b", "X < 2, X > 0", "X =< 2, X >= 2", "\\+ q(b)", "q(Y), X < Y", "X = Y, q(Y)", "1 < 2"])
def test_a_body_that_can_hold_is_not(body):
    assert not any("can never" in m for m in messages(f"q(a). q(1). q(2). p(X) :- q(X), {body}."))


@given(programs())
def test_a_rule_that_is_said_to_give_nothing_gives_nothing(text):
    clauses = [s for s in read_text(text) if isinstance(s, Clause)]
    heads = {c.head.indicator for c in clauses}
    needed = {x.atom.indicator for c in clauses for x in c.body if not x.is_comparison}
    kb = KnowledgeBase(clauses, needed - heads)
    for finding in check_sentences(clauses, Context(known=needed - heads)).findings:
        if finding.message.endswith("gives nothing"):
            rule = next(c for c in clauses if c.place.line == finding.place.line)
            without = KnowledgeBase([c for c in clauses if c is not rule], needed | heads)
            assert set(without.stored(rule.head.indicator)) == set(kb.stored(rule.head.indicator))


def test_a_clause_said_twice_is_told_even_with_other_variables():
    text = "q(a).\np(X, Y) :- q(X), q(Y).\np(A, B) :- q(A), q(B).\np(A, A) :- q(A), q(A).\nq(a).\n"
    assert [(line, m) for line, _, m in found(text)] == [
        (3, "this says the same as line 2; take one of them out"),
        (5, "this says the same as line 1; take one of them out"),
    ]


# --- the facts ------------------------------------------------------------------------------------------------------


def test_a_rule_that_needs_what_nobody_knows_gives_nothing():
    text = "q(a). r(b).\np(X) :- q(X), r(X).\ns(X) :- p(X).\nt(X) :- q(X), X = c."
    assert found(text) == [
        (2, "warning", "no facts satisfy q(X), r(X) together, so the rule gives nothing"),
        (4, "warning", "no facts satisfy q(X), X = c together, so the rule gives nothing"),
    ]


def test_what_is_declared_dynamic_may_come_later():
    assert found(":- dynamic(r/1). q(a). p(X) :- q(X), r(X). s(X) :- p(X), q(X).") == []


def test_what_depends_on_the_situation_is_not_judged_by_the_facts():
    assert found('q(a). p(X) :- q(X), did(eat(X), _). never("x") :- p(X), q(X). never("y") :- q(X), \\+ did(eat(X), _).') == []


def test_a_broken_constraint_is_told_with_the_facts_that_clash():
    text = "human(ann). robot(rob). robot(ann).\nagent(X) :- human(X).\nnever(\"nobody is both\") :- agent(X), robot(X).\n"
    assert found(text) == [(3, "error", 'the facts break "nobody is both": human(ann) (t.pl:1), robot(ann) (t.pl:1)')]


def test_a_clash_through_an_anonymous_variable_is_told_with_its_value():
    assert 'the facts break "none": on(a, b) (t.pl:1)' in messages('on(a, b). never("none") :- on(_, _).')


# --- what needs what ------------------------------------------------------------------------------------------------


def test_each_negation_through_recursion_is_told_with_its_circle():
    text = "q(a).\np(X) :- q(X), \\+ r(X).\nr(X) :- q(X), \\+ p(X).\ns(X) :- q(X), \\+ s(X).\n"
    assert found(text) == [
        (2, "note", "negation runs in a circle: p/1 needs not r/1 needs p/1; what the facts do not settle is undefined"),
        (4, "note", "negation runs in a circle: s/1 needs not s/1; what the facts do not settle is undefined"),
    ]


def test_what_nothing_asks_for_is_noted_at_the_top_of_its_chain():
    text = "q(a). human(a).\nused(X) :- q(X).\nalone(X) :- below(X).\nbelow(X) :- q(X).\nhumam(b).\nodd(X) :- even(X).\neven(X) :- odd(X).\neven(a).\n"
    checked = check_sentences(read_text(text), Context(asked=[("used", 1), ("human", 1)]))
    notes = sorted_findings(f for f in checked.findings if "nothing needs" in f.message)
    assert [(f.place.line, f.message.split(":")[0]) for f in notes] == [
        (3, "nothing needs alone/1"),
        (5, "nothing needs humam/1"),
        (6, "nothing needs odd/1"),
    ]
    assert any(f.message.endswith("did you mean human?") for f in notes)
    assert {f.severity for f in notes} == {Severity.NOTE}


ODD = [
    "claim(x).", 'never("x").', 'never(b0) :- b0(_).', "odd(X) :- b0(X), \\+ odd(X).", "odd(X :- b0(X).", "odd :- \\+ b1(Q, a).",
    "odd(X) :- b0(X), nobody(X).", ":- import(x).", "b0(a, b).", "odd(X) :- b0(Y).", "X :- b0(X).", "odd(X) :- b0(X), X < a.", "a = b.",
]  # fmt: skip


@given(programs(), st.data())
def test_there_are_errors_exactly_when_a_text_cannot_be_loaded(text, data):
    lines = [line for line in text.splitlines() if data.draw(st.integers(0, 9)) < 9]
    text = "\n".join(data.draw(st.permutations([*lines, *data.draw(st.lists(st.sampled_from(ODD), max_size=1))])))
    errors = [f for f in check_text(text) if f.severity is Severity.ERROR]
    try:
        kb = KnowledgeBase.from_text(text)
    except CasperError as mistake:
        assert errors, mistake
    else:  # what the facts break is an error of theirs, and loads
        assert all("the facts break" in f.message for f in errors)
        assert not errors or kb.broken()


def test_a_constraint_that_the_facts_break_is_told_though_more_facts_may_come():
    text = ':- dynamic(kitten/1). cat(X) :- kitten(X). cat(tom). dog(tom). never("no cat is a dog") :- cat(X), dog(X).'
    assert [message for message in map(str, check_text(text)) if "the facts break" in message] != []


@pytest.mark.parametrize(
    "body",
    [
        "cat(X), \\+ fed(X)",  # a fact to come may undo it
        "hungry(X)",
        "cat(X), did(miaow(X), _)",
    ],
)
def test_a_constraint_that_facts_to_come_may_mend_is_not_told(body):
    text = f':- dynamic(fed/1). cat(tom). hungry(X) :- cat(X), \\+ fed(X). never("cats are fed") :- {body}.'
    assert [message for message in map(str, check_text(text)) if "the facts break" in message] == []


def test_a_rule_that_cites_where_it_comes_from_needs_no_cases():
    rules = "cat(tom). :- dynamic(p/0). big(X) :- cat(X), X \\= tom."
    assert any("gives nothing" in str(f) for f in check_text(rules))
    assert not any("gives nothing" in str(f) for f in check_text(f"{rules}  %: Big SubClassOf Cat"))


def test_an_expression_that_nothing_computes_is_told_with_what_may_have_been_meant():
    found = [f.message for f in check_text("n(1). p(X) :- n(Y), X is sqr(Y). q(X) :- n(X), X < a.")]
    assert found[:2] == ["nothing computes sqr/1; did you mean sqrt?", "nothing computes a/0; write a number, a variable or a function of arithmetic"]


def test_facts_that_may_break_a_constraint_are_told():
    found = [str(f) for f in check_text('n(a). never("too large") :- n(X), X > 3.', "home.pl")]
    assert found == ['home.pl:1: warning: whether the facts break "too large" is undefined: X = a is undefined: a is not a number']
