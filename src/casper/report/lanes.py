"""Everything over one axis of time: posteriors, focus, movements, actions and the robot's part, lane below lane.

A lane is as wide as the page; places along it are percent of the time that was recorded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from casper.engine.events.curves import focus_curve
from casper.engine.events.event import Event
from casper.notebook.curves import COLOURS, DASHES
from casper.notebook.markup import Markup, joined, tag
from casper.report.floor import is_about
from casper.report.recording import Recording
from casper.report.story import names_of

HIGH = 100  # units of a lane with curves
MOST_CURVES = 16
KINDS = {"still": "still", "walk": "walk", "transport": "carry", "pick": "grasp", "place": "put"}
MOVES = {name: f"var(--{kind})" for name, kind in KINDS.items() if name != "still"}
NEAR_END = 95  # percent: a label from there on stands left of its tick
TICKS = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600)


class Axis:
    """From a time to its place, in percent."""

    def __init__(self, span: tuple[float, float]) -> None:
        self.start, self.end = span
        self.long = (self.end - self.start) or 1.0

    def at(self, t: float) -> float:
        """Percent of the way along."""
        return round(100 * (t - self.start) / self.long, 3)

    def ticks(self) -> Iterator[float]:
        """Round times, six or so."""
        step = next((step for step in TICKS if self.long / step <= 6), self.long)
        first = -(-self.start // step) * step
        return (first + number * step for number in range(int((self.end - first) // step) + 1))


def lanes_html(recording: Recording, things: Mapping[str, str], goals: Mapping[str, str]) -> Markup:
    """All lanes, partner after partner; ``things`` and ``goals`` are their colours."""
    axis = Axis(recording.span)
    several = len(recording.partners) > 1
    parts: list[Markup] = []
    for partner in recording.partners:
        events = [event for event in recording.events if is_about(event, partner)]
        whose = f"{names_of(recording).tell.name(partner)}: " if several else ""
        parts += [
            _lane(f"{whose}goal", _posteriors(events, axis, goals), "curves", goals),
            _lane(f"{whose}looks at", _focus(events, partner, axis, things), "curves", things),
            _lane(f"{whose}target", _targets(events, axis, things)),
            _lane(f"{whose}movement", _movements(events, axis), legend=MOVES),
            _lane(f"{whose}action", _actions(events, axis, recording), "tall"),
        ]
    parts.append(_lane("robot", _robot(axis, recording), "tall"))
    ticks = [
        tag("span", f"{t:g} s", style=f"left:{axis.at(t)}%", class_=_corner(axis.at(t)))
        for t in axis.ticks()
    ]
    return tag("div", *parts, _lane("", joined(ticks), "axis"), class_="lanes")


def _corner(at: float) -> str | None:
    """A label that would stand out of the lane on one side."""
    return "last" if at > NEAR_END else "first" if at < 100 - NEAR_END else None


def looks(names: Sequence[str]) -> dict[str, str]:
    """A colour for each name."""
    return {name: COLOURS[at % len(COLOURS)] for at, name in enumerate(names)}


def _lane(title: str, content: Markup, kind: str = "", legend: Mapping[str, str] | None = None) -> Markup:
    shown = list((legend or {}).items())[:MOST_CURVES]
    entries = [tag("span", tag("i", style=f"background:{colour}"), name) for name, colour in shown]
    heading = tag("div", tag("h3", title), *([tag("div", *entries, class_="legend")] if entries else []), class_="name")
    return joined([heading, tag("div", content, class_=f"lane {kind}".strip())])


def _curves(lines: Iterator[Markup]) -> Markup:
    rule = tag("path", d=f"M0 {HIGH / 2}H1000", class_="rule")
    return tag("svg", rule, *lines, viewBox=f"0 -5 1000 {HIGH + 10}", preserveAspectRatio="none", class_="plot")


def _posteriors(events: Sequence[Event], axis: Axis, goals: Mapping[str, str]) -> Markup:
    """Each goal's share over time, in steps; at the end of an episode nothing is believed any more."""
    changes: list[tuple[float, Mapping[str, float]]] = []
    for event in events:
        if event.type == "reading":
            changes.append((event.t, event.data["posterior"]))
        elif event.type == "episode":
            changes.append((event.t, {}))
    stars = [
        tag("span", "★", class_="star", style=f"left:{axis.at(e.t)}%", title=f"{e.data['goal']}, {e.t:g} s")
        for e in events
        if e.type == "prediction"
    ]
    lines = (_steps(name, at, colour, changes, axis) for at, (name, colour) in enumerate(goals.items()))
    return joined([_curves(line for line in lines), *stars])


def _steps(name: str, at: int, colour: str, changes: Sequence[tuple[float, Mapping[str, float]]], axis: Axis) -> Markup:
    path = [f"M0 {HIGH}"]
    for t, shares in changes:
        path.append(f"H{round(10 * axis.at(t), 2)}V{round(HIGH * (1 - shares.get(name, 0.0)), 2)}")
    dash = DASHES[at // len(COLOURS) % len(DASHES)]
    return tag("path", tag("title", name), d="".join([*path, "H1000"]), stroke=colour, stroke_dasharray=dash)


def _focus(events: Sequence[Event], partner: str, axis: Axis, things: Mapping[str, str]) -> Markup:
    curve = focus_curve(events, partner)
    return _curves(
        tag("polyline", tag("title", name), points=points, stroke=things.get(name, "currentColor"))
        for name in curve.shares
        for points in _pieces(curve.times, curve.shares[name], axis)
    )


def _pieces(times: Sequence[float], shares: Sequence[float | None], axis: Axis) -> Iterator[str]:
    """The curve of a thing, in pieces where it was out of view."""
    for seen, part in groupby(zip(times, shares), key=lambda pair: pair[1] is not None):
        if seen:
            yield " ".join(f"{10 * axis.at(t):.1f},{HIGH * (1 - s):.1f}" for t, s in part if s is not None)


def _targets(events: Sequence[Event], axis: Axis, things: Mapping[str, str]) -> Markup:
    rows = [(e.t, e.data["target"]) for e in events if e.type == "focus"]
    return joined(_block(a, b, axis, name, "target", things.get(name, "")) for a, b, name in _runs(rows) if name)


def _movements(events: Sequence[Event], axis: Axis) -> Markup:
    rows = [(e.t, e.data["movement"]) for e in events if e.type == "movement"]
    return joined(_block(a, b, axis, name, f"move {KINDS.get(name, '')}") for a, b, name in _runs(rows))


def _runs(rows: Sequence[tuple[float, str | None]]) -> Iterator[tuple[float, float, str]]:
    """From when to when each value held; the last one up to its last time."""
    changes = [row for at, row in enumerate(rows) if at == 0 or row[1] != rows[at - 1][1]]
    ends = [*(t for t, _ in changes[1:]), rows[-1][0]] if rows else []
    return ((t, end, value or "") for (t, value), end in zip(changes, ends))


def _actions(events: Sequence[Event], axis: Axis, recording: Recording) -> Markup:
    """What was made out, each up to the time when it was; what was thrown out as a mark."""
    parts, since = list[Markup](), axis.start
    numbers = {id(event): at for at, event in enumerate(recording.of_type("reading"), 1)}
    for event in events:
        if event.type == "reading":
            step = names_of(recording, event).tell.theirs(event.data["observations"][-1])
            parts.append(_block(since, event.t, axis, f"{numbers[id(event)]} {step}", "did"))
        if event.type in ("reading", "episode"):
            since = event.t
        elif event.type == "verdict" and not event.data["valid"]:
            why = "; ".join(event.data["reasons"])
            told = f"thrown out at {event.t:g} s: {names_of(recording).tell.statement(event.data['statement'])}. {why}"
            parts.append(tag("span", "✘", class_="cross", style=f"left:{axis.at(event.t)}%", title=told))
    return joined(parts)


def _robot(axis: Axis, recording: Recording) -> Markup:
    """Where it waits, and over that what it does, from when it was asked, or was free, until it was over."""
    tell, parts = names_of(recording).tell, list(_waiting(axis, recording))
    asked: dict[str, float] = {}
    free = axis.start
    for event in recording.of_type("robot", "withdrawn"):
        data = event.data
        if event.type == "withdrawn":
            place = f"left:{axis.at(event.t)}%"
            parts.append(tag("span", "✗", class_="cross took", style=place, title=data["because"]))
        elif data["status"] == "asked":
            asked[data["action"]] = event.t
        else:
            step = tell.step(data["action"], str(data.get("agent", recording.robot)))
            since = max(free, asked.get(data["action"], free))
            parts.append(_block(since, event.t, axis, step, f"act {data['status']}"))
            free = event.t
    return joined(parts)


def _waiting(axis: Axis, recording: Recording) -> Iterator[Markup]:
    """From each announcement that waits for something until the next one, or until it is taken back or over."""
    since: dict[str, float] = {}
    for event in recording.of_type("plan", "withdrawn", "episode"):
        partner = str(event.data.get("partner", event.data.get("agent")))
        waits = event.type == "plan" and bool(event.data["waiting"]) and bool(event.data["actions"])
        if partner in since and not waits:
            yield _block(since.pop(partner), event.t, axis, "waits", "waits")
        elif waits:
            since.setdefault(partner, event.t)
    for start in since.values():
        yield _block(start, axis.end, axis, "waits", "waits")


def _block(start: float, end: float, axis: Axis, text: str, kind: str, colour: str = "") -> Markup:
    """A stretch of time with what it was."""
    left, wide = axis.at(start), round(max(axis.at(end) - axis.at(start), 0.15), 3)
    look = f";background:{colour}" if colour else ""
    about = f"{text}: {start:g} to {end:g} s"
    return tag("span", tag("em", text), class_=f"block {kind}", style=f"left:{left}%;width:{wide}%{look}", title=about)
