"""The picture of growth: log-log panels, each line with its name at its end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import log10
from typing import Any, TypeAlias

Points: TypeAlias = dict[str, list[tuple[int, float]]]  # by line: where, and seconds
Results: TypeAlias = Sequence[tuple[str, str, Points]]  # title, axis, lines

COLOURS = {  # told apart with any eyesight
    "tree copies": "#888888",
    "plain list": "#000000",
    "chains": "#b87a00",
    "arrays": "#0072b2",
    "noisy arrays": "#3a9bd4",
    "interleaving": "#c44e00",
    "pairs": "#00805c",
}
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "axes.titlesize": 7.5,
    "axes.labelsize": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "svg.hashsalt": "growth",
}
COLUMNS = 3
ROOM = 0.36  # for names, as a share of the width that the lines take
LEAST, MOST = 1e-6, 2.0  # seconds
APART = 0.36  # of a power of ten: names do not stand closer


def draw(results: Results, file: str) -> None:
    """One panel for each thing that grows, all with the same scale of times."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    with plt.rc_context(STYLE):
        rows = -(-len(results) // COLUMNS)
        figure, axes = plt.subplots(rows, COLUMNS, figsize=(3.1 * COLUMNS, 2.7 * rows), sharey=True)
        for axis, (title, what, lines) in zip(axes.flat, results):
            panel(axis, title, what, {name: sorted(points) for name, points in lines.items() if points})
        for axis in axes[:, 0]:
            axis.set_ylabel("time of an observation")
        figure.tight_layout(w_pad=1.0, h_pad=1.5)
        figure.savefig(file, dpi=200, metadata={"Date": None} if file.endswith(".svg") else None)


def panel(axis: Any, title: str, what: str, lines: Points) -> None:
    """What grows runs to the right, time upwards, both by powers of ten."""
    axis.set_xscale("log")
    axis.set_yscale("log")
    for name, points in lines.items():
        axis.plot(*zip(*points), color=COLOURS[name], linewidth=1.1, marker="o", markersize=2.2)
    axis.set_title(title, loc="left")
    axis.set_xlabel(what)
    axis.grid(alpha=0.25, linewidth=0.4)
    ticks(axis, {at for points in lines.values() for at, _ in points})
    name_lines(axis, lines)


def ticks(axis: Any, places: Iterable[int]) -> None:
    """Whole numbers along what grows, times in their own units, and room for the names."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    left, *_, right = ordered = sorted(places)
    shown = [at for at in ordered if right / left < 100 or log10(at).is_integer()]
    axis.xaxis.set_major_locator(FixedLocator(shown))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda at, _: f"{at / 1_000:,.0f}k" if at >= 10_000 else f"{at:,.0f}"))
    axis.yaxis.set_major_locator(FixedLocator([10.0**power for power in range(-6, 1)]))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda seconds, _: duration(seconds)))
    for each in (axis.xaxis, axis.yaxis):
        each.set_minor_locator(NullLocator())
    axis.set_xlim(left / (right / left) ** 0.04, right * (right / left) ** ROOM)
    axis.set_ylim(LEAST, MOST)


def duration(seconds: float) -> str:
    """10 µs, 1 ms, 1 s."""
    unit, size = next(((u, s) for u, s in (("s", 1.0), ("ms", 1e-3)) if seconds >= 0.999 * s), ("µs", 1e-6))
    return f"{seconds / size:,.0f} {unit}"


def name_lines(axis: Any, lines: Points) -> None:
    """Names beside the ends of lines, those of the longest moved apart where they would cover one another."""
    right = max(points[-1][0] for points in lines.values())
    ends = sorted((log10(points[-1][1]), name) for name, points in lines.items() if points[-1][0] == right)
    for height, (_, name) in zip(apart([height for height, _ in ends]), ends):
        write(axis, name, right, 10**height, (4, 0), "left")
    shorter = {name: points[-1] for name, points in lines.items() if points[-1][0] < right}
    places = {name: axis.transAxes.inverted().transform(axis.transData.transform(end)) for name, end in shorter.items()}
    for name, (at, seconds) in shorter.items():
        x, y = places[name]
        is_free = x > 0.35 and not any(0 < x - left < 0.35 and abs(y - level) < 0.1 for left, level in places.values())
        write(axis, name, at, seconds, (-4, 2) if is_free else (4, 2), "right" if is_free else "left")


def write(axis: Any, name: str, at: float, seconds: float, offset: tuple[int, int], side: str) -> None:
    """A name at so many points from a place."""
    axis.annotate(name, (at, seconds), offset, textcoords="offset points", color=COLOURS[name], ha=side, va="center")


def apart(heights: Sequence[float]) -> list[float]:
    """The heights, from the lowest, moved as little as keeps them apart: what is too close shares a middle."""
    groups: list[list[float]] = []  # of heights that stand in a row
    for height in heights:
        groups.append([height])
        while len(groups) > 1 and bottom(groups[-1]) - bottom(groups[-2]) < APART * len(groups[-2]):
            groups[-2:] = [groups[-2] + groups[-1]]
    return [bottom(group) + APART * at for group in groups for at in range(len(group))]


def bottom(group: Sequence[float]) -> float:
    """The lowest place of a row around the middle of what it stands for."""
    return sum(group) / len(group) - APART * (len(group) - 1) / 2
