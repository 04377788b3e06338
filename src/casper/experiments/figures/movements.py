"""The movement tree as it decides, and what is taken for what."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from casper.experiments.experiment import Data
from casper.experiments.figures.style import OTHERS, canvas

FEATURES = ("MOS", "HOLD", "QDC", "QTC")
Allowed = Sequence[Sequence[str]]


@dataclass(frozen=True, slots=True)
class Fork:
    """A question of the tree, or a leaf: where it is drawn, what it asks, what hangs from it."""

    x: float
    text: str
    samples: int
    label: str | None
    below: tuple[Fork, ...] = ()


def forks(leaves: Sequence[dict[str, Any]], first: int = 0) -> Fork:
    """The tree whose leaves these are: where the ways part is told by the values that both sides allow.

    ``leaves`` are from left to right, so each question splits them in two runs, which differ in one feature.
    """
    if len(leaves) == 1:
        leaf = leaves[0]
        return Fork(float(first), f"{leaf['label'].upper()}\n{leaf['samples']}", leaf["samples"], leaf["label"])
    cut, feature = next(
        (at, number)
        for at in range(1, len(leaves))
        for number in range(len(FEATURES))
        if not _union(leaves[:at], number) & _union(leaves[at:], number)
    )
    left, right = forks(leaves[:cut], first), forks(leaves[cut:], first + cut)
    values = [value for leaf in leaves[:cut] for value in leaf["allowed"][feature]]
    text = f"{FEATURES[feature]} is\n{' or '.join(dict.fromkeys(values))}?"
    return Fork((left.x + right.x) / 2, text, left.samples + right.samples, None, (left, right))


def _union(leaves: Sequence[dict[str, Any]], feature: int) -> set[str]:
    return {value for leaf in leaves for value in leaf["allowed"][feature]}


def tree_figure(data: Data) -> Any:
    """The learned tree (figure "decision_tree"): a question a node, yes to the left; samples under each movement."""
    root = forks(data.facts["tree"])
    depth = _depth(root)
    figure = canvas(1.75 * len(data.facts["tree"]), 1.15 * depth)
    axis = figure.subplots()
    axis.axis("off")
    axis.set_xlim(-0.6, len(data.facts["tree"]) - 0.4)
    axis.set_ylim(-depth + 0.5, 0.5)
    colours = {name: OTHERS[at] for at, name in enumerate(data.facts["counts"])}
    _draw(axis, root, 0, colours)
    return figure


def _depth(fork: Fork) -> int:
    return 1 + max(map(_depth, fork.below), default=0)


def _draw(axis: Any, fork: Fork, y: int, colours: dict[str, str]) -> None:
    for below, answer in zip(fork.below, ("yes", "no")):
        axis.plot([fork.x, below.x], [y, y - 1], color="#999999", linewidth=1, zorder=1)
        between = (fork.x + below.x) / 2, y - 0.5
        axis.text(*between, answer, fontsize=7, ha="center", va="center", backgroundcolor="white")
        _draw(axis, below, y - 1, colours)
    edge = "#444444" if fork.label is None else colours.get(fork.label, "#444444")
    width = 1 if fork.label is None else 2
    box = {"boxstyle": "round,pad=0.4", "facecolor": "white", "edgecolor": edge, "linewidth": width}
    axis.text(fork.x, y, fork.text, fontsize=8, ha="center", va="center", bbox=box, zorder=2)


def confusion_figure(data: Data) -> Any:
    """What each movement was taken for, in the cross-validation: shares of a row, with the counts."""
    table = data.facts["confusion"]
    names = [name for name in data.facts["counts"] if name in table]
    figure = canvas(4.2, 3.6)
    axis = figure.subplots()
    shares = [[table[true].get(seen, 0) / max(sum(table[true].values()), 1) for seen in names] for true in names]
    axis.imshow(shares, cmap="Blues", vmin=0, vmax=1)
    for y, true in enumerate(names):
        for x, seen in enumerate(names):
            colour = "white" if shares[y][x] > 0.5 else "black"
            axis.text(x, y, table[true].get(seen, 0), ha="center", va="center", color=colour, fontsize=8)
    axis.set_xticks(range(len(names)), names, rotation=30, ha="right")
    axis.set_yticks(range(len(names)), names)
    axis.set_xlabel("taken for")
    axis.set_ylabel("movement of the script")
    axis.set_title(f"one trial left out: {data.summary[0]['accuracy']:.3f} right", fontsize=9, loc="left")
    return figure
