"""Programs that Prolog is known by: naive reverse, Takeuchi's function, queens on a board.

Each is one text that casper and SWI-Prolog read alike, without a cut.
"""

from collections.abc import Iterator
from functools import partial
from typing import Any

from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound, list_items

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, fingerprint, per_call
from ..peers import prolog

TITLE = "Programs"
TIMED = (
    "One query, all its answers, warm: casper's `query`, SWI-Prolog in its own process. nrev reverses a list of n with "
    "(n + 1)(n + 2) / 2 inferences; tak is Takeuchi's function as three-fold recursion; queens lists every solution."
)
TEXT = r"""
nrev([], []).
nrev([H | T], R) :- nrev(T, S), app(S, [H], R).
app([], L, L).
app([H | T], L, [H | R]) :- app(T, L, R).
numbers(N, N, [N]).
numbers(M, N, [M | Ns]) :- M < N, M1 is M + 1, numbers(M1, N, Ns).
reversed(N, R) :- numbers(1, N, L), nrev(L, R).

tak(X, Y, Z, Z) :- X =< Y.
tak(X, Y, Z, A) :- X > Y, X1 is X - 1, Y1 is Y - 1, Z1 is Z - 1,
    tak(X1, Y, Z, A1), tak(Y1, Z, X, A2), tak(Z1, X, Y, A3), tak(A1, A2, A3, A).

queens(N, Qs) :- numbers(1, N, Ns), place(Ns, [], Qs).
place([], Qs, Qs).
place([U | Us], Safe, Qs) :- select(Q, [U | Us], Rest), safe(Q, 1, Safe), place(Rest, [Q | Safe], Qs).
safe(_, _, []).
safe(Q, D, [P | Ps]) :- Q =\= P + D, Q =\= P - D, E is D + 1, safe(Q, E, Ps).
"""
NREV = "nrev of {size:,}"
A_SECOND = 200_000  # inferences


def goals(sizes: Sizes) -> dict[str, str]:
    """Every query by its task; what it asks for is R."""
    found = {NREV.format(size=size): f"reversed({size}, R)" for size in sizes.nrev}
    found[f"tak{sizes.tak}"] = f"tak({', '.join(map(str, sizes.tak))}, R)"
    found[f"queens on a board of {sizes.queens}, every solution"] = f"queens({sizes.queens}, R)"
    return found


def measure(sizes: Sizes) -> Found:
    """Every program by both."""
    kb = KnowledgeBase.from_text(TEXT)
    for task, goal in goals(sizes).items():
        seconds, found = per_call(lambda g=goal: list(kb.query(g, budget=10**9)), sizes=sizes)
        yield Figure(task, OURS, seconds, fingerprint(_row(answer["R"]) for answer in found))
        yield attempt(task, "swipl", partial(_prolog, goal, sizes))


def _row(value: Any) -> Iterator[Any]:
    """A number, or the elements of a list."""
    return iter(list_items(value)[0] if isinstance(value, Compound) else [value])


def _prolog(goal: str, sizes: Sizes) -> tuple[float, tuple[int, int]] | str:
    query = f"{goal}, (is_list(R) -> atomic_list_concat(R, ' ', A) ; A = R)"
    return prolog.enumerated(TEXT, goal, ["A"], sizes, query=query)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Inferences a second, and that a step of a long list costs what one of a short list does."""
    rates = [
        (size + 1) * (size + 2) / 2 / seconds
        for size in sizes.nrev
        if (seconds := amounts.get((NREV.format(size=size), OURS))) is not None
    ]
    short, long = rates if len(rates) == 2 else (None, None)
    one, other = (NREV.format(size=size) for size in sizes.nrev)
    yield Bound(one, short, A_SECOND, "inferences/s", at_least=True)
    slower = None if short is None or long is None else short / long
    yield Bound(f"{other}: a step, against one of {one} (a tenth is noise)", slower, 1.1, "×")
