"""The plot of the robustness table: a panel a quantity, right goals and finished help against it, with intervals."""

from collections.abc import Mapping, Sequence
from typing import Any

from sensors import ALONE, DEFAULT, FAMILIES, Family

from casper.experiments.figures.style import OTHERS, canvas
from casper.experiments.statistics import share_interval

SHOWN = (("right", "right goal", "o", 9, 0), ("helped", "help finished", "s", 4, 1))  # size in points, colour


def figure(rows: Sequence[Mapping[str, Any]]) -> Any:
    """Panels of all quantities, and one of what sensors have several at once.

    Args:
        rows: of each sensor its name (``row``), and how many ``trials`` were ``right`` and ``helped``.
    """
    drawn = canvas(10, 4.6)
    panels = list(drawn.subplots(2, 4, sharey=True).flat)
    counts = {row["row"]: row for row in rows}
    for axes, family in zip(panels, FAMILIES):
        _panel(axes, family, counts)
    both, legend, *_ = panels[len(FAMILIES) :]
    _points(both, [(at, counts[each.name]) for at, each in enumerate(ALONE) if each.name in counts], line=False)
    both.set_xticks([0, 1], ["own", "cheap"])
    both.set_xlim(-0.5, 1.5)
    both.set_title("all at once", fontsize=9, loc="left")
    legend.axis("off")
    legend.legend(*both.get_legend_handles_labels(), loc="center", frameon=False)
    for axes in panels[::4]:
        axes.set_ylabel("share of trials")
    panels[0].set_ylim(0.0, 1.06)
    return drawn


def _panel(axes: Any, family: Family, counts: Mapping[str, Mapping[str, Any]]) -> None:
    points = [(sensor.value, counts[sensor.name]) for sensor in family.rows if sensor.name in counts]
    if DEFAULT in counts:
        points.append((family.own, counts[DEFAULT]))
    _points(axes, sorted(points, key=lambda point: point[0]), line=True)
    axes.axvline(family.own, color="#cccccc", linewidth=1, zorder=0)
    if family.own > family.rows[-1].value:  # the less the poorer
        axes.invert_xaxis()
    axes.set_title(f"{family.quantity} ({family.unit})", fontsize=9, loc="left")


def _points(axes: Any, points: Sequence[tuple[float, Mapping[str, Any]]], line: bool) -> None:
    for name, label, marker, size, colour in SHOWN:
        shares = [row[name] / row["trials"] for _, row in points]
        ends = [share_interval(row[name], row["trials"]) for _, row in points]
        low = [max(share - end[0], 0.0) for share, end in zip(shares, ends)]
        high = [max(end[1] - share, 0.0) for share, end in zip(shares, ends)]
        style = {"linestyle": "-" if line else "none", "linewidth": 1.2, "capsize": size / 2}
        style |= {"marker": marker, "markersize": size, "fillstyle": "none" if size > 5 else "full"}
        axes.errorbar([x for x, _ in points], shares, [low, high], color=OTHERS[colour], label=label, **style)
