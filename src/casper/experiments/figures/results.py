"""The kitchen table as points: when each goal was known, beside the paper's mean."""

from __future__ import annotations

from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import canvas, colour


def results_figure(data: Data) -> Any:
    """Seconds to the prediction: a dot a trial, a bar the mean, a cross the paper's mean."""
    goals = [row["goal"] for row in data.summary]
    figure = canvas(6, 0.7 * len(goals) + 1)
    axis = figure.subplots()
    for y, row in enumerate(data.summary):
        of = [r for r in data.rows if r["goal"] == row["goal"] and r["prediction_time"] is not None]
        heights = [y + 0.12 * ((at % 5) - 2) for at in range(len(of))]
        dots: dict[str, Any] = {"color": colour(row["goal"], y), "alpha": 0.5, "markersize": 4}
        axis.plot([r["prediction_time"] for r in of], heights, "o", **dots)
        if row["prediction_time"] is not None:
            axis.plot([row["prediction_time"]] * 2, [y - 0.35, y + 0.35], color=colour(row["goal"], y), linewidth=2)
        if row["goal"] in data.facts["printed"]:
            axis.plot([data.facts["printed"][row["goal"]]], [y], "x", color="#444444", markersize=7)
    axis.set_yticks(range(len(goals)), goals)
    axis.set_xlim(0)
    axis.set_xlabel("seconds to the prediction (dots: trials, bar: their mean, cross: the paper's mean)")
    axis.invert_yaxis()
    return figure
