"""The search: which condition comes next, what it answers, and where it stops."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, ProgramError
from casper.kb.terms.terms import Variable
from casper.kb.text.reader import read_query
from casper.kb.top_down.plain import PlainSolver
from casper.kb.top_down.solve import BETWEEN_LOOKS, DEFAULT_BUDGET, next_ready

X, Y = Variable("X"), Variable("Y")


def body(text):
    (found,) = read_query(text)
    return found


@pytest.mark.parametrize(
    ("text", "bindings", "at"),
    [
        ("p(X), q(X)", {}, 0),
        ("X < 3, p(X)", {}, 1),
        ("X < 3, p(X)", {X: 1}, 0),
        ("\\+ p(X), q(X)", {}, 1),
        ("\\+ p(X), q(X)", {X: "a"}, 0),
        ("\\+ p(_), q(X)", {}, 0),
        ("X = Y, p(X)", {}, 0),
        ("\\+ X = Y, p(X)", {}, 1),
        ("X is Y + 1, p(Y)", {}, 1),
        ("X is Y + 1, p(Y)", {Y: 1}, 0),
        ("X == Y", {X: 1}, None),
        ("X < Y", {Y: 1}, None),
        ("X < Y", {X: 1}, None),
    ],
)
def test_the_next_condition_is_the_first_that_can_be_decided(text, bindings, at):
    assert next_ready(body(text), bindings) == at


CHAIN = "p0(a, _). " + " ".join(f"p{n + 1}(X, Y) :- p{n}(X, Y)." for n in range(200))


@pytest.mark.parametrize("depth", [10, 149])
def test_a_chain_of_rules_is_followed(depth):
    assert KnowledgeBase.from_text(CHAIN).ask(f"p{depth}(a, b)")


def test_a_longer_chain_is_unknown_to_plain_resolution_which_says_how_long():
    base, (conditions,) = KnowledgeBase.from_text(CHAIN), read_query("p200(a, b)")
    with pytest.raises(BudgetExceeded, match="stopped after 150 levels of rules: the answer is unknown"):
        list(plain(base).solve(conditions))
    assert base.ask("p200(a, b)")


def plain(base, budget=DEFAULT_BUDGET):
    solver = base.solver()
    return PlainSolver(solver.relations, solver.clauses, solver.computed, budget)


def test_a_search_of_as_many_steps_as_its_budget_is_answered():
    kb = KnowledgeBase.from_text("d(1). d(2).")
    (conditions,) = read_query("d(A), d(B), A + B > 5")
    solver = plain(kb)
    assert list(solver.solve(conditions)) == []
    assert solver.steps == 1 + 2 + 4
    assert list(plain(kb, 7).solve(conditions)) == []
    with pytest.raises(BudgetExceeded, match="stopped after 6 steps"):
        list(plain(kb, 6).solve(conditions))


def test_a_search_that_is_cancelled_or_late_is_unknown():
    kb = KnowledgeBase.from_text("d(1). d(2). d(3). d(4). d(5).")
    goal = "d(A), d(B), d(C), d(D), A + B + C + D > 100"
    with pytest.raises(BudgetExceeded, match="was cancelled: the answer is unknown"):
        list(kb.query(goal, cancelled=lambda: True))
    with pytest.raises(BudgetExceeded, match="when its time was up: the answer is unknown"):
        list(kb.query(goal, timeout=-1.0))
    assert list(kb.query(goal, cancelled=lambda: False, timeout=1e9)) == []


def test_a_search_looks_up_now_and_then():
    kb, asked = KnowledgeBase.from_text("d(1). d(2). d(3). d(4). d(5)."), []
    (conditions,) = read_query("d(A), d(B), d(C), A + B + C > 100")
    solver = plain(kb)
    solver.cancelled = lambda: bool(asked.append(solver.steps))
    list(solver.solve(conditions))
    assert asked == list(range(BETWEEN_LOOKS, solver.steps + 1, BETWEEN_LOOKS)) != []


def test_answers_keep_the_names_of_who_asks():
    kb = KnowledgeBase.from_text("p(X, Y) :- q(X). q(a).")
    assert [str(answer) for answer in kb.instances("p(A, B)")] == ["p(a, B)"]


def test_a_condition_that_nothing_binds_is_told_as_it_was_written():
    with pytest.raises(ProgramError, match=r"X < 3 cannot be decided: bind its variables by a condition before it"):
        list(KnowledgeBase.from_text("p(a).").query("X < 3"))


def test_in_constraints_an_undecided_condition_breaks_nothing():
    kb = KnowledgeBase.from_text('n(1). age(X, Y) :- n(X). go(X) :- n(X). never("old") :- claim(go(X)), age(X, Y), Y > 3.')
    assert kb.verify("go(1)").valid is True
