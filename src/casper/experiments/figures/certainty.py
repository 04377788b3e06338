"""The trade-off of the knob: finished help against announcements that come to nothing."""

from __future__ import annotations

from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import OTHERS, canvas


def certainty_figure(data: Data) -> Any:
    """A point a value, joined in their order; above, when the goal is known."""
    figure = canvas(8.5, 3.4)
    left, right = figure.subplots(1, 2)
    rows = [row for row in data.summary if row["trials"]]
    nothing = [row["came to nothing"] / row["trials"] for row in rows]
    helped = [row["helped"] / row["trials"] for row in rows]
    left.plot(nothing, helped, "-o", color=OTHERS[0])
    labels: dict[tuple[float, float], list[str]] = {}
    for x, y, row in zip(nothing, helped, rows):
        labels.setdefault((x, y), []).append(f"{row['certainty']:g}")
    for at, values in labels.items():
        left.annotate(", ".join(values), at, (5, 5), textcoords="offset points", fontsize=8)
    left.set_xlabel("announcements that came to nothing, a trial")
    left.set_ylabel("help finished (share of trials)")
    left.set_xlim(left=-0.05)
    left.set_ylim(-0.05, 1.1)
    known = [row for row in rows if row["known at"] is not None]
    right.plot([row["certainty"] for row in known], [row["known at"] for row in known], "-o", color=OTHERS[1])
    right.set_xlabel("certainty from which the robot acts")
    right.set_ylabel("goal known at (s)")
    right.set_ylim(bottom=0)
    return figure
