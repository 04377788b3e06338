"""Focus curves as a picture: a line for each thing, the target as a band below them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from casper.engine.events.curves import FocusCurve
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.pictures import picture, wide

WIDE, HIGH = 560, 170  # pixels of the field of curves
LEFT, TOP, BAND = 34, 10, 16
COLOURS = ("#3a86c8", "#d6742a", "#2f9e5f", "#b05bc4", "#c4850c", "#d64a5f", "#1b9aaa", "#8a7f6a")
DASHES = (None, "6 3", "2 3")  # things beyond the colours there are


def curve_svg(curve: FocusCurve) -> Markup:
    """The curves; x is the time in seconds, y the share from 0 (below) to 1."""
    names = sorted(curve.shares, key=lambda name: -max((s for s in curve.shares[name] if s is not None), default=0.0))
    looks = {name: _look(at) for at, name in enumerate(names)}
    drawn = [joined(_lines(curve, name, **looks[name])) for name in names]
    legend = [_entry(at, name, **looks[name]) for at, name in enumerate(names)]
    right = LEFT + WIDE + 16
    width = right + 26 + max(map(wide, names), default=0.0)
    height = max(TOP + HIGH + BAND + 38, TOP + 18 * len(names))
    return picture(width, height, *_axes(curve.times), *drawn, *_band(curve, looks), *legend)


def x_of(t: float, times: Sequence[float]) -> float:
    """Where a time is drawn."""
    return LEFT + WIDE * (t - times[0]) / ((times[-1] - times[0]) or 1.0)


def y_of(share: float) -> float:
    """Where a share is drawn."""
    return TOP + HIGH * (1 - share)


def _look(at: int) -> dict[str, str | None]:
    return {"stroke": COLOURS[at % len(COLOURS)], "stroke_dasharray": DASHES[at // len(COLOURS) % len(DASHES)]}


def _lines(curve: FocusCurve, name: str, **look: str | None) -> Iterator[Markup]:
    """The curve of a thing, in pieces where it was out of view."""
    pairs = zip(curve.times, curve.shares[name])
    for seen, part in groupby(pairs, key=lambda pair: pair[1] is not None):
        if seen:
            points = " ".join(f"{x_of(t, curve.times):.3f},{y_of(s):.3f}" for t, s in part if s is not None)
            yield tag("polyline", tag("title", name), points=points, fill="none", stroke_width=1.6, **look)


def _axes(times: Sequence[float]) -> Iterator[Markup]:
    for share in (0.0, 0.5, 1.0):
        y = y_of(share)
        yield tag("line", x1=LEFT, x2=LEFT + WIDE, y1=y, y2=y, stroke="var(--rule)")
        yield tag("text", f"{share:g}", x=LEFT - 6, y=y + 4, text_anchor="end", fill="var(--faint)")
    y = TOP + HIGH + BAND + 28
    if times:
        yield tag("text", f"{times[0]:g} s", x=LEFT, y=y, fill="var(--faint)")
        yield tag("text", f"{times[-1]:g} s", x=LEFT + WIDE, y=y, text_anchor="end", fill="var(--faint)")


def _band(curve: FocusCurve, looks: dict[str, dict[str, str | None]]) -> Iterator[Markup]:
    """What the target was, from when to when."""
    y, pairs = TOP + HIGH + 8, list(zip(curve.times, curve.targets))
    for target, part in groupby(pairs, key=lambda pair: pair[1]):
        times = [t for t, _ in part]
        end = next((t for t in curve.times if t > times[-1]), times[-1])
        if target is None:
            continue
        left, right = x_of(times[0], curve.times), x_of(end, curve.times)
        colour = looks.get(target, {}).get("stroke") or "var(--faint)"
        about = tag("title", f"the target is {target} from {times[0]:g} s")
        box = {"x": round(left, 2), "y": y, "width": round(max(right - left, 1), 2), "height": BAND, "rx": 2}
        yield tag("rect", about, **box, fill=colour, fill_opacity=0.35)
        if right - left > wide(target) + 6:
            yield tag("text", target, x=round(left + 4, 2), y=y + 12, fill="currentColor")


def _entry(at: int, name: str, **look: str | None) -> Markup:
    x, y = LEFT + WIDE + 16, TOP + 6 + 18 * at
    stroke = tag("line", x1=x, x2=x + 18, y1=y, y2=y, stroke_width=2.4, **look)
    return joined([stroke, tag("text", name, x=x + 24, y=y + 4, fill="currentColor")])
