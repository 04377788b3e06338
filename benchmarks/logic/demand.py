"""Asked, not listed: what one bound question costs on a large base, and lists as a program works on them.

Run ``python -m benchmarks.logic.demand`` from the project's root: one process, a line a figure.
"""

import gc
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Variable, list_items, make_list

from .kitchen import kitchen

NREV = """
nrev([], []). nrev([H | T], R) :- nrev(T, S), app(S, [H], R).
app([], L, L). app([H | T], L, [H | R]) :- app(T, L, R).
"""
X, N = Variable("X"), Variable("N")


def say(what: str, figure: float, unit: str) -> None:
    """One line of the report."""
    print(f"{what:70} {figure:12,.3f} {unit}", flush=True)


@contextmanager
def quiet() -> Iterator[None]:
    """Without the collector's pauses: what is measured is one question."""
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def seconds(work: Callable[[], Any]) -> tuple[float, Any]:
    """How long some work takes, once, and what it gives."""
    began = time.perf_counter()
    found = work()
    return time.perf_counter() - began, found


def truth() -> None:
    """A ground yes and a ground no of the kitchen."""
    kb = kitchen()
    times = {}
    for name, statement in (("yes", ("eat", "human", "biscuits", "plate")), ("no", ("eat", "tiago", "meal", "plate"))):
        kb.ask(statement)
        times[name] = min(_asking(kb, statement, 200_000) for _ in range(5))
        say(f"ask, ground {name}", times[name] * 1e6, "µs")
    say("a no against a yes", times["no"] / times["yes"], "×")
    assert len(list(kb.query("valid(S)"))) > 0
    best = min(seconds(lambda: list(kb.query("valid(S)")))[0] for _ in range(20))
    say("valid(S), all answers", best * 1e3, "ms")


def _asking(kb: KnowledgeBase, statement: tuple[str, ...], times: int) -> float:
    ask, began = kb.ask, time.perf_counter()
    for _ in range(times):
        ask(statement)
    return (time.perf_counter() - began) / times


def large(rows: int) -> None:
    """A bound question over a rule on many rows, and a fact added after it."""
    kb = KnowledgeBase()
    kb.rule("p(X, Y) :- r(X, Z), s(Z, Y)")
    pairs = [(f"a{at}", f"b{at}") for at in range(rows // 2)]
    more = [(f"b{at}", f"c{at}") for at in range(rows // 2)]
    loading, _ = seconds(lambda: (kb.facts("r", pairs), kb.facts("s", more), kb.compile()))
    say(f"loading {rows:,} rows and a rule", loading, "s")
    with quiet():
        first, answer = seconds(lambda: next(kb.query("p(a77, Y)")))
        assert answer == {"Y": "c77"}
        say("first answer to a bound question", first * 1e3, "ms")
        adding, _ = seconds(lambda: kb.assert_(("r", "new", "b5")))
        say("assert_ after it", adding * 1e3, "ms")
        assert list(kb.query("p(new, Y)")) == [{"Y": "c5"}]
        back, answers = seconds(lambda: list(kb.query("p(X, c9)")))
        assert answers == [{"X": "a9"}]
        say("the same question backwards", back * 1e3, "ms")


def product(side: int) -> None:
    """A ground question over a product that nobody should list."""
    kb = KnowledgeBase()
    kb.rule("pair(X, Y) :- n(X), m(Y)")
    kb.facts("n", [(at,) for at in range(side)])
    kb.facts("m", [(at,) for at in range(side)])
    kb.compile()
    held = sys.getallocatedblocks()
    time_, found = seconds(lambda: kb.ask(("pair", 5, side - 1)))
    assert found and not kb.ask(("pair", 5, side))
    say(f"ground question over a product of {side:,} × {side:,}", time_ * 1e3, "ms")
    say("memory it left behind", (sys.getallocatedblocks() - held) / 1e3, "thousand blocks")


def lists() -> None:
    """nrev, and the built-ins on long lists."""
    kb = KnowledgeBase.from_text(NREV)
    for size in (400, 4_000):
        solver = kb.solver(budget=10**9)
        goal = Literal(Compound(("nrev", make_list(range(size)), X)))
        time_, found = seconds(lambda: next(solver.solve([goal])))  # noqa: B023
        assert list_items(found[X])[0] == list(range(size - 1, -1, -1))
        say(f"nrev of {size}", (size + 1) * (size + 2) / 2 / time_, "inferences/s")
    whole = make_list(range(100_000))
    time_, found = seconds(lambda: next(kb.instances(Compound(("length", whole, N))))[2])
    assert found == 100_000
    say("length of a list of 100,000", time_ * 1e3, "ms")
    time_, found = seconds(lambda: sum(1 for _ in kb.instances(Compound(("member", X, whole)))))
    assert found == 100_000
    say("member of it, every answer", time_ * 1e3, "ms")
    apart = Compound(("append", X, N, make_list(range(999))))
    time_, found = seconds(lambda: sum(1 for _ in kb.instances(apart)))
    assert found == 1_000
    say("append backwards, 1,000 answers", time_ * 1e3, "ms")


def join(rows: int) -> None:
    """Two relations joined, every answer."""
    kb = KnowledgeBase()
    kb.facts("r", [(at, at % (rows // 2)) for at in range(rows)])
    kb.facts("s", [(at, at + 1) for at in range(rows)])
    kb.compile()
    list(kb.query("r(X, Y), s(Y, Z)", limit=1))
    time_, found = seconds(lambda: sum(1 for _ in kb.query("r(X, Y), s(Y, Z)", budget=10**9)))
    assert found == rows
    say(f"r(X, Y), s(Y, Z) at {rows:,} rows each, Python rows", time_ * 1e3, "ms")


def endless() -> None:
    """A program that derives without end."""
    kb = KnowledgeBase.from_text("up(X, [X | T]) :- up(f(X), T), up(T, X). nat(z). nat(s(X)) :- nat(X).")
    for goal in ("up(a, L)", "nat(X), nat(Y), X = never"):
        began = time.perf_counter()
        try:
            list(kb.query(goal, budget=10**9, timeout=20))
        except BudgetExceeded as mistake:
            say(f"{goal}: {mistake}"[:70], time.perf_counter() - began, "s")


def main() -> None:
    """Everything."""
    truth()
    product(10_000)
    large(1_000_000)
    lists()
    join(100_000)
    endless()


if __name__ == "__main__":
    main()
