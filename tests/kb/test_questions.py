"""Asking: ask, query, instances and rows, over stored relations and over searches."""

import pytest
from hypothesis import given
from programs import DERIVED, ground_terms, programs, statements_over

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.terms.terms import Compound, Variable
from casper.kb.text.reader import read_query


def everything(base, name, arity):
    return Compound((name, *(Variable(f"V{at}") for at in range(arity))))


def told(answers):
    """The true answers, and whether others are undefined."""
    found = []
    try:
        for answer in answers:
            found.append(answer)
    except Undefined:
        return found, True
    return found, False


@given(programs(circles=True))
def test_ask_query_instances_and_rows_agree(text):
    base = KnowledgeBase.from_text(text)
    for name, arity in DERIVED.items():
        relation = base.stored((name, arity))
        rows, undefined = set(relation), set(relation.undefined or ())
        pattern = everything(base, name, arity)
        for answers, values in (
            (base.rows(name, arity), tuple),
            (base.instances(pattern), lambda answer: answer.args),
            (base.query(f"{pattern}"), lambda answer: tuple(answer.values())),
        ):
            found, more = told(answers)
            assert (set(map(values, found)), more) == (rows, bool(undefined))
        assert {tuple(answer.values()) for answer in base.query(f"{pattern}", undefined=True)} == undefined
        assert base.truth(pattern) == ("true" if rows else "undefined" if undefined else "false")


@given(programs(circles=True))
def test_a_ground_question_is_true_exactly_of_the_rows(text):
    base = KnowledgeBase.from_text(text)
    for statement in statements_over(ground_terms(base.clauses)):
        relation = base.stored(statement.indicator)
        undefined = statement.args in set(relation.undefined or ())
        expected = "true" if statement.args in relation else "undefined" if undefined else "false"
        assert base.truth(statement) == base.truth(str(statement)) == expected
        found, more = told(base.instances(statement))
        assert (bool(found), more) == (expected == "true", expected == "undefined")


@given(programs(circles=True))
def test_the_search_finds_what_is_stored(text):
    stored = KnowledgeBase.from_text(text)
    searched = KnowledgeBase.from_text(text + "\n".join(f"\n{n}x({_v(a)}) :- {n}({_v(a)}), Open = Open." for n, a in DERIVED.items()))
    for name, arity in DERIVED.items():
        assert searched.stored((f"{name}x", arity)) is None
        found, more = told(searched.rows(f"{name}x", arity))
        assert (set(found), more) == (set(stored.stored((name, arity))), bool(stored.stored((name, arity)).undefined))


def _v(arity):
    return ", ".join("XY"[:arity])


FAMILY = """
parent(ann, bob). parent(bob, cid). parent(bob, dee).
ancestor(X, Y) :- parent(X, Y).
ancestor(X, Z) :- parent(X, Y), ancestor(Y, Z).
"""


@pytest.mark.parametrize(
    ("goal", "answers"),
    [
        ("ancestor(ann, X)", [{"X": "bob"}, {"X": "cid"}, {"X": "dee"}]),
        ("ancestor(X, dee)", [{"X": "bob"}, {"X": "ann"}]),
        ("ancestor(ann, cid)", [{}]),
        ("ancestor(cid, X)", []),
        ("parent(X, Y), \\+ parent(Y, _)", [{"X": "bob", "Y": "cid"}, {"X": "bob", "Y": "dee"}]),
        ("\\+ parent(Y, _), parent(ann, Y)", []),
        ("parent(X, _)", [{"X": "ann"}, {"X": "bob"}]),
        ("parent(X, bob) ; parent(X, cid)", [{"X": "ann"}, {"X": "bob"}]),
        ("X = f(Y), Y = a", [{"X": Compound(("f", "a")), "Y": "a"}]),
        ("X is 2 + 3 * 2", [{"X": 8}]),
        ("X \\= bob, parent(ann, X)", []),
        ("X = f(X)", []),
        ("\\+ parent(cid, _)", [{}]),
    ],
)
def test_a_query_is_answered_each_answer_once(goal, answers):
    found = list(KnowledgeBase.from_text(FAMILY).query(goal))
    assert len(found) == len(answers)
    assert all(answer in found for answer in answers)


def test_a_limit_ends_the_answers():
    assert len(list(KnowledgeBase.from_text(FAMILY).query("ancestor(X, Y)", limit=2))) == 2


def test_answers_come_lazily():
    endless = KnowledgeBase.from_text("nat(z). nat(s(X)) :- nat(X).").query("nat(X)")
    assert [str(next(endless)["X"]) for _ in range(3)] == ["z", "s(z)", "s(s(z))"]


LISTS = """
append([], L, L).
append([H | T], L, [H | R]) :- append(T, L, R).
adult(X, Y) :- Y > 17.
"""


def test_a_recursive_functor_runs_forwards_and_backwards():
    base = KnowledgeBase.from_text(LISTS)
    assert [str(a["X"]) for a in base.query("append([a], [b], X)")] == ["[a, b]"]
    assert len(list(base.query("append(X, Y, [a, b, c])"))) == 4


def test_a_rule_that_leaves_a_part_open_answers_with_a_variable():
    (answer,) = KnowledgeBase.from_text(LISTS).query("adult(X, 20)")
    assert isinstance(answer["X"], Variable)


def test_a_condition_that_nothing_binds_is_refused_in_the_authors_words():
    with pytest.raises(ProgramError, match=r":4:16: Y > 17 cannot be decided: bind its variables"):
        KnowledgeBase.from_text(LISTS).ask("adult(ann, Y)")


SINGLE = "person(ann). married(bob). single(X) :- \\+ married(X)."


@pytest.mark.parametrize("statement", ["single(_)", "single(X)", "single(f(X))"])
def test_a_negation_of_something_unknown_is_refused_never_no(statement):
    with pytest.raises(ProgramError, match="cannot be decided"):
        KnowledgeBase.from_text(SINGLE).ask(statement)


def test_a_negation_waits_until_its_part_is_known():
    assert list(KnowledgeBase.from_text(SINGLE).query("\\+ married(X), person(X)")) == [{"X": "ann"}]


ENDLESS = "grows(X, _) :- grows(f(X), _). lonely(X) :- \\+ grows(X, X). up(X) :- Y is X + 1, up(Y). turn(X, _) :- turn(_, f(X))."


@pytest.mark.parametrize("question", ["grows(a, b)", "lonely(a)", "up(1)", "turn(a, b)"])
def test_a_search_without_end_is_unknown_never_no(question):
    with pytest.raises(BudgetExceeded, match="the answer is unknown"):
        KnowledgeBase.from_text(ENDLESS).ask(question)


def test_recursion_that_comes_back_to_the_same_question_ends():
    base = KnowledgeBase.from_text("loop(X, _) :- loop(X, _). lonely(X) :- \\+ loop(X, X).")
    assert not base.ask("loop(a, b)")
    assert base.ask("lonely(a)")


@pytest.mark.parametrize("depth", [140, 300, 5_000])
def test_rules_may_be_nested_deeper_than_pythons_stack(depth):
    base = KnowledgeBase.from_text("a(1). deep(z). deep(s(X)) :- a(1), a(1), a(1), a(1), deep(X), a(1).")
    number = "z"
    for _ in range(depth):
        number = Compound(("s", number))
    assert base.ask(("deep", number))
    assert not base.ask(("deep", Compound(("s", Compound(("t", number))))))


def test_a_search_that_is_too_long_is_unknown_too():
    base = KnowledgeBase.from_text("d(1). d(2). d(3). d(4). d(5). d(6). d(7). first(1).")
    (body,) = read_query("first(A), d(B), d(C), d(D), d(E), A + B + C + D > 100")
    assert next(base.solver(budget=10_000).solve(body), None) is None
    with pytest.raises(BudgetExceeded, match="search for first/1 stopped after 1000 steps: the answer is unknown"):
        next(base.solver(budget=1000).solve(body))


def test_a_query_can_be_bounded_in_time_and_cancelled():
    base = KnowledgeBase.from_text("n(z). n(s(X)) :- n(X). loop(X) :- loop(X).")
    with pytest.raises(BudgetExceeded, match="steps"):
        list(base.query("n(X), X = never", budget=100))
    with pytest.raises(BudgetExceeded, match="cancelled"):
        list(base.query("n(X), n(Y), X = Y, X = never", cancelled=lambda: True))
    with pytest.raises(BudgetExceeded, match="time was up"):
        list(base.query("n(X), n(Y), X = Y, X = never", timeout=0.0))


def test_one_search_never_mistakes_anothers_variables_for_its_own():
    text = """h(ann). h(bob). f(egg). odd(_, _).
    eat(X, A) :- h(X), f(A), odd(A, _).
    can(A, X) :- valid(eat(A, X)).
    """
    assert len(list(KnowledgeBase.from_text(text).query("can(A, X)"))) == 2


def test_an_answer_is_given_once_however_many_proofs_it_has():
    base = KnowledgeBase.from_text("a(1). b(1). p(X, _) :- a(X). p(X, _) :- b(X). q(X) :- p(X, 3).")
    assert list(base.rows("q", 1)) == [(1,)]


def test_the_rows_of_a_predicate_that_is_searched_are_its_answers_without_anything_open():
    base = KnowledgeBase.from_text("p(X) :- n(Y), X = f(Y, _). p(2). n(1).")
    assert base._model.relations.get(("p", 1)) is None
    assert list(base.rows("p", 1)) == [(2,)]


def test_long_lists_are_facts_like_any_other():
    items = ", ".join(map(str, range(2000)))
    assert KnowledgeBase.from_text(f"p([{items}]).").ask(f"p([{items.replace('1999', 'Last')}])")


def test_numbers_are_the_same_however_they_are_asked_for():
    base = KnowledgeBase.from_text("size(1).")
    assert base.ask("size(1.0)")
    assert list(base.query("size(X), X = 1.0"))


@pytest.mark.parametrize("question", ["valid(3)", "valid(2.5)", "claim(a)", "did(a, 1)", "never(x)"])
def test_a_system_predicate_answers_no_where_there_is_nothing(question):
    assert KnowledgeBase.from_text("p(a).").ask(question) is False


def test_an_undefined_predicate_has_no_rows():
    assert list(KnowledgeBase.from_text("p(a).").rows("q", 1)) == []


def test_the_knowledge_base_prints_as_text_that_means_the_same():
    text = ":- dynamic('Odd name'/2). p(1). q(X) :- p(X), \\+ 'Odd name'(X, _). never(\"no q\") :- q(3)."
    base = KnowledgeBase.from_text(text)
    again = KnowledgeBase.from_text(base.to_text())
    assert again.to_text() == base.to_text()
    assert again.ask("q(1)") and again.defines("Odd name", 2)


def test_facts_and_rules_stated_in_python_are_the_same_model():
    base = KnowledgeBase()
    base.fact(("human", "ann"))
    base.fact("age(ann, 30)")
    base.rule("adult(X) :- human(X), age(X, N), N > 17")
    assert base.ask("adult(ann)")
    assert base.to_text() == "human(ann).\nage(ann, 30).\nadult(X) :- human(X), age(X, N), N > 17.\n"


def test_a_fact_stated_later_changes_the_answer():
    base = KnowledgeBase.from_text("p(a). q(X) :- p(X).")
    assert not base.ask("q(b)")
    base.fact("p(b)")
    assert base.ask("q(b)")


def test_a_nested_python_tuple_matches_like_the_text():
    base = KnowledgeBase.from_text("q(X) :- p(f(X)). p(f(z)).")
    base.fact(("p", ("f", "a")))
    assert {row for row in base.rows("q", 1)} == {("a",), ("z",)}


def test_alternatives_that_name_the_same_variables_in_another_order_are_not_mixed_up():
    base = KnowledgeBase.from_text("e(a, b).")
    assert list(base.query("e(X, Y) ; e(Y, X)")) == [{"X": "a", "Y": "b"}, {"X": "b", "Y": "a"}]
