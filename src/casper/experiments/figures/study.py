"""The study as rows of points: what each condition does to goals, times, help and distances."""

from __future__ import annotations

from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import OTHERS, canvas

COLUMNS = (
    ("right", "right goals (share)", True),
    ("helped", "help finished (share)", True),
    ("known at", "goal known at (s)", False),
    ("saved", "seconds saved", False),
)


def study_figure(data: Data) -> Any:
    """A row a condition, a column a measure; the line is how the kitchen is."""
    names = [row["condition"] for row in data.summary]
    figure = canvas(10, 0.32 * len(names) + 1.1)
    axes = figure.subplots(1, len(COLUMNS), sharey=True)
    for axis, (name, title, is_share) in zip(axes, COLUMNS):
        values = [_value(row, name, is_share) for row in data.summary]
        if values[0] is not None:
            axis.axvline(values[0], color="#cccccc", linewidth=1)
        for y, (row, value) in enumerate(zip(data.summary, values)):
            if value is None:
                continue
            if name == "saved":
                axis.plot([row["saved low"], row["saved high"]], [y, y], color=OTHERS[0], linewidth=1.5)
            axis.plot([value], [y], "o", color=OTHERS[0], markersize=5)
        axis.set_title(title, fontsize=9, loc="left")
        if is_share:
            axis.set_xlim(-0.05, 1.05)
    axes[0].set_yticks(range(len(names)), names)
    axes[0].invert_yaxis()
    return figure


def _value(row: dict[str, Any], name: str, is_share: bool) -> float | None:
    if is_share:
        return float(row[name]) / row["trials"] if row["trials"] else None
    return None if row[name] is None else float(row[name])
