"""Marked plan trees as pictures, with the paper's conventions: observed filled, missed textured, unobserved dashed.

A row a node, a task before what it is done by, as in the text (`casper.plans.trees.tree`); one that was passed over, or
that may be done instead of what is expected, is dotted.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from casper.notebook.markup import Markup, joined, tag
from casper.notebook.pictures import picture, wide
from casper.plans.trees.tree import MARKS

if TYPE_CHECKING:
    import networkx as nx

ROW, STEP, HIGH = 27, 26, 20  # pixels: a row, what a level is further to the right, a box
_HATCH = tag(
    "pattern",
    tag("rect", width=6, height=6, fill="var(--bad)", fill_opacity=0.13),
    tag("line", x1=0, y1=0, x2=0, y2=6, stroke="var(--bad)", stroke_opacity=0.5, stroke_width=2),
    id="casper-missed", width=6, height=6, patternUnits="userSpaceOnUse", patternTransform="rotate(45)",
)  # fmt: skip
STYLES: dict[str, dict[str, object]] = {
    "observed": {"fill": "var(--share)", "fill_opacity": 0.3, "stroke": "var(--share)"},
    "missed": {"fill": "url(#casper-missed)", "stroke": "var(--bad)"},
    "unobserved": {"fill": "none", "stroke": "var(--faint)", "stroke_dasharray": "4 3"},
    "skipped": {"fill": "none", "stroke": "var(--rule)", "stroke_dasharray": "1 3"},
    "alternative": {"fill": "var(--soft)", "stroke": "var(--faint)", "stroke_dasharray": "1 3"},
}


def tree_svg(tree: nx.DiGraph) -> Markup:
    """A marked tree as a picture. Each box has its kind, what it is and its status as its title."""
    depths, labels = _depths(tree), {node: _label(data) for node, data in tree.nodes(data=True)}
    rows = {node: row for row, node in enumerate(depths)}
    boxes = [_box(node, rows[node], depths[node], labels[node], tree.nodes[node]) for node in rows]
    width = max(depths[node] * STEP + wide(labels[node]) + 16 for node in rows) + 2
    return picture(width, len(rows) * ROW, tag("defs", _HATCH), joined(_edges(tree, rows, depths)), *boxes)


def _depths(tree: nx.DiGraph) -> dict[int, int]:
    """How deep each node lies, in the order of the rows."""
    depths: dict[int, int] = {}
    waiting = [(0, 0)]
    while waiting:
        node, depth = waiting.pop()
        depths[node] = depth
        waiting.extend((child, depth + 1) for child in reversed(list(tree.successors(node))))
    return depths


def _label(data: dict[str, object]) -> str:
    mark = f"{MARKS[str(data['status'])]} " if data["kind"] == "action" else ""
    by = f" by {data['by']}" if data.get("by") is not None else ""
    return f"{mark}{'or ' if data['rival'] else ''}{data['term']}{by}"


def _edges(tree: nx.DiGraph, rows: dict[int, int], depths: dict[int, int]) -> Iterator[Markup]:
    for above, below in tree.edges:
        x, y = depths[above] * STEP + 12, rows[above] * ROW + HIGH + 2
        path = f"M{x} {y}V{rows[below] * ROW + HIGH // 2 + 2}H{depths[below] * STEP + 1}"
        yield tag("path", d=path, fill="none", stroke="var(--rule)")


def _box(node: int, row: int, depth: int, label: str, data: dict[str, object]) -> Markup:
    x, y, kind, status = depth * STEP + 1, row * ROW + 2, data["kind"], str(data["status"])
    style = STYLES[status] if kind == "action" else {**STYLES[status], "fill_opacity": 0.12}
    return tag(
        "g",
        tag("title", f"{kind} {data['term']}: {status}"),
        tag("rect", x=x, y=y, width=round(wide(label)) + 14, height=HIGH, rx=4, **style),
        tag("text", label, x=x + 7, y=y + 14, fill="currentColor"),
        class_=f"{kind} {status}",
    )
