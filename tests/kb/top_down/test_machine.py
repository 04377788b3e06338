"""The machine agrees with the specification, with bottom-up evaluation and with SWI-Prolog's tabling."""

import random

import pytest
from hypothesis import given
from programs import DERIVED, programs
from swi_answers import answers_of, needs_swipl

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable, list_items, make_list
from casper.kb.terms.unification import substitute
from casper.kb.terms.unknown import DOUBT
from casper.kb.text.reader import read_query, read_text
from casper.kb.top_down.search import Search
from casper.kb.top_down.solve import Solver


def clauses_of(text):
    table = {}
    for clause in read_text(text, "<test>"):
        if isinstance(clause, Clause):
            table.setdefault(clause.head.indicator, []).append(clause)
    return table


def everything(name, arity):
    return Compound((name, *(Variable(f"V{at}") for at in range(arity))))


@given(programs())
def test_resolution_alone_finds_the_rows_of_the_fixpoint(text):
    base = KnowledgeBase.from_text(text)
    table = {i: base.clauses_of(i) for i in [("b0", 1), ("b1", 2), ("b2", 2), *DERIVED.items()]}
    for name, arity in DERIVED.items():
        pattern = everything(name, arity)
        try:
            found = {substitute(pattern, s).args for s in certain(Search({}, table, budget=20_000), Literal(pattern))}
        except BudgetExceeded:
            continue  # a question may grow for ever, p(X) :- p(f(X)), where its answers do not
        assert found == set(base.stored((name, arity)))


def certain(search, literal):
    return [solution for solution, doubt in search.outcomes([literal]) if not doubt]


@given(programs())
def test_the_machine_and_the_specification_find_the_same(text):
    base = KnowledgeBase.from_text(text)
    table = {i: base.clauses_of(i) for i in [("b0", 1), ("b1", 2), ("b2", 2), *DERIVED.items()]}
    for name, arity in DERIVED.items():
        pattern = Literal(everything(name, arity))
        try:
            solutions = list(Solver({}, table, budget=2_000).possible([pattern]))
        except (BudgetExceeded, ProgramError):
            continue  # the specification has no tables
        expected = {substitute(pattern.atom, s) for s in solutions if DOUBT not in s}
        assert {substitute(pattern.atom, s) for s in certain(Search({}, table), pattern)} == expected
        if {substitute(pattern.atom, s) for s in solutions} - expected:
            assert any(doubt for _, doubt in Search({}, table).outcomes([pattern]))


def test_the_machine_and_the_specification_agree_on_lists():
    table = clauses_of(
        """app([], L, L). app([H | T], L, [H | R]) :- app(T, L, R).
        rev([], []). rev([H | T], R) :- rev(T, S), app(S, [H], R).
        sub([], _). sub([H | T], [H | R]) :- sub(T, R). sub(T, [_ | R]) :- sub(T, R)."""
    )
    for goal in ("rev([a, b, c], X)", "app(X, Y, [a, b])", "sub(S, [a, b, c])", "app([X], [Y], [a | T])", "app(X, X, [a, a])"):
        (body,) = read_query(goal)
        answers = [
            [str([substitute(v, s) for v in body[0].variables()]) for s in each({}, table).solve(body)]
            for each in (Solver, Search)
        ]
        assert answers[0] == answers[1]


def circular(seed):
    """A propositional-like program over two constants with negation and recursion anywhere."""
    draw = random.Random(seed)
    names = ["p", "q", "r", "s"]
    lines = [f"e({draw.choice('ab')}, {draw.choice('abc')})." for _ in range(3)] + ["n(a). n(b). n(c)."]
    for name in names:
        for _ in range(draw.randint(1, 3)):
            body = ["n(X)"]
            for _ in range(draw.randint(0, 2)):
                body.append(draw.choice(["", "", "NOT "]) + f"{draw.choice(names)}({draw.choice(['X', 'X', 'a', 'b'])})")
            if draw.random() < 0.4:
                body.append(f"e(X, Y), {draw.choice(['', 'NOT '])}{draw.choice(names)}(Y)")
            lines.append(f"{name}(X) :- {', '.join(body)}.")
    return "\n".join(lines)


def truth(text, name):
    """What is true and what is undefined of a predicate."""
    table = clauses_of(text.replace("NOT ", "\\+ "))
    pattern = Compound((name, Variable("X")))
    found = {True: set(), False: set()}
    for solution, doubt in Search({}, table).outcomes([Literal(pattern)]):
        found[not doubt].add(solution[Variable("X")])
    return found[True], found[False] - found[True]


@needs_swipl
def test_negation_in_circles_is_true_false_or_undefined_as_in_swi_prolog():
    texts = [circular(seed) for seed in range(150)]
    tables = ":- use_module(library(wfs)).\n:- table p/1, q/1, r/1, s/1.\n"
    questions = [
        (tables + text.replace("NOT ", "tnot "), f"call_delays({name}(X), D0), (D0 == true -> K = yes ; K = open)")
        for text in texts
        for name in "pqrs"
    ]
    expected = answers_of([(text, goal.replace("D0", "_D")) for text, goal in questions])
    for (text, _), rows, number in zip(questions, expected, range(len(questions))):
        true, undefined = truth(texts[number // 4], "pqrs"[number % 4])
        assert sorted([f"[{x},yes]" for x in true] + [f"[{x},open]" for x in undefined]) == sorted(rows), text


def answers(text, goal, limit=None):
    return [{k: str(v) for k, v in a.items()} for a in KnowledgeBase.from_text(text).query(goal, limit)]


NAT = "nat(z). nat(s(X)) :- nat(X). tan(s(X)) :- tan(X). tan(z)."


@pytest.mark.parametrize("order", ["p(X, _) :- nat(X), X = never. p(a, _).", "p(a, _). p(X, _) :- nat(X), X = never."])
def test_an_endless_branch_starves_no_other(order):
    assert answers(f"{NAT} {order}", "p(X, 1)", 1) == [{"X": "a"}]


def test_two_endless_branches_both_give_answers():
    text = f"{NAT} q(X, _) :- nat(X). q(t(X), _) :- nat(X)."
    kinds = {answer["X"][0] for answer in KnowledgeBase.from_text(text).query("q(X, 1)", 1_500)}
    assert kinds == {"z", "s", "t"}


def test_an_answer_behind_left_recursion_that_grows_is_found():
    assert answers(NAT, "tan(X)", 3) == [{"X": "z"}, {"X": "s(z)"}, {"X": "s(s(z))"}]


def test_conjunctions_of_endless_goals_meet():
    assert answers(f"{NAT} both(X, Y, _) :- nat(X), nat(Y), X = s(s(z)), Y = s(z).", "both(X, Y, 1)", 1) == [
        {"X": "s(s(z))", "Y": "s(z)"}
    ]


@pytest.mark.parametrize("rule", ["p(X, Z, _) :- p(X, Y, _), e(Y, Z).", "p(X, Z, _) :- e(X, Y), p(Y, Z, _).", "p(X, Z, _) :- p(X, Y, _), p(Y, Z, _)."])
def test_recursion_on_either_side_ends_on_a_circle(rule):
    text = f"e(a, b). e(b, c). e(c, a). p(X, Y, _) :- e(X, Y). {rule}"
    assert {a["Y"] for a in answers(text, "p(a, Y, 1)")} == {"a", "b", "c"}
    assert not KnowledgeBase.from_text(text).ask("p(a, d, 1)")


def test_the_same_variable_twice_in_a_head_and_the_occurs_check():
    assert answers("same(X, X, _).", "same(A, f(A), 1)") == []
    assert answers("same(X, X, _).", "same(f(A), f(b), 1)") == [{"A": "b"}]
    assert answers("grow([X | T], X, T).", "grow(L, L, T)") == []


def test_a_reversed_list_is_found_without_nesting_in_python():
    table = clauses_of("rev([], A, A). rev([H | T], A, R) :- rev(T, [H | A], R).")
    goal = Literal(Compound(("rev", make_list(range(20_000)), "[]", Variable("R"))))
    (found,) = Search({}, table).solve([goal])
    assert list_items(found[Variable("R")])[0][:2] == [19_999, 19_998]


def test_what_is_bound_after_a_choice_is_undone():
    table = clauses_of("p(X, Y) :- q(X), r(X, Y). q(1). q(2). q(3). r(1, a). r(3, Z) :- s(Z). s(b). s(c). r(3, d).")
    (body,) = read_query("p(X, Y)")
    found = [tuple(s[v] for v in body[0].variables()) for s in Search({}, table).solve(body)]
    assert found == [(1, "a"), (3, "b"), (3, "c"), (3, "d")]


def test_an_undefined_answer_is_neither_given_nor_kept_quiet():
    table = clauses_of("p(X) :- n(X), \\+ q(X). q(X) :- n(X), \\+ p(X). n(a). p(b).")
    (body,) = read_query("p(X)")
    found = Search({}, table).solve(body)
    assert [next(found)[Variable("X")]] == ["b"]
    with pytest.raises(Undefined):
        next(found)
