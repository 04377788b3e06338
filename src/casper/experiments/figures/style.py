"""What all figures share: a canvas without a screen, colours that are told apart without red and green, files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from casper.kb.errors import CasperError

GOALS = {"breakfast": "#b35806", "drink": "#2b6cb0", "lunch": "#4a7c2c"}
OTHERS = ("#2b6cb0", "#b35806", "#4a7c2c", "#7a4fa3", "#6b6b6b", "#c2410c", "#0f766e")
FORMATS = ("svg", "png")
FIXED: dict[Any, Any] = {
    "svg.hashsalt": "casper",
    "svg.fonttype": "none",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def canvas(width: float, height: float) -> Any:
    """An empty figure of that size in inches.

    Raises:
        CasperError: matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise CasperError("figures need matplotlib: pip install 'casper-hri[plot]'") from None
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def colour(name: str, at: int = 0) -> str:
    """A goal's own colour, any other by its place."""
    return GOALS.get(name, OTHERS[at % len(OTHERS)])


def save(draw: Any, data: Any, stem: Path) -> list[Path]:
    """Draw into an SVG and a PNG; the same data give the same bytes.

    Raises:
        CasperError: matplotlib is not installed, or a file cannot be written.
    """
    try:
        from matplotlib import rc_context
    except ImportError:
        raise CasperError("figures need matplotlib: pip install 'casper-hri[plot]'") from None
    written = []
    with rc_context(FIXED):
        figure = draw(data)
        for kind in FORMATS:
            file = stem.with_suffix(f".{kind}")
            try:
                figure.savefig(file, dpi=130, metadata={"Date": None} if kind == "svg" else {"Software": None})
            except OSError as mistake:
                raise CasperError(f"cannot write {file} ({mistake.strerror or mistake})") from None
            written.append(file)
    return written
