"""Win-move games: a position is won when a move leads to one that is not; in a circle of moves it may be drawn.

Two graphs of as many moves: one with circles, which has drawn (undefined) positions, and one without.
"""

import importlib.util
from collections.abc import Iterator
from functools import partial
from random import Random
from typing import Any

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, against
from ..figures import OURS, Amounts, Figure, Found, Rows, Sizes, Skipped, attempt, fingerprint, repeated, timed
from ..peers import prolog
from ..peers.engines import NO_CLINGO, stated

TITLE = "Games"
TIMED = (
    "Moves and the rule `win(X) :- move(X, Y), \\+ win(Y)` are loaded; timed is deriving every position that is won or "
    "drawn (casper: `compile`; SWI-Prolog: one tabled query with `tnot`; clingo: grounding and solving, on the graph "
    "without circles, where its one stable model is the well-founded one). Compared are the positions with their truth."
)
RULE = "win(X) :- move(X, Y), \\+ win(Y).\n"
IN_PROLOG = ":- table win/1.\nwin(X) :- move(X, Y), tnot(win(Y)).\n"
IN_CLINGO = "win(X) :- move(X, Y), not win(Y).\n"
CIRCLES, NONE = "{moves:,} moves with circles", "{moves:,} moves without circles"


def graphs(sizes: Sizes) -> dict[str, Rows]:
    """The moves of each graph, by the task's name: each position has about two moves."""
    random, positions = Random(3), max(3, sizes.games // 2)
    free = dict.fromkeys((random.randrange(positions), random.randrange(positions)) for _ in range(sizes.games))
    down = dict.fromkeys(tuple(sorted(random.sample(range(positions), 2))) for _ in range(sizes.games))
    return {CIRCLES.format(moves=sizes.games): list(free), NONE.format(moves=sizes.games): list(down)}


def measure(sizes: Sizes) -> Found:
    """Both graphs by every engine that can."""
    for task, moves in graphs(sizes).items():
        yield attempt_ours(task, moves, sizes)
        text = "".join(f"move({x},{y}).\n" for x, y in moves) + IN_PROLOG
        query = "call_delays(win(X), D), (D == true -> T = true ; T = undefined)"
        yield attempt(task, "swipl", partial(prolog.enumerated, text, "win(_)", ["X", "T"], sizes, query=query))
        if task == CIRCLES.format(moves=sizes.games):
            yield Skipped(task, "clingo", "it enumerates stable models, which circles of moves may not have")
        else:
            yield attempt(task, "clingo", partial(_clingo, moves))


def attempt_ours(task: str, moves: Rows, sizes: Sizes) -> Figure:
    """The game derived as often as the sizes say, each time from a base that has not derived anything."""
    bases = iter([stated({"move": moves}, RULE) for _ in range(sizes.repeats)])
    seconds, kb = repeated(lambda: _derived(next(bases)), sizes)
    return Figure(task, OURS, seconds, fingerprint(positions(kb)))


def _derived(kb: KnowledgeBase) -> KnowledgeBase:
    kb.compile()
    assert kb.stored(("win", 1)) is not None
    return kb


def positions(kb: KnowledgeBase) -> Iterator[tuple[Any, str]]:
    """Every position that is won or drawn, with its truth."""
    relation = kb.stored(("win", 1))
    assert relation is not None
    yield from ((x, "true") for (x,) in relation)
    yield from ((x, "undefined") for (x,) in relation.undefined or ())


def _clingo(moves: Rows) -> tuple[float, tuple[int, int]] | str:
    if importlib.util.find_spec("clingo") is None:
        return NO_CLINGO
    from clingo import Control

    control = Control(["-Wnone"])
    control.add("base", [], "".join(f"move({x},{y}).\n" for x, y in moves) + IN_CLINGO)
    found: list[tuple[Any, str]] = []

    def solved() -> None:
        control.ground([("base", [])])
        control.solve(
            on_model=lambda model: found.extend(
                (a.arguments[0], "true") for a in model.symbols(atoms=True) if a.name == "win"
            )
        )

    seconds, _ = timed(solved)
    return seconds, fingerprint(found)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Faster than SWI-Prolog."""
    yield from (against(amounts, task, "swipl") for task in graphs(sizes))
