"""The machine agrees with the specification, with bottom-up evaluation and with SWI-Prolog's tabling."""

import random

from hypothesis import given
from programs import DERIVED, programs
from swipl import answers_of, needs_swipl

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import substitute
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
            found = {substitute(pattern, s).args for s in Search({}, table, budget=20_000).solve([Literal(pattern)])}
        except BudgetExceeded:
            continue  # a question may grow for ever, p(X) :- p(f(X)), where its answers do not
        assert found == set(base.rows(name, arity))


@given(programs())
def test_the_machine_and_the_specification_find_the_same(text):
    base = KnowledgeBase.from_text(text)
    table = {i: base.clauses_of(i) for i in [("b0", 1), ("b1", 2), ("b2", 2), *DERIVED.items()]}
    for name, arity in DERIVED.items():
        pattern = Literal(everything(name, arity))
        try:
            expected = {substitute(pattern.atom, s) for s in Solver({}, table, budget=2_000).solve([pattern])}
        except (BudgetExceeded, ProgramError):
            continue  # the specification has no tables
        assert {substitute(pattern.atom, s) for s in Search({}, table).solve([pattern])} == expected


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
    for solution, certain in Search({}, table).outcomes([Literal(pattern)]):
        found[certain].add(solution[Variable("X")])
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
