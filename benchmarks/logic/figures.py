"""What a benchmark yields, how time is taken, and the sizes of a run.

Every figure is a median of repeated runs after an untimed warm-up. Garbage is collected before each figure.
The collector stays on while programs are derived (its users have it on), and is off in loops over queries.
"""

import gc
import os
import statistics
import time
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias
from zlib import crc32

from casper.kb.top_down.solve import DEFAULT_BUDGET

Row: TypeAlias = tuple[str | int, ...]
Rows: TypeAlias = list[Row]
OURS = "casper"
CONTROL = "run(1, True, eq(1, 1))"
LONG = 5.0  # seconds: what takes longer is not repeated
CLOCK = "LOGIC_BENCHMARK_CLOCK"  # in the environment, so that processes that are started know it
PROCESSOR = "cpu"


@dataclass(frozen=True, slots=True)
class Figure:
    """What one engine took for one task, with its answers: they must be equal within the task.

    ``unit`` is ``"s"`` for seconds, or what else was counted (``"bytes"``, ``"inferences/s"``, ``"of 5"``).
    """

    task: str
    engine: str
    amount: float
    answers: Hashable = None  # None: nothing to compare
    unit: str = "s"


@dataclass(frozen=True, slots=True)
class Skipped:
    """A measurement that did not take place, and why."""

    task: str
    engine: str
    reason: str


Found: TypeAlias = Iterator[Figure | Skipped]
Amounts: TypeAlias = Mapping[tuple[str, str], float]  # by (task, engine)


@dataclass(frozen=True, slots=True)
class Sizes:
    """How large the tasks of a run are, and how often they are repeated."""

    rows: tuple[int, ...] = (100, 1_000, 10_000, 100_000)
    random_graph: tuple[int, int] = (1_000, 2_000)  # nodes, edges
    chain: int = 1_000
    cycle: int = 500
    ontology: float = 1.0
    updates: int = 200
    join: int = 100_000  # rows of each relation
    python_rows: int = 10_000  # rows that go from Prolog to Python
    bound: int = 1_000_000  # rows behind a bound question
    side: int = 10_000  # of a product
    games: int = 100_000  # moves
    groups: tuple[int, int] = (1_000, 100_000)  # groups, rows
    weighted: tuple[int, int] = (1_000, 10_000)  # nodes, weighted edges
    nrev: tuple[int, ...] = (400, 4_000)  # lengths
    tak: tuple[int, int, int] = (18, 12, 6)
    queens: int = 8
    length: int = 100_000  # of a list
    splits: int = 1_000  # ways to take a list apart
    chained: int = 10_000  # rules
    facts: int = 300_000  # of a text
    triples: float = 0.25  # the ontology's share that is read as RDF,
    closed: float = 0.02  # and the one that owlrl closes
    memory: int = 1 << 30  # bytes of the process in which something derives without end,
    steps: int = DEFAULT_BUDGET  # and the limit within which it stops
    thorough: bool = True  # the tests of what is promised of meaning, on as many examples as promised
    repeats: int = 3  # of a run of milliseconds and more
    loops: int = 5  # of as many calls of microseconds as fit into so many seconds:
    loop_seconds: float = 0.02
    patience: float = 3.0  # seconds: a query that is expected to take longer is left out
    limit: float = 45.0  # seconds for one peer's process


FULL = Sizes()
TINY = Sizes(
    rows=(30,),
    random_graph=(12, 20),
    chain=10,
    cycle=8,
    ontology=0.01,
    updates=4,
    join=60,
    python_rows=20,
    bound=200,
    side=20,
    games=60,
    groups=(4, 40),
    weighted=(10, 30),
    nrev=(5, 20),
    tak=(4, 2, 1),
    queens=4,
    length=50,
    splits=10,
    chained=30,
    facts=200,
    triples=0.01,
    closed=0.001,
    steps=5_000,
    thorough=False,
    repeats=1,
    loops=1,
    loop_seconds=0.0005,
    limit=30.0,
)


def clock() -> str:
    """``"wall"``, or ``"cpu"`` where time that other processes of a busy machine take is not to count."""
    return os.environ.get(CLOCK, "wall")


def now() -> float:
    """Seconds on the clock that was chosen."""
    return time.process_time() if clock() == PROCESSOR else time.perf_counter()


def per_call(function: Callable[..., Any], *args: Any, sizes: Sizes) -> tuple[float, Any]:
    """Median seconds of one call, over runs that each fill a loop's seconds; and what the call returns."""
    gc.collect()
    began = now()
    result = function(*args)
    if (first := now() - began) > 2:
        return first, result  # too slow for warmth to matter
    gc.disable()
    try:
        once = _seconds(function, args, 1)
        number = max(1, int(sizes.loop_seconds / max(once, 1e-8)))
        runs = sizes.loops if once < 0.1 else min(sizes.loops, 3)
        times = [once] if once > 0.5 else [_seconds(function, args, number) for _ in range(runs)]
    finally:
        gc.enable()
    return statistics.median(times), result


def _seconds(function: Callable[..., Any], args: tuple[Any, ...], number: int) -> float:
    began = now()
    for _ in range(number):
        function(*args)
    return (now() - began) / number


def timed(function: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of one call after a collection, and its result."""
    gc.collect()
    began = now()
    result = function()
    return now() - began, result


def repeated(function: Callable[[], Any], sizes: Sizes) -> tuple[float, Any]:
    """Median seconds of a call that takes milliseconds and more, and its last result; one of long is made once."""
    runs = [timed(function)]
    while len(runs) < sizes.repeats and runs[0][0] < LONG:
        runs.append(timed(function))
    return statistics.median(seconds for seconds, _ in runs), runs[-1][1]


def attempt(task: str, engine: str, work: Callable[[], tuple[float, Hashable] | str]) -> Figure | Skipped:
    """A peer's figure; or its reason for giving none, a failure among them: one peer must not end the run."""
    try:
        found = work()
    except TimeoutError as late:
        return Skipped(task, engine, str(late))
    except Exception as mistake:
        lines = str(mistake).strip().splitlines() or [""]
        return Skipped(task, engine, f"it failed: {type(mistake).__name__}: {lines[0][:200]}")
    return Skipped(task, engine, found) if isinstance(found, str) else Figure(task, engine, *found)


def fingerprint(rows: Iterable[Iterable[Any]]) -> tuple[int, int]:
    """How many rows there are, and a sum over them that does not depend on their order."""
    count = total = 0
    for row in rows:
        count += 1
        total += crc32(" ".join(map(str, row)).encode())
    return count, total
