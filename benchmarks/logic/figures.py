"""What a benchmark yields, how time is taken, and the sizes of a run.

Every figure is a median of repeated runs after an untimed warm-up. Garbage is collected before each figure.
The collector stays on while programs are derived (its users have it on), and is off in loops over queries.
"""

import gc
import statistics
import time
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias
from zlib import crc32

Row: TypeAlias = tuple[str | int, ...]
Rows: TypeAlias = list[Row]
OURS = "casper"
CONTROL = "run(1, True, eq(1, 1))"


@dataclass(frozen=True, slots=True)
class Figure:
    """One engine's seconds on one task, with its answers: they must be equal within the task."""

    task: str
    engine: str
    seconds: float
    answers: Hashable = None  # None: nothing to compare


@dataclass(frozen=True, slots=True)
class Skipped:
    """A measurement that did not take place, and why."""

    task: str
    engine: str
    reason: str


@dataclass(frozen=True, slots=True)
class Sizes:
    """How large the tasks of a run are, and how often they are repeated."""

    rows: tuple[int, ...] = (100, 1_000, 10_000, 100_000)
    random_graph: tuple[int, int] = (1_000, 2_000)  # nodes, edges
    chain: int = 1_000
    cycle: int = 500
    ontology: float = 1.0
    updates: int = 200
    repeats: int = 3  # of a run of milliseconds and more
    loops: int = 5  # of as many calls of microseconds as fit into so many seconds:
    loop_seconds: float = 0.02
    patience: float = 3.0  # seconds: a query that is expected to take longer is left out
    limit: float = 60.0  # seconds for one peer's process


FULL = Sizes()
TINY = Sizes((30,), (12, 20), 10, 8, 0.01, updates=4, repeats=1, loops=1, loop_seconds=0.0005, limit=30.0)


def per_call(function: Callable[..., Any], *args: Any, sizes: Sizes) -> tuple[float, Any]:
    """Median seconds of one call, over runs that each fill a loop's seconds; and what the call returns."""
    gc.collect()
    began = time.perf_counter()
    result = function(*args)
    if (first := time.perf_counter() - began) > 2:
        return first, result  # too slow for warmth to matter
    gc.disable()
    once = _seconds(function, args, 1)
    number = max(1, int(sizes.loop_seconds / max(once, 1e-8)))
    runs = sizes.loops if once < 0.1 else min(sizes.loops, 3)
    times = [once] if once > 0.5 else [_seconds(function, args, number) for _ in range(runs)]
    gc.enable()
    return statistics.median(times), result


def _seconds(function: Callable[..., Any], args: tuple[Any, ...], number: int) -> float:
    began = time.perf_counter()
    for _ in range(number):
        function(*args)
    return (time.perf_counter() - began) / number


def timed(function: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of one call after a collection, and its result."""
    gc.collect()
    began = time.perf_counter()
    result = function()
    return time.perf_counter() - began, result


def fingerprint(rows: Iterable[Iterable[Any]]) -> tuple[int, int]:
    """How many rows there are, and a sum over them that does not depend on their order."""
    count = total = 0
    for row in rows:
        count += 1
        total += crc32(" ".join(map(str, row)).encode())
    return count, total
