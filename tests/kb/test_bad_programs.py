"""Programs with no meaning are refused with one sentence and a place."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.text.reader import read_text


def refusal(text):
    with pytest.raises(ProgramError) as caught:
        KnowledgeBase.from_text(text, "home.pl")
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("human(ann).\nagent(X) :- humen(X).", "home.pl:2:13: nothing defines humen/1; did you mean human?"),
        ("agent(X) :- zzz(X).", "home.pl:1:13: nothing defines zzz/1; add a fact or a rule for it"),
        ("human(ann). p :- human(ann, 3).", "home.pl:1:18: human takes 1 argument, not 2"),
        ("r(a, b). r(a, b, c). p :- r(a).", "home.pl:1:27: r takes 2 or 3 arguments, not 1"),
        ("p :- \\+ q.", "home.pl:1:9: nothing defines q/0; add a fact or a rule for it"),
        ('never("x") :- p(1).', "home.pl:1:15: nothing defines p/1; add a fact or a rule for it"),
        ("n(1). p(X) :- n(Y), X is foo + Y.", "home.pl:1:21: nothing computes foo/0"),
        ("n(1). p(X) :- n(Y), X is 2 * sqr(Y).", "home.pl:1:21: nothing computes sqr/1; did you mean sqrt?"),
        ("n(1). p(X) :- n(X), X < ann.", "home.pl:1:21: nothing computes ann/0"),
        ("n(1). p(X) :- n(X), [X, X] =:= 1.", "home.pl:1:21: nothing computes ./2"),
        ("h(a). p :- h(_), \\+ h(Y).", "home.pl:1:21: Y stands only under a negation; bind it by a condition, or write _"),
        ("h(a). p :- h(_), \\+ h(_Y).", "home.pl:1:21: _Y stands only under a negation"),
        ("p. never(X) :- p.", "home.pl:1:4: a constraint starts with its sentence"),
        ("p. never :- p.", "home.pl:1:4: a constraint starts with its sentence"),
        ('p. never("x", 3) :- p.', "home.pl:1:4: a constraint starts with its sentence"),
        ('never("x").', "home.pl:1:1: this constraint is always broken; give it a body"),
        ("valid(x).", "home.pl:1:1: valid/1 is defined by the system; choose another name"),
        ("p. claim(X) :- p.", "home.pl:1:4: claim/1 is defined by the system"),
        ("did(a, 1).", "home.pl:1:1: did/2 is defined by the system"),
        (":- dynamic(valid/1).", "valid/1 is defined by the system"),
        ("'='(a, b).", "home.pl:1:1: =/2 is defined by the system"),
        (":- use_module(lists).", "home.pl:1:1: the only directive is :- dynamic(name/arity), not use_module(lists)"),
        (":- dynamic(X/1).", "home.pl:1:1: the only directive is :- dynamic(name/arity), not dynamic(X / 1)"),
        (":- dynamic(p).", "home.pl:1:1: the only directive is :- dynamic(name/arity), not dynamic(p)"),
        (":- dynamic(p / -1).", "home.pl:1:1: the only directive is"),
        ("tea --> boil.", "home.pl:1:1: a plan (-->) belongs in a plan library, not in a knowledge base"),
    ],
)
def test_a_program_without_meaning_is_refused(text, sentence):
    assert sentence in refusal(text)


def test_an_undefined_predicate_in_a_query_is_refused_with_a_suggestion():
    with pytest.raises(ProgramError, match=r"<query>:1:11: nothing defines humen/1; did you mean human\?"):
        KnowledgeBase.from_text("human(ann).").query("human(X), humen(X)")


@pytest.mark.parametrize("question", ["ask", "why"])
def test_an_undefined_predicate_is_refused_whatever_is_asked(question):
    with pytest.raises(ProgramError, match="did you mean human"):
        getattr(KnowledgeBase.from_text("human(ann)."), question)("humen(ann)")


def test_a_fact_with_a_variable_is_refused():
    with pytest.raises(ProgramError, match=r"p\(X\) has a variable"):
        KnowledgeBase().fact("p(X)")


def test_a_clause_built_in_python_is_checked_too():
    base = KnowledgeBase([Clause(Compound(("=", "a", "b")))])
    with pytest.raises(ProgramError, match="=/2 is defined by the system"):
        base.compile()


def test_a_mistake_leaves_no_half_forgotten_answer_behind():
    base = KnowledgeBase.from_text("p(a).")
    with pytest.raises(ProgramError):
        base.add(read_text("p(b). tea --> boil."))
    assert base.ask("p(b)") and len(base) == 2


def test_positive_recursion_is_no_circle():
    KnowledgeBase.from_text("p(X) :- q(X). q(X) :- p(X). q(a). r(X) :- p(X), \\+ s(X). s(X) :- t(X). t(b).")


def test_a_dynamic_predicate_may_have_no_facts():
    assert not KnowledgeBase.from_text(":- dynamic(p/1). q :- p(_).").ask("q")


def test_a_term_nested_beyond_python_is_refused_in_words():
    term = "a"
    for _ in range(50_000):
        term = Compound(("f", term))
    x = Variable("X")
    base = KnowledgeBase([Clause(Compound(("p", term))), Clause(Compound(("q", x)), (Literal(Compound(("p", x))),))])
    assert base.ask(Compound(("q", x)))
