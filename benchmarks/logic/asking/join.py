"""Two relations joined, every answer: as columns, as Python rows, and as SWI-Prolog enumerates and delivers them."""

from collections.abc import Iterator
from functools import partial
from typing import Any

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Found, Rows, Sizes, attempt, fingerprint, per_call
from ..peers import prolog
from ..peers.engines import Program, loaded

TITLE = "A join, every answer"
TIMED = (
    "`r(X, Y), s(Y, Z)`, warm, indexes built. casper: `table` gives numpy arrays, `query` a dictionary an answer. "
    "SWI-Prolog enumerates the compiled goal in its own process, and beside it collects all answers into one list."
)
GOAL = "r(X, Y), s(Y, Z)"
TASK = GOAL + " at {rows:,} rows each"
COLUMNS, ROWS = f"{OURS} columns", f"{OURS} rows"
COLLECTED = "swipl, one list"


def tables(size: int) -> dict[str, Rows]:
    """As many answers as rows: half of the keys of s are met, each twice."""
    return {"r": [(at, at % max(1, size // 2)) for at in range(size)], "s": [(at, at + 1) for at in range(size)]}


def measure(sizes: Sizes) -> Found:
    """By both, with every answer compared."""
    task, program = TASK.format(rows=sizes.join), Program(tables(sizes.join), (), ())
    kb = loaded(program)
    kb.compile()
    seconds, table = per_call(lambda: kb.table(GOAL, budget=10**9), sizes=sizes)
    yield Figure(task, COLUMNS, seconds, fingerprint(zip(*(_values(table.columns[name]) for name in "XYZ"))))
    seconds, found = per_call(lambda: list(kb.query(GOAL, budget=10**9)), sizes=sizes)
    yield Figure(task, ROWS, seconds, fingerprint(answer.values() for answer in found))
    del found, table
    text = program.text()
    yield attempt(task, "swipl", partial(prolog.enumerated, text, GOAL, list("XYZ"), sizes))
    collected = f"findall(X-Y-Z, ({GOAL}), L), L = [_ | _]"
    yield attempt(task, COLLECTED, partial(prolog.enumerated, text, collected, list("XYZ"), sizes, query=GOAL))


def _values(column: Any) -> list[Any]:
    return column.tolist() if hasattr(column, "tolist") else list(column)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Columns are faster than SWI-Prolog enumerates, Python rows take at most five times as long."""
    task = TASK.format(rows=sizes.join)
    for engine, bound in ((COLUMNS, 1), (ROWS, 5)):
        value = (
            amounts[task, engine] / amounts[task, "swipl"]
            if {(task, engine), (task, "swipl")} <= amounts.keys()
            else None
        )
        yield Bound(f"{task}: {engine.removeprefix(OURS).strip()}, against SWI-Prolog enumerating", value, bound, "×")
