"""Counts and sums by group: ``aggregate_all`` over a relation, one result a group."""

from collections.abc import Iterator
from functools import partial
from typing import Any

from ..bounds import Bound
from ..figures import OURS, Amounts, Figure, Found, Rows, Sizes, attempt, fingerprint, repeated
from ..peers import prolog
from ..peers.engines import grounded_rows, stated

TITLE = "Counts and sums by group"
TIMED = (
    "Rows are loaded; timed is one result for every group (casper: `compile` and every row of `total`; SWI-Prolog: the "
    "same clause, asked for all groups; clingo: grounding `#count` and `#sum`)."
)
COUNTED, SUMMED = "count by group", "sum by group"
AGGREGATES = {  # by task: the aggregate in Prolog's spelling, and in clingo's
    COUNTED: ("aggregate_all(count, has(G, _, _), N)", "N = #count { X : has(G, X, _) }"),
    SUMMED: ("aggregate_all(sum(W), has(G, _, W), N)", "N = #sum { W, X : has(G, X, W) }"),
}


def tasks(sizes: Sizes) -> dict[str, tuple[str, str]]:
    """The clause of each task in Prolog's spelling and in clingo's."""
    groups, rows = sizes.groups
    return {
        f"{task}, {groups:,} groups, {rows:,} rows": tuple(f"total(G, N) :- group(G), {way}.\n" for way in ways)  # type: ignore[misc]
        for task, ways in AGGREGATES.items()
    }


def tables(sizes: Sizes) -> dict[str, Rows]:
    """The groups, and rows ``has(group, item, weight)``."""
    groups, rows = sizes.groups
    return {"group": [(at,) for at in range(groups)], "has": [(at * 7 % groups, at, at % 10) for at in range(rows)]}


def measure(sizes: Sizes) -> Found:
    """Both by every engine."""
    facts = tables(sizes)
    given = "".join(f"{name}({','.join(map(str, row))}).\n" for name, rows in facts.items() for row in rows)
    for task, (ours, clingo) in tasks(sizes).items():
        bases = iter([stated(facts, ours) for _ in range(sizes.repeats)])
        seconds, found = repeated(lambda b=bases: _totals(next(b)), sizes)  # type: ignore[misc]
        yield Figure(task, OURS, seconds, fingerprint(found))
        yield attempt(task, "swipl", partial(prolog.enumerated, given + ours, "total(G, N)", ["G", "N"], sizes))
        yield attempt(task, "clingo", partial(grounded_rows, given + clingo, "total", 2))


def _totals(kb: Any) -> list[Any]:
    kb.compile()
    return list(kb.rows("total", 2))


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """None: these figures are there to be known."""
    yield from ()
