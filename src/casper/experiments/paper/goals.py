"""The goal reasoner's table: nine rows of actions, what each observation leaves, and how sure that is."""

from __future__ import annotations

import time
from collections.abc import Iterator
from statistics import median

from casper.engine.reading.reading import Reading
from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, table
from casper.experiments.printed import GOAL_ROWS

REPEATS = 25  # of which the median is the time an observation takes


def work(asked: Asked, ran: Ran) -> Data:
    """Read every trial of the table, without the knowledge base: its observations are names."""
    rows: list[Row] = []
    seen: list[str] = []
    for at, printed in enumerate(GOAL_ROWS):
        seen = [*(seen if at and GOAL_ROWS[at - 1].trial == printed.trial else []), printed.observation]
        reading = _read(asked, seen)
        rows.append(
            {
                "trial": printed.trial,
                "observation": printed.observation,
                "explanations": reading.count,
                "confidence": reading.confidence,
                "outcome": reading.outcome,
                "microseconds": _microseconds(asked, seen),
                "printed explanations": printed.explanations,
                "printed confidence": printed.confidence,
                "printed outcome": printed.outcome,
                "printed microseconds": printed.microseconds,
                "equal": _is_equal(reading, printed.explanations, printed.confidence, printed.outcome),
            }
        )
    equal = sum(bool(row["equal"]) for row in rows)
    summary = {"rows": len(rows), "equal": equal, "median microseconds": median(row["microseconds"] for row in rows)}
    return Data("goals", {"policy": "strict", "verification": False}, [summary], rows)


def says(data: Data) -> Iterator[str]:
    """The table with both numbers."""
    summary = data.summary[0]
    yield (
        f"Of the {summary['rows']} rows {summary['equal']} are as printed, to the printed digits: explanations, "
        "confidence and outcome."
    )
    header = ("trial", "observation", "explanations", "ours", "confidence", "ours", "outcome", "ours", "µs", "ours")
    yield table(header, (_cells(row) for row in data.rows))
    yield (
        "The printed times are multiples of a clock's tick (0.24 µs) and shorter than a call of a Python function; "
        f"they are given for completeness, and no ratio is claimed. Ours is the median of {REPEATS} readings of one "
        "further observation, its outcome and its confidence."
    )


def _cells(row: Row) -> tuple[object, ...]:
    pairs = [(row[f"printed {name}"], row[name]) for name in ("explanations", "confidence", "outcome")]
    times = (row["printed microseconds"], f"{row['microseconds']:.0f}")
    return (row["trial"], row["observation"], *(cell for pair in pairs for cell in pair), *times)


def _read(asked: Asked, seen: list[str]) -> Reading:
    reading = asked.domain.reading(policy="strict", verification=False)
    for action in seen:
        reading.observe(action)
    return reading


def _microseconds(asked: Asked, seen: list[str]) -> float:
    """What the last observation takes, with its outcome."""
    taken = []
    for _ in range(REPEATS):
        reading = _read(asked, seen[:-1])
        began = time.perf_counter()
        reading.observe(seen[-1])
        _ = reading.outcome, reading.confidence
        taken.append((time.perf_counter() - began) * 1e6)
    return round(median(taken), 1)


def _is_equal(reading: Reading, explanations: int, confidence: float, outcome: str | None) -> bool:
    close = abs(reading.confidence - confidence) <= 0.005 + 1e-9
    return reading.count == explanations and close and reading.outcome == outcome


GOALS = Experiment("goals", "what each observation leaves of the explanations", 'table "pl_results"', work, says)
