"""Robustness: partners, sensors, frame rates, walking speeds, with and without verification."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, Trial, table
from casper.experiments.figures.study import study_figure
from casper.experiments.statistics import mean_interval
from casper.experiments.studies.conditions import FACTORS, Condition, crossed, one_at_a_time, partners
from casper.experiments.trials import counted, flat

TRIALS, MANY = 30, 100
HEADER = (
    "condition",
    "trials",
    "right goals",
    "known at (s)",
    "help finished",
    "help ended",
    "wrong announcements",
    "wrong interventions",
    "least distance (m)",
    "seconds saved",
    "broken off",
)


def _experiment(
    name: str, shows: str, conditions: Callable[[], Iterable[Condition]], number: int = TRIALS
) -> Experiment:
    def trials(asked: Asked) -> list[Trial]:
        return [trial for condition in conditions() for part in _both(asked, condition, number) for trial in part]

    def work(asked: Asked, ran: Ran) -> Data:
        found = ran(trials(asked))
        rows: list[Row] = []
        for condition in conditions():
            helped, alone = (_take(found, len(part)) for part in _both(asked, condition, number))
            rows += [_row(condition, one, other) for one, other in zip(helped, alone)]
        summary = [_summary(condition, rows) for condition in conditions()]
        about = {"trials a condition": asked.count(number), **asked.first, "conditions": len(summary)}
        factors = {factor: list(levels) for factor, levels in FACTORS.items()}
        return Data(name, about, summary, rows, {"factors": factors})

    return Experiment(name, shows, "", work, says, {name: study_figure}, trials)


def _both(asked: Asked, condition: Condition, number: int) -> tuple[list[Trial], list[Trial]]:
    """The trials of a condition, and of the same partner without a robot."""
    return condition.trials(asked, number), condition.alone.trials(asked, number, robot=False)


def _take(found: list[dict[str, Any]], count: int) -> list[dict[str, Any]]:
    """The next few of what was found."""
    taken = found[:count]
    del found[:count]
    return taken


def _row(condition: Condition, helped: dict[str, Any], alone: dict[str, Any]) -> Row:
    """A trial, and how much sooner the partner was done than alone (seconds; None where either broke off)."""
    ends = alone["partner_finished"], helped["partner_finished"]
    saved = None if None in ends else round(ends[0] - ends[1], 3)
    return {"condition": condition.name, **condition.levels, **flat(helped), "saved": saved}


def _summary(condition: Condition, rows: Sequence[Row]) -> Row:
    of = [row for row in rows if row["condition"] == condition.name]
    saved = [row["saved"] for row in of if row["saved"] is not None]
    low, high = mean_interval(saved) if saved else (None, None)
    mean = sum(saved) / len(saved) if saved else None
    return {"condition": condition.name, **counted(of), "saved": mean, "saved low": low, "saved high": high}


def says(data: Data) -> Iterator[str]:
    """A row a condition."""
    yield table(HEADER, map(_cells, data.summary))
    yield (
        f"{data.about['trials a condition']} trials a condition, the same seeds in each. Help has ended when it is "
        "finished, or given up for a reason that was told. Seconds saved: how much sooner the partner is done with "
        "their own last action than the same partner without a robot (mean, 95 % interval of the bootstrap), the "
        "measure of the literature on assistance. Distances are those between a person and the robot while it moves."
    )


def _cells(row: Row) -> tuple[Any, ...]:
    n = row["trials"]
    saved = None if row["saved"] is None else f"{row['saved']:.1f} ({row['saved low']:.1f} to {row['saved high']:.1f})"
    known = None if row["known at"] is None else f"{row['known at']:.1f}"
    shares = [f"{row[name]}/{n}" for name in ("right", "helped", "help ended")]
    wrong = (row["wrong announcements"], row["wrong interventions"])
    return (row["condition"], n, shares[0], known, *shares[1:], *wrong, row["least distance"], saved, row["broken off"])


PARTNERS = _experiment("partners", "partners who behave like people, one way at a time", partners, MANY)
STUDY = _experiment("study", "robustness, one factor at a time", one_at_a_time)
CROSSED = _experiment("crossed", "robustness, every factor with every other", crossed)
