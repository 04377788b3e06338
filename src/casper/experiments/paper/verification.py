"""Verification against none: the same seeds with and without the knowledge base, pair by pair."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict
from statistics import mean
from typing import Any

from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, Trial, table
from casper.experiments.figures.verification import verification_figure
from casper.experiments.printed import VERIFIED
from casper.experiments.statistics import paired
from casper.experiments.trials import trials_of

TRIALS = 15
ALL = "all"
HEADER = (
    "goal",
    "pairs",
    "paper: with / without",
    "with (s)",
    "without (s)",
    "earlier by (s)",
    "95 %",
    "p",
    "right: with / without",
)
KEPT = ("right", "helped", "observed", "prediction_time", "wrong_announcements")


def trials(asked: Asked) -> list[Trial]:
    """Each seed twice."""
    return [{**trial, **how} for trial in trials_of(asked, TRIALS) for how in ({}, {"verification": False})]


def work(asked: Asked, ran: Ran) -> Data:
    """Times to the prediction of the right goal, in pairs."""
    found = ran(trials(asked))
    rows = [_pair(verified, other) for verified, other in zip(found[::2], found[1::2])]
    goals = list(dict.fromkeys(row["goal"] for row in rows))
    summary = [_row(goal, [row for row in rows if goal in (row["goal"], ALL)]) for goal in (*goals, ALL)]
    return Data("verification", {"pairs": len(rows), **asked.first}, summary, rows)


def _pair(verified: Mapping[str, Any], other: Mapping[str, Any]) -> Row:
    told = {"goal": verified["trial"]["goal"], "seed": verified["trial"]["seed"]}
    for name, row in (("verified", verified), ("not", other)):
        told |= {f"{name} {key}": row[key] for key in KEPT}
    return told


def _row(goal: str, rows: list[Row]) -> Row:
    """Times are compared where both read the goal in the end."""
    both = [row for row in rows if row["verified right"] and row["not right"]]
    found = paired([row["not prediction_time"] for row in both], [row["verified prediction_time"] for row in both])
    told: Row = {"goal": goal, "trials": len(rows), **asdict(found)}
    for name in ("verified", "not"):
        told[f"{name} time"] = mean(row[f"{name} prediction_time"] for row in both) if both else None
        told[f"{name} right"] = mean(bool(row[f"{name} right"]) for row in rows)
        told[f"{name} wrong announcements"] = sum(row[f"{name} wrong_announcements"] or 0 for row in rows)
    return told


def says(data: Data) -> Iterator[str]:
    """Both times, the difference with its interval and its test, and whether the paper's claim holds."""
    yield table(HEADER, map(_cells, data.summary))
    yield verdict(data.summary[-1])
    yield (
        "Seconds to the prediction that was held in the end, the same seeds with and without the knowledge base. The "
        "interval is the bootstrap's of the mean difference, p that of exchanging the two of each pair (two-sided)."
    )


def verdict(row: Row) -> str:
    """Whether verification predicts earlier, by the interval over all goals; and why."""
    if row["low"] is None:
        return "**Not decided:** there is no pair of trials in which both read the goal."
    if row["low"] > 0:
        return (
            f"**Verification predicts earlier**, by {row['mean']:.1f} s on average. With it an action is known with "
            "what it is about, and what cannot be is refused before it is read; without it the reading has names "
            "only, so the first pick and place fits every goal, and the next action has to decide."
        )
    if row["high"] < 0:
        return (
            f"**Verification predicts later here**, by {-row['mean']:.1f} s on average: statements that are refused "
            "cost the time until the next is made out, and names alone decided as soon."
        )
    return (
        "**No difference is shown:** the interval holds 0. The trials are too few, or the first action decides with "
        "and without the knowledge base."
    )


def _cells(row: Row) -> tuple[Any, ...]:
    printed = VERIFIED.get(row["goal"])
    told = None if printed is None else f"{printed[0]} / {printed[1]}"
    one = [None if row[name] is None else f"{row[name]:.1f}" for name in ("verified time", "not time", "mean")]
    interval = None if row["low"] is None else f"{row['low']:.1f} to {row['high']:.1f}"
    p = None if row["p"] is None else f"{row['p']:.2g}"
    right = f"{row['verified right']:.0%} / {row['not right']:.0%}"
    return (row["goal"], row["pairs"], told, *one, interval, p, right)


VERIFICATION = Experiment(
    "verification",
    "verification against none, on paired seeds",
    'figure "comparison"',
    work,
    says,
    {"verification": verification_figure},
    trials,
)
