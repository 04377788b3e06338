"""The robot's part, goal after goal: what it announced, how that changed, and what became of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from casper.engine.events.event import Event
from casper.engine.events.telling import Telling
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import chips, listed, number, table
from casper.report.recording import Recording
from casper.report.story import names_of, seconds

MOST = 200  # parts that are shown


@dataclass(slots=True)
class Part:
    """What was announced for one goal of one partner, and the events that tell what became of it."""

    goal: str
    partner: str
    plans: list[Event] = field(default_factory=list)
    steps: list[Event] = field(default_factory=list)
    end: Event | None = None  # a withdrawal, or the end of the episode


def parts_of(events: Sequence[Event]) -> list[Part]:
    """The robot's parts in the order in which they were first announced."""
    found: list[Part] = []

    def open_part(goal: str | None, partner: str) -> Part | None:
        same = (p for p in reversed(found) if p.end is None and p.partner == partner and goal in (None, p.goal))
        return next(same, None)

    for event in events:
        data = event.data
        partner = str(data.get("partner", data.get("agent")))
        if event.type == "plan":
            part = open_part(data["goal"], partner)
            if part is None:
                part = Part(data["goal"], partner)
                found.append(part)
            part.plans.append(event)
        elif event.type in ("withdrawn", "episode"):
            part = open_part(data["goal"], partner)
            if part is not None:
                part.end = event
        elif event.type == "robot":
            part = next((p for p in found if p.partner == partner and p.end is None and _has(p, data["action"])), None)
            part = part or next((p for p in reversed(found) if p.partner == partner and _has(p, data["action"])), None)
            if part is not None:
                part.steps.append(event)
    return found


def parts_html(recording: Recording) -> Markup:
    """Each part with its announcements, its steps and its end; then how the partner's episodes ended."""
    tell = names_of(recording).tell
    found = parts_of(recording.events)
    shown = [_part(part, recording, tell) for part in found[:MOST]]
    more = [tag("p", f"… and {len(found) - MOST} more", class_="faint")] if len(found) > MOST else []
    nothing = [] if found else [tag("p", "The robot announced nothing.")]
    return joined([*nothing, *shown, *more, _episodes(recording, tell)])


def _has(part: Part, action: str) -> bool:
    return any(action in plan.data["actions"] for plan in part.plans)


def _part(part: Part, recording: Recording, tell: Telling) -> Markup:
    robot = tell.name(str(part.plans[0].data.get("agent", recording.robot)))
    rows = [(seconds(plan.t), _waits(plan, tell), _will(plan, tell)) for plan in part.plans]
    announced = table(rows, ("announced", "waits until", "will then do"))
    steps = [joined([seconds(event.t), " ", _status(event, tell)]) for event in part.steps]
    heading = tag("h3", f"{robot} for the goal ", tag("b", tell.goal(part.goal)), *_ended(part))
    because = tag("p", part.end.data["because"]) if part.end is not None and part.end.type == "withdrawn" else ""
    return tag("article", heading, because, announced, listed(steps) if steps else "", class_="part")


def _will(plan: Event, tell: Telling) -> Markup:
    agent = str(plan.data["agent"])
    return chips((tell.step(action, agent) for action in plan.data["actions"]), "chip ours")


def _waits(plan: Event, tell: Telling) -> Markup:
    partner = str(plan.data.get("partner"))
    told = chips(tell.step(step, partner) for step in plan.data["waiting"])
    return told or tag("span", "its turn", class_="good")


def _status(event: Event, tell: Telling) -> Markup:
    data = event.data
    roles = {"done": "good", "failed": "bad", "stopped": "warning"}
    why = f": {data['reason']}" if data.get("reason") else ""
    step = tell.step(data["action"], str(data.get("agent")))
    return joined([tag("span", data["status"], class_=roles.get(data["status"], "faint")), f" {step}{why}"])


def _ended(part: Part) -> list[Markup]:
    """What became of it."""
    if part.end is None:
        return [tag("span", ": still open at the end", class_="faint")]
    if part.end.type == "withdrawn":
        return [joined([": ", tag("span", "withdrawn at ", class_="warning"), seconds(part.end.t)])]
    outcome = part.end.data["outcome"]
    word = tag("span", outcome, class_="good" if outcome == "finished" else "warning")
    return [joined([": ", word, " at ", seconds(part.end.t)])]


def _episodes(recording: Recording, tell: Telling) -> Markup:
    rows = [
        (tell.name(e.data["agent"]), tell.goal(e.data["goal"] or "?"), e.data["outcome"], seconds(e.data["from"]),
         seconds(e.data["to"]), number(e.data["observed"], 0), number(e.data["missed"], 0))
        for e in recording.of_type("episode")
    ]  # fmt: skip
    if not rows:
        return joined([])
    heading = ("whose", "goal", "ended", "from", "to", "seen", "missed")
    return joined([tag("h3", "Episodes"), tag("div", table(rows, heading), class_="wide")])
