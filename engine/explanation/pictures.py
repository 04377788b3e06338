"""Pictures of explanation trees, with the paper's conventions (figure "score").

An observed action is filled, a missed one textured, an unobserved one dashed; one that was passed over, or that may be
done instead of what is expected, is dotted. A task looks as its actions do. matplotlib is imported when a picture is
drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from casper.engine.explanation.explanation import Explanation
from casper.kb.errors import CasperError
from casper.kb.text.files import check_writable
from casper.plans.trees.tree import MARKS

if TYPE_CHECKING:
    import networkx as nx

_MISSING = "pictures need matplotlib: pip install 'casper-hri[plot]'"
UNDATED: dict[str, dict[str, None]] = {".svg": {"Date": None}, ".png": {}, ".pdf": {"CreationDate": None}}
FORMATS = tuple(UNDATED)
STYLES: dict[str, dict[str, Any]] = {
    "observed": {"facecolor": "#9ecae1", "edgecolor": "#1f4e79"},
    "missed": {"facecolor": "white", "edgecolor": "#8c2d04", "hatch": "////"},
    "unobserved": {"facecolor": "white", "edgecolor": "#555555", "linestyle": "dashed"},
    "skipped": {"facecolor": "white", "edgecolor": "#bbbbbb", "linestyle": "dotted"},
    "alternative": {"facecolor": "#f7f7f7", "edgecolor": "#999999", "linestyle": "dotted"},
}
_WIDTH, _HEIGHT = 1.9, 1.05  # inches a leaf and a row take


def positions(tree: nx.DiGraph) -> dict[int, tuple[float, float]]:
    """Where to draw each node: leaves side by side from x = 0, a task above the middle of what it is done by; y is
    minus the depth."""
    places: dict[int, tuple[float, float]] = {}
    leaves = 0

    def place(node: int, depth: int) -> float:
        nonlocal leaves
        below = [place(child, depth + 1) for child in tree.successors(node)]
        if below:
            x = (below[0] + below[-1]) / 2
        else:
            x, leaves = float(leaves), leaves + 1
        places[node] = (x, -float(depth))
        return x

    place(0, 0)
    return places


def check_picture(path: str | Path) -> None:
    """Refuse a file that no picture can be written to, before anything is worked out.

    Raises:
        CasperError: an ending that is no format, no such folder, a place where writing is not allowed, no matplotlib.
    """
    path = Path(path)
    if path.suffix.lower() not in FORMATS:
        raise CasperError(f"a picture is written as {', '.join(FORMATS)}, not as {path.suffix or path.name!r}")
    check_writable(path)
    if find_spec("matplotlib") is None:
        raise CasperError(_MISSING)


def save_picture(explanations: Sequence[Explanation], path: str | Path) -> None:
    """Draw explanations one below the other into a file; its ending says the format (svg, png or pdf).

    The same explanations give the same bytes.

    Raises:
        CasperError: nothing to draw, or as `check_picture`.
    """
    check_picture(path)
    if not explanations:
        raise CasperError("there is no explanation to draw: the observations fit no plan")
    figure = _figure(explanations)
    from matplotlib import rc_context

    try:
        with rc_context({"svg.hashsalt": "casper"}):
            figure.savefig(path, bbox_inches="tight", dpi=150, metadata=UNDATED[Path(path).suffix.lower()])
    except OSError as mistake:
        raise CasperError(f"cannot write {path} ({mistake.strerror or mistake})") from None


def _figure(explanations: Sequence[Explanation]) -> Any:
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise CasperError(_MISSING) from None
    trees = [(explanation, explanation.tree()) for explanation in explanations]
    places = [positions(tree) for _, tree in trees]
    rows = [1 - min(y for _, y in found.values()) for found in places]
    widest = max(max(x for x, _ in found.values()) for found in places) + 1
    figure = Figure(figsize=(widest * _WIDTH, sum(rows) * _HEIGHT + 0.5 * len(rows)))
    FigureCanvasAgg(figure)
    axes = figure.subplots(len(trees), 1, squeeze=False, gridspec_kw={"height_ratios": rows})[:, 0]
    for axis, (explanation, tree), found in zip(axes, trees, places):
        axis.set_title(f"score {explanation.score:.3f}, share {explanation.share:.2f}", fontsize=9, loc="left")
        axis.set_xlim(-0.6, widest - 0.4)
        axis.set_ylim(min(y for _, y in found.values()) - 0.5, 0.5)
        axis.axis("off")
        draw_tree(axis, tree, found)
    return figure


def draw_tree(axis: Any, tree: nx.DiGraph, places: dict[int, tuple[float, float]]) -> None:
    """Draw a marked tree (`casper.plans.trees.tree`) on axes of matplotlib, its nodes at those places."""
    from matplotlib.patches import FancyBboxPatch

    for above, below in tree.edges:
        (x0, y0), (x1, y1) = places[above], places[below]
        axis.plot([x0, x1], [y0 - 0.22, y1 + 0.22], color="#999999", linewidth=0.8, zorder=1)
    for node, data in tree.nodes(data=True):
        x, y = places[node]
        style = STYLES[data["status"]]
        corner = (x - 0.42, y - 0.2)
        box = FancyBboxPatch(corner, 0.84, 0.4, boxstyle="round,pad=0.02", linewidth=1.2, zorder=2, **style)
        box.set_gid(f"{data['kind']} {data['term']}: {data['status']}")
        axis.add_patch(box)
        mark = f"{MARKS[data['status']]} " if data["kind"] == "action" else ""
        text = _wrapped(f"{mark}{'or ' if data['rival'] else ''}{data['term']}")
        plain = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}
        shown = plain if data["status"] == "missed" else None  # letters on a texture are hard to read
        options = {"ha": "center", "va": "center", "fontsize": 6.5, "zorder": 3, "bbox": shown}
        axis.text(x, y, text, parse_math=False, **options)  # two dollar signs in a name are no formula


def _wrapped(text: str, width: int = 22) -> str:
    if len(text) <= width:
        return text
    return text.replace("(", "(\n", 1) if "(" in text[:width] else text[:width] + "\n" + text[width:]
