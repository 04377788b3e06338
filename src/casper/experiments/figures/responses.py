"""Curves of the action machines, a column a sequence, a row a recogniser (figure "ensemble")."""

from __future__ import annotations

from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import OTHERS, canvas

MARKERS = ("o", "s", "^")


def responses_figure(data: Data) -> Any:
    """Scores over steps; a dashed line where the first winner stands."""
    kinds = list(dict.fromkeys(row["recogniser"] for row in data.rows))
    names = list(dict.fromkeys(row["sequence"] for row in data.rows))
    figure = canvas(3.4 * len(names), 2.3 * len(kinds))
    axes = figure.subplots(len(kinds), len(names), squeeze=False, sharey=True)
    for kind, line in zip(kinds, axes):
        for name, axis in zip(names, line):
            _curves(axis, [row for row in data.rows if row["recogniser"] == kind and row["sequence"] == name])
            won = next(row for row in data.summary if row["recogniser"] == kind and row["sequence"] == name)
            _labels(axis, data, kind, name, won)
    axes[0][0].legend(fontsize=7, frameon=False, loc="lower left")
    return figure


def _curves(axis: Any, rows: list[dict[str, Any]]) -> None:
    for at, action in enumerate(dict.fromkeys(row["action"] for row in rows)):
        of = [row for row in rows if row["action"] == action]
        style = {"marker": MARKERS[at % 3], "markersize": 3.5, "linewidth": 1.2, "color": OTHERS[at % len(OTHERS)]}
        axis.plot([row["step"] for row in of], [row["score"] for row in of], label=action, **style)


def _labels(axis: Any, data: Data, kind: str, name: str, won: dict[str, Any]) -> None:
    letters = data.facts["sequences"][name]
    axis.set_xticks(range(len(letters)), [f"{at}\n{letter}" for at, letter in enumerate(letters)], fontsize=5.5)
    axis.set_ylim(-0.05, 1.1)
    if won["step"] is not None:
        axis.axvline(won["step"], linestyle="--", color="#444444", linewidth=1)
        axis.text(won["step"] + 0.1, 1.04, f"{won['winner']}, step {won['step']}", fontsize=6.5, ha="left", va="bottom")
    else:
        axis.text(0.98, 0.04, "nobody wins", transform=axis.transAxes, fontsize=6.5, ha="right")
    axis.set_title(f"{name}: {kind}", fontsize=8, loc="left", pad=10)
