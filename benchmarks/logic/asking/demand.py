"""Asked, not listed: what one question costs on a large base, a ground *no* beside a *yes*, a search without end."""

import gc
from collections.abc import Iterator
from functools import partial
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded

from ..bounds import Bound, quotient, within
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, now, per_call, timed
from ..peers import prolog
from ..peers.engines import Program, loaded
from ..peers.fresh import grown, limited
from .kitchen import kitchen

TITLE = "One question of a large base"
TIMED = (
    "A rule over rows that were just loaded: the first answer to a bound question, cold; a fact added after it; the "
    "question backwards. A ground question over a product of two relations, cold, with the memory of a fresh process "
    "it leaves behind. A ground yes and a ground no of the kitchen, warm. SWI-Prolog: the same text, the first call "
    "in a fresh process, which indexes the rows. A program that derives without end, in a process with limited "
    "memory."
)
RULE = "p(X, Y) :- r(X, Z), s(Z, Y)"
FIRST, ADDED, BACK = "first answer to a bound question, {rows:,} rows", "assert_ after it", "the question backwards"
PRODUCT, LEFT = "a ground question over a product of {side:,} × {side:,}", "memory that question leaves behind"
YES, NO = "ask, a ground yes", "ask, a ground no"
ENDLESS = "a program that derives without end, and how it stops"
WITHOUT_END = """
up(X, [X | T]) :- up(f(X), T), up(T, X).
nat(z).
nat(s(X)) :- nat(X).
from(N, N).
from(N, M) :- K is N + 1, from(K, M).
"""
NAMEABLE = 1 << 20  # bytes: less is not worth naming


def measure(sizes: Sizes) -> Found:
    """All of it."""
    yield from _bound(sizes)
    yield from _product(sizes)
    yield from _truth(sizes)
    yield limited(ENDLESS, partial(without_end, sizes.steps), sizes)


def _bound(sizes: Sizes) -> Found:
    half = sizes.bound // 2
    middle = half // 3
    program = Program(
        {"r": [(f"a{at}", f"b{at}") for at in range(half)], "s": [(f"b{at}", f"c{at}") for at in range(half)]},
        (RULE,),
        (),
    )
    task = FIRST.format(rows=sizes.bound)
    yield attempt(task, "swipl", partial(prolog.first, program.text(), f"p(a{middle}, X)", "X", sizes))
    kb = loaded(program)
    kb.compile()
    gc.collect()  # it stays on, as its users have it
    seconds, found = _once(lambda: next(kb.query(f"p(a{middle}, Y)")))
    yield Figure(task, OURS, seconds, found["Y"])
    seconds, _ = _once(lambda: kb.assert_(("r", "new", f"b{middle}")))
    yield Figure(ADDED, OURS, seconds)
    assert list(kb.query("p(new, Y)")) == [{"Y": f"c{middle}"}]
    seconds, found = _once(lambda: list(kb.query(f"p(X, c{middle + 1})")))
    assert found == [{"X": f"a{middle + 1}"}]
    yield Figure(BACK, OURS, seconds)


def _once(work: Any) -> tuple[float, Any]:
    began = now()
    found = work()
    return now() - began, found


def _product(sizes: Sizes) -> Found:
    task = PRODUCT.format(side=sizes.side)
    program = product(sizes.side)
    asked = f"pair(5, {sizes.side - 1}), X = 'True'"
    yield attempt(task, "swipl", partial(prolog.first, program.text(), asked, "X", sizes))
    kb = loaded(program)
    kb.compile()
    seconds, found = timed(lambda: kb.ask(("pair", 5, sizes.side - 1)))
    assert not kb.ask(("pair", 5, sizes.side))
    yield Figure(task, OURS, seconds, str(found))
    yield Figure(LEFT, OURS, grown(_kept_product, (sizes.side,), _ask_product), unit="bytes")


def product(side: int) -> Program:
    """Two relations and their product."""
    return Program(
        {"n": [(at,) for at in range(side)], "m": [(at,) for at in range(side)]}, ("pair(X, Y) :- n(X), m(Y)",), ()
    )


def _kept_product(side: int) -> KnowledgeBase:
    kb = loaded(product(side))
    kb.compile()
    return kb


def _ask_product(kb: KnowledgeBase) -> object:
    return kb.ask(("pair", 5, 6)), kb.ask(("pair", 5, 10**9))


def _truth(sizes: Sizes) -> Iterator[Figure]:
    kb = kitchen()
    for task, statement, holds in (
        (YES, ("eat", "human", "biscuits", "plate"), True),
        (NO, ("eat", "tiago", "meal", "plate"), False),
    ):
        seconds, found = per_call(kb.ask, statement, sizes=sizes)
        assert found is holds
        yield Figure(task, OURS, seconds)


def without_end(steps: int) -> str:
    """Runs in the process with limited memory: what the search says when it stops.

    Raises:
        AssertionError: it ended as if that were all.
    """
    kb = KnowledgeBase.from_text(WITHOUT_END)
    said = []
    for goal in ("up(a, L)", "nat(X), nat(Y), X = never", "from(0, X), X < 0"):
        try:
            list(kb.query(goal, budget=steps))
            raise AssertionError(f"{goal} ended")
        except BudgetExceeded as stopped:
            said.append(str(stopped))
    return "; ".join(said)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """What a question may cost."""
    yield within(amounts, FIRST.format(rows=sizes.bound), 20)
    yield within(amounts, ADDED, 1)
    yield within(amounts, PRODUCT.format(side=sizes.side), 10)
    left = amounts.get((LEFT, OURS))
    yield Bound(LEFT, None if left is None else left / 2**20, NAMEABLE / 2**20, "MiB")
    yield Bound("a ground no, against a yes", quotient(amounts, (NO, OURS), (YES, OURS)), 2, "×")
    yield within(amounts, ENDLESS, 60, "s")
