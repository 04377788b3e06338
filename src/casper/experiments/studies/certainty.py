"""One knob: how sure a goal must be before the robot acts on it, help against announcements that come to nothing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, Trial, table
from casper.experiments.figures.certainty import certainty_figure
from casper.experiments.studies.conditions import FACTORS
from casper.experiments.trials import counted, flat, trials_of
from casper.sim_adapter.partners.behaviours.table import MIXED

TRIALS = 30
VALUES = (0.0, 0.5, 0.9, 0.98, 0.995)
"""With actions recognised at .9 these ask for one, one, two, three and four of them (`engine.collaboration.acting`)."""
HARD = FACTORS["partner"][MIXED]
"""Who is watched: of a plain partner hardly anything is ever announced in vain."""


def trials(asked: Asked) -> list[Trial]:
    """The same seeds for each value."""
    return [trial for value in VALUES for trial in trials_of(asked, TRIALS, certainty=value, **HARD.trial)]


def work(asked: Asked, ran: Ran) -> Data:
    """A row a value."""
    rows = [flat(row) for row in ran(trials(asked))]
    summary = [_row(value, [row for row in rows if row["certainty"] == value]) for value in VALUES]
    about = {"trials a value": asked.count(TRIALS), **asked.first, "partner": MIXED}
    return Data("certainty", about, summary, rows)


def _row(value: float, rows: list[Row]) -> Row:
    withdrawn = sum(row["withdrawn"] or 0 for row in rows)
    told = {"certainty": value, **counted(rows), "withdrawn": withdrawn}
    return {**told, "came to nothing": told["wrong announcements"] + withdrawn}


def says(data: Data) -> Iterator[str]:
    """The rule, and its trade-off."""
    yield (
        "The rule: a goal is as sure as its posterior times the probability that at least one of the actions that "
        "speak for it was really one for it, where an action that was recognised with probability p counts as 0.9 p "
        "(one action of ten serves nothing), weighed against what must have gone unseen (0.3 each) and another goal "
        "that must have been given up for it (0.1). Below `setting(collaboration, certainty, P)`, or `--certainty P`, "
        "the robot announces nothing and does nothing: by default below 0.5; at 0, the paper's, it acts on whatever "
        "the policy commits to."
    )
    header = ("certainty", "trials", "right goals", "help finished", "wrong announcements", "withdrawn", "known at (s)")
    yield table(header, map(_cells, data.summary))
    yield "An announcement comes to nothing when its goal was never the partner's, or when it is withdrawn."


def _cells(row: Row) -> tuple[Any, ...]:
    n, known = row["trials"], row["known at"]
    shares = [f"{row[name]}/{n}" for name in ("right", "helped")]
    told = (row["wrong announcements"], row["withdrawn"], None if known is None else f"{known:.1f}")
    return (f"{row['certainty']:g}", n, *shares, *told)


CERTAINTY = Experiment(
    "certainty",
    "the knob: help against announcements that come to nothing",
    "",
    work,
    says,
    {"certainty": certainty_figure},
    trials,
)
