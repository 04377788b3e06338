"""Many trials with the default partner: right goals, finished help, wrong interventions, each with its interval."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, Trial, table
from casper.experiments.statistics import share_interval
from casper.experiments.trials import counted, flat, trials_of

TRIALS = 3000
ALL = "all"
HEADER = (
    "goal",
    "trials",
    "right goals",
    "help finished",
    "wrong announcements",
    "wrong interventions",
    "broken off",
    "known at (s)",
)


def trials(asked: Asked) -> list[Trial]:
    """Goals in turn."""
    return trials_of(asked, TRIALS)


def work(asked: Asked, ran: Ran) -> Data:
    """A row a goal, and one for all."""
    rows = [flat(row) for row in ran(trials(asked))]
    goals = [*dict.fromkeys(row["goal"] for row in rows), ALL]
    summary = [{"goal": goal, **counted([row for row in rows if goal in (row["goal"], ALL)])} for goal in goals]
    failed = [row for row in rows if not is_good(row)]
    return Data("many", {"trials": len(rows), **asked.first}, summary, rows, {"failed": failed})


def is_good(row: Row) -> bool:
    """Whether everything went well in a trial."""
    return bool(row["right"] and row["helped"]) and not row["wrong_interventions"]


def says(data: Data) -> Iterator[str]:
    """The table, and every trial in which something went wrong."""
    yield table(HEADER, (_cells(row) for row in data.summary))
    yield (
        f"Seeds from {data.about['first seed']} on, goals in turn, the kitchen as it is; in brackets Wilson's 95 % "
        "interval. A wrong announcement is a goal that was told and that the partner never had; a wrong intervention "
        "is something the robot did, or began, that is no step of theirs."
    )
    failed = data.facts["failed"]
    if failed:
        yield "What went wrong:"
        yield "\n".join(f"- {_told(row)}" for row in failed[:20])
        if len(failed) > 20:
            yield f"… and {len(failed) - 20} more, in `many.csv`."


def _cells(row: Row) -> tuple[Any, ...]:
    shares = [_share(row[name], row["trials"]) for name in ("right", "helped")]
    wrong = [row[name] for name in ("wrong announcements", "wrong interventions", "broken off")]
    return (row["goal"], row["trials"], *shares, *wrong, None if row["known at"] is None else f"{row['known at']:.1f}")


def _share(hits: int, count: int) -> str:
    if not count:
        return "–"
    low, high = share_interval(hits, count)
    return f"{hits / count:.2%} ({low:.2%} to {high:.2%})"


def _told(row: Row) -> str:
    """What went wrong in a trial, in a line."""
    if row["mistake"]:
        return f"{row['goal']}, seed {row['seed']}: {row['mistake']}"
    parts = [
        "" if row["right"] else f"read as {row['predicted'] or 'nothing'}",
        "" if row["helped"] else f"help not finished ({row['gave_up'] or 'the robot’s turn never came'})",
        f"the robot did {', '.join(row['wrong_interventions'])}" if row["wrong_interventions"] else "",
    ]
    return f"{row['goal']}, seed {row['seed']}: {', '.join(part for part in parts if part)}"


MANY = Experiment("many", "many trials with the default partner", "", work, says, {}, trials)
