"""Trials as experiments ask for them: goals in turn, a seed each; rows as tables have them."""

from __future__ import annotations

from collections.abc import Mapping
from statistics import mean
from typing import Any

from casper.experiments.experiment import Asked, Row, Trial
from casper.sim_adapter.room.scene import BODY


def trials_of(asked: Asked, usual: int, **how: Any) -> list[Trial]:
    """So many trials, goals in turn; of a larger number the first are those of a smaller one.

    Args:
        asked: whose goals, how many, the first seed, and the robot's body.
        usual: how many where no number is asked for.
        how: further settings of each.
    """
    goals = list(asked.domain.library.goals)
    how |= {} if asked.body == BODY else {"body": asked.body}
    return [{"goal": goals[at % len(goals)], "seed": asked.seed + at, **how} for at in range(asked.count(usual))]


def flat(found: Mapping[str, Any]) -> Row:
    """A trial's row as a table has it: its settings as columns before what became of it."""
    settings = dict(found["trial"])
    changed = settings.pop("settings", None) or {}
    rest = {name: value for name, value in found.items() if name != "trial"}
    return {**settings, **changed, **rest}


def counted(rows: list[Row]) -> Row:
    """What is counted of the trials of a condition (rows as `flat` has them); one that broke off is neither right
    nor helped."""
    times = [row["prediction_time"] for row in rows if row["right"]]
    near = [row["least_distance"] for row in rows if row["least_distance"] is not None]
    return {
        "trials": len(rows),
        "right": sum(bool(row["right"]) for row in rows),
        "helped": sum(bool(row["helped"]) for row in rows),
        "help ended": sum(bool(row["help_ended"]) for row in rows),
        "wrong announcements": sum(row["wrong_announcements"] or 0 for row in rows),
        "wrong interventions": sum(len(row["wrong_interventions"] or ()) for row in rows),
        "broken off": sum(bool(row["mistake"]) for row in rows),
        "known at": mean(times) if times else None,
        "least distance": min(near, default=None),
    }
