"""Pairs of trials: seconds to the prediction with and without verification."""

from __future__ import annotations

from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import canvas, colour


def verification_figure(data: Data) -> Any:
    """A line a pair; beside it how much earlier verification is, with the 95 % interval."""
    goals = [row["goal"] for row in data.summary]
    figure = canvas(8, 3.2)
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": (3, 2)})
    for at, goal in enumerate(goals[:-1]):
        for row in (r for r in data.rows if r["goal"] == goal and r["verified right"] and r["not right"]):
            times = [row["verified prediction_time"], row["not prediction_time"]]
            thin: dict[str, Any] = {"color": colour(goal, at), "alpha": 0.35, "markersize": 3, "linewidth": 0.8}
            left.plot([at - 0.2, at + 0.2], times, "-o", **thin)
        mean = data.summary[at]
        if mean["verified time"] is not None:
            left.plot([at - 0.2, at + 0.2], [mean["verified time"], mean["not time"]], color="black", linewidth=2)
    left.set_xticks(range(len(goals) - 1), [f"{goal}\nwith – without" for goal in goals[:-1]], fontsize=8)
    left.set_ylim(0)
    left.set_ylabel("seconds to the prediction")
    for y, row in enumerate(data.summary):
        if row["mean"] is not None:
            right.plot([row["low"], row["high"]], [y, y], color=colour(row["goal"], y), linewidth=2)
            right.plot([row["mean"]], [y], "o", color=colour(row["goal"], y))
    right.axvline(0, color="#444444", linewidth=0.8)
    right.set_yticks(range(len(goals)), goals)
    right.invert_yaxis()
    right.set_xlabel("seconds earlier with verification (mean, 95 %)")
    return figure
