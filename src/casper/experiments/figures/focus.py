"""The room from above with the partner's path, and a plot of the focus at each object (figure "focus_evolution")."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import OTHERS, canvas

WIDTH, HEIGHT = 1.15, 0.62  # metres of the room that a small plot takes
STEP = 0.1  # metres between places that are tried for it
AROUND = 1.2  # metres around the walls
Spot = tuple[float, float]


def focus_figure(data: Data) -> Any:
    """The map; time runs through the path's colours, and along each small plot."""
    room, path = data.facts["room"], data.facts["path"]
    xs, ys = zip(*room["outline"])
    low, high = (min(xs) - AROUND, min(ys) - 0.1), (max(xs) + AROUND, max(ys) + AROUND)
    width, height = high[0] - low[0], high[1] - low[1]
    figure = canvas(1.45 * width, 1.45 * height)
    axis = figure.subplots()
    axis.set_xlim(low[0], high[0])
    axis.set_ylim(low[1], high[1])
    axis.set_aspect("equal")
    axis.axis("off")
    _room(axis, room)
    _path(axis, path)
    last = max(row["t"] for row in data.rows)
    walked = [(row["x"], row["y"]) for row in path]
    places = spread({name: (at[0], at[1]) for name, at in room["things"].items()}, walked, low, high)
    for at, (name, corner) in enumerate(places.items()):
        x, y = room["things"][name]
        axis.plot([x, corner[0] + WIDTH / 2], [y, corner[1] + HEIGHT / 2], color="#bbbbbb", linewidth=0.8, zorder=3)
        axis.plot([x], [y], "o", color=OTHERS[at % len(OTHERS)], markersize=6, zorder=6)
        inset = axis.inset_axes((*corner, WIDTH, HEIGHT), transform=axis.transData, zorder=5)
        _curve(inset, [row for row in data.rows if row["object"] == name], name, OTHERS[at % len(OTHERS)], last)
        inset.axhline(data.facts["threshold"], color="#888888", linewidth=0.6, linestyle=":")
    title = f"{data.about['goal']}, seed {data.about['seed']}: shares of the focus over {last:.0f} s"
    axis.set_title(title, fontsize=9, loc="left")
    return figure


def spread(
    things: Mapping[str, Spot], path: Sequence[Spot], low: tuple[float, float], high: tuple[float, float]
) -> dict[str, Spot]:
    """The lower left corner of each object's plot: near it, where it hides no other one and little of the path.

    Args:
        things, path: places on the floor (metres).
        low, high: corners of the picture.
    """
    taken: dict[str, Spot] = {}
    across = [low[0] + STEP * at for at in range(int((high[0] - low[0] - WIDTH) / STEP) + 1)]
    along = [low[1] + STEP * at for at in range(int((high[1] - low[1] - HEIGHT) / STEP) + 1)]
    for name, spot in things.items():
        free = [(x, y) for x in across for y in along if _is_free((x, y), taken, things)]
        taken[name] = min(free, key=lambda corner: _cost(corner, spot, path), default=(spot[0], spot[1]))
    return taken


def _cost(corner: Spot, spot: Spot, path: Sequence[Spot]) -> float:
    away = math.dist((corner[0] + WIDTH / 2, corner[1] + HEIGHT / 2), spot[:2])
    hidden = sum(_covers(corner, at, 0.05) for at in path)
    return away + min(hidden, 20) * 0.15


def _is_free(corner: Spot, taken: Mapping[str, Spot], things: Mapping[str, Spot]) -> bool:
    apart = all(abs(corner[0] - x) >= WIDTH + 0.25 or abs(corner[1] - y) >= HEIGHT + 0.3 for x, y in taken.values())
    return apart and not any(_covers(corner, at, 0.12) for at in things.values())


def _covers(corner: Spot, at: Spot, margin: float) -> bool:
    right, above = at[0] - corner[0], at[1] - corner[1]
    return -margin <= right <= WIDTH + margin and -margin <= above <= HEIGHT + 0.1 + margin


def _room(axis: Any, room: dict[str, Any]) -> None:
    from matplotlib.patches import Polygon, Rectangle

    walls: dict[str, Any] = {"facecolor": "#faf9f6", "edgecolor": "#444444", "linewidth": 1.5, "zorder": 0}
    axis.add_patch(Polygon(room["outline"], closed=True, **walls))
    for x0, y0, x1, y1 in room["furniture"].values():
        axis.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="#e5e2da", edgecolor="#b5b0a4", zorder=1))


def _path(axis: Any, path: list[dict[str, Any]]) -> None:
    from matplotlib.collections import LineCollection

    spots = [(row["x"], row["y"]) for row in path]
    parts = LineCollection(list(pairwise(spots)), cmap="viridis", linewidths=2, zorder=2)
    parts.set_array([row["t"] for row in path[1:]])
    axis.add_collection(parts)
    axis.plot(*spots[0], marker="s", color="black", markersize=5, zorder=4)
    axis.annotate("start", spots[0], (5, -9), textcoords="offset points", fontsize=7, zorder=4)
    moved = 0.0
    for (x0, y0), (x1, y1) in pairwise(spots):
        moved += math.hypot(x1 - x0, y1 - y0)
        if moved > 0.9 and math.hypot(x1 - x0, y1 - y0) > 0.1:
            axis.annotate("", (x1, y1), (x0, y0), arrowprops={"arrowstyle": "->", "color": "#333333"}, zorder=4)
            moved = 0.0


def _curve(inset: Any, rows: list[dict[str, Any]], name: str, colour: str, last: float) -> None:
    times = [row["t"] for row in rows if row["share"] is not None]
    shares = [row["share"] for row in rows if row["share"] is not None]
    inset.fill_between(times, shares, color=colour, alpha=0.35, linewidth=0)
    inset.plot(times, shares, color=colour, linewidth=1)
    inset.set_xlim(0, last)
    inset.set_ylim(0, 1)
    inset.set_xticks([0, round(last)])
    inset.set_yticks([0, 1])
    inset.tick_params(labelsize=5.5, length=2, pad=1)
    inset.patch.set_alpha(0.9)
    inset.set_title(name, fontsize=7, pad=2)
