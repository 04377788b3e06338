"""Focus curves: what the partner attends to over time, as data made of focus events (paper, section Focus Estimation).

curve = focus_curve(trial.events())
curve.shares["meal"], curve.targets
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from casper.engine.events.event import Event
from casper.kb.text.lines import Line, Shown, Span, line, text_of

SIGNS = "▁▂▃▄▅▆▇█"
MOST_SIGNS = 60  # of a curve in a line of text


@dataclass(frozen=True, slots=True)
class FocusCurve(Shown):
    """Each thing's share of the focus over time, with the target and the destination that were taken from it.

    ``times`` are seconds, ascending; ``shares`` has for each thing, in alphabetical order, its share from 0 to 1 at
    each of them, None where it was not in view; ``targets`` and ``destinations`` have a name or None for each.
    """

    times: tuple[float, ...]
    shares: Mapping[str, tuple[float | None, ...]]
    targets: tuple[str | None, ...]
    destinations: tuple[str | None, ...]

    def to_json(self) -> dict[str, Any]:
        """``{"times": [s], "shares": {name: [share or null]}, "targets": [name or null], "destinations": […]}``."""
        return {
            "times": list(self.times),
            "shares": {name: list(curve) for name, curve in self.shares.items()},
            "targets": list(self.targets),
            "destinations": list(self.destinations),
        }

    def lines(self) -> Iterator[Line]:
        """A small curve for each thing."""
        if not self.times:
            yield line("nothing was attended to")
            return
        yield line(Span(f"focus from {self.times[0]:g} to {self.times[-1]:g} s", "strong"))
        width = max(map(len, self.shares), default=0)
        for name, curve in self.shares.items():
            highest = max((share for share in curve if share is not None), default=0.0)
            yield line(f"  {name:<{width}}  ", Span(_signs(curve), "share"), f"  at most {highest:.2f}")

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return f"<FocusCurve: {len(self.shares)} things, {len(self.times)} times>"


def focus_curve(events: Iterable[Event], agent: str | None = None) -> FocusCurve:
    """The focus events among some events as curves.

    Args:
        events: of one partner, or of several.
        agent: whose focus is meant, where there are several.
    """
    focus = [e for e in events if e.type == "focus" and agent in (None, e.data.get("agent", agent))]
    names = sorted({name for event in focus for name in event.data["scores"]})
    return FocusCurve(
        tuple(event.t for event in focus),
        {name: tuple(event.data["scores"].get(name) for event in focus) for name in names},
        tuple(event.data["target"] for event in focus),
        tuple(event.data["destination"] for event in focus),
    )


def _signs(curve: tuple[float | None, ...]) -> str:
    """At most `MOST_SIGNS` signs, each the highest share of its stretch."""
    stretch = -(-len(curve) // MOST_SIGNS)
    parts = [curve[at : at + stretch] for at in range(0, len(curve), stretch)]
    highest = [max((share for share in part if share is not None), default=None) for part in parts]
    return "".join(" " if share is None else SIGNS[min(int(share * 8), 7)] for share in highest)
