"""A program that derives without end stops within its limits, in a process that may hold one gigabyte."""

import subprocess
import sys

import pytest

PROLOGUE = """
import resource
resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded
try:
    base = KnowledgeBase.from_text(TEXT)
    for _ in base.query(GOAL, **MORE):
        pass
except BudgetExceeded as reason:
    print("unknown:", reason)
"""
TOP_DOWN = [
    ("nat(z). nat(s(X)) :- nat(X).", "nat(X), X = never"),
    ("grow(X, _) :- grow(f(X, X), a).", "grow(a, a)"),
    ("keep(L, X, _) :- keep([X | L], X, a).", "keep([], a, a)"),
    ("n(1). p(X, _) :- n(X).", "length(L, N), N < 0"),
    ("n(1). num(0, _). num(N, K) :- num(M, K), N is M + 1.", "num(N, 1), N < 0"),
    ("n(1). all(L, _) :- findall(X, between(1, inf, X), L).", "all(L, 1)"),
    ("win(X) :- Y is X + 1, \\+ win(Y).", "win(1)"),
]
LISTED = " ".join(f"n({i})." for i in range(400)) + " q(A, B, C, D) :- n(A), n(B), n(C), n(D)."


def ended(text: str, goal: str, **more: int) -> str:
    """What a process of one gigabyte says at the end."""
    program = f"TEXT, GOAL, MORE = {text!r}, {goal!r}, {more!r}\n{PROLOGUE}"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=570)
    assert done.returncode == 0, done.stderr[-2_000:]
    return done.stdout


@pytest.mark.parametrize(("text", "goal"), TOP_DOWN)
def test_a_search_without_end_stops_after_its_steps(text, goal):
    assert "the answer is unknown" in ended(text, goal)


def test_a_search_that_may_take_any_number_of_steps_stops_at_the_memory_it_may_hold():
    told = ended("keep(L, X, _) :- keep([X, X, X, X, X, X, X, X | L], X, a).", "keep([], Open, a)", budget=10**12)
    assert "the answer is unknown" in told


def test_listing_without_end_stops_at_the_memory_there_is():
    assert "unknown" in ended(LISTED, "n(1)")
