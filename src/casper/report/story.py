"""A run told in sentences: moment by moment, and as answers to four questions.

What did the partner do? When did the robot know, why, and what did it do? All of it is read off the events.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.events.entries import Names
from casper.engine.events.event import Event
from casper.engine.events.telling import Telling
from casper.kb.text.lines import Line
from casper.notebook.markup import Markup, joined, tag
from casper.notebook.parts import lines_html, listed, number
from casper.report.recording import Recording

MOST = 12  # of a kind in the answers; the rest is in the list of moments
TOLD = ("verdict", "prediction", "plan", "withdrawn", "robot", "episode", "warning", "summary")


@dataclass(frozen=True, slots=True)
class Moment:
    """Something worth a line: the number of its event, when (s), of which type, and the lines."""

    number: int
    t: float
    kind: str
    lines: tuple[Line, ...]


def names_of(recording: Recording, event: Event | None = None) -> Names:
    """What the robot and the partner whom an event is about are called; the first partner without one."""
    about = () if event is None else (event.data.get("partner"), event.data.get("agent"))
    partner = next((name for name in about if name in recording.partners), recording.partners[0])
    return Names(partner, recording.robot, recording.words)


def moments(recording: Recording) -> list[Moment]:
    """What happened, in the lines of the timeline without their margin; what was asked of the robot its plan told."""
    return [
        Moment(at, event.t, _kind(event), tuple(map(_without_margin, event.lines(names_of(recording, event)))))
        for at, event in enumerate(recording.events)
        if event.type in TOLD and event.data.get("status") != "asked"
    ]


def answers(recording: Recording) -> list[tuple[str, Markup]]:
    """The four questions with their answers."""
    tell = names_of(recording).tell
    who, robot = tell.name(recording.partners[0]), tell.name(recording.robot)
    who = who if len(recording.partners) == 1 else "the partners"
    return [
        (f"What did {who} do?", _done(recording, tell)),
        (f"When did {robot} know?", _known(recording, tell)),
        ("Why?", _why(recording)),
        (f"What did {robot} do?", _helped(recording, tell)),
    ]


def seconds(t: float) -> Markup:
    """A time that takes the page there."""
    return tag("button", number(t, 1), " s", class_="at", type="button", data_t=repr(t))


def _kind(event: Event) -> str:
    return "refused" if event.type == "verdict" and not event.data["valid"] else event.type


def _without_margin(spans: Line) -> Line:
    """A line of the timeline begins with its time and two spaces, or with as many spaces."""
    return spans[2:] if len(spans) > 1 and spans[1].text == "  " else spans[1:]


def _done(recording: Recording, tell: Telling) -> Markup:
    rows = [_by(event, tell.statement(event.data["completed"])) for event in _valid(recording)]
    rows = rows or [_by(event, _last_seen(recording, event)) for event in recording.of_type("reading")]
    return _listed(rows) if rows else tag("p", "Nothing that the robot made out.")


def _last_seen(recording: Recording, reading: Event) -> str:
    return names_of(recording, reading).tell.theirs(reading.data["observations"][-1])


def _valid(recording: Recording) -> list[Event]:
    return [event for event in recording.of_type("verdict") if event.data["valid"]]


def _by(event: Event, told: str) -> Markup:
    return joined([seconds(event.t), " ", told])


def _known(recording: Recording, tell: Telling) -> Markup:
    made = recording.of_type("prediction")
    if not made:
        return tag("p", "It was never sure of a goal.")
    rows = [_prediction(recording, event, tell) for event in made]
    return joined([_listed(rows), *_truth(recording, tell)])


def _prediction(recording: Recording, event: Event, tell: Telling) -> Markup:
    seen = event.data["observed"]
    missed = f", {event.data['missed']} missed" if event.data["missed"] else ""
    whose = f"{tell.name(str(event.data.get('agent')))}: " if len(recording.partners) > 1 else ""
    goal = tag("b", tell.goal(event.data["goal"]))
    leaves = _steps_of(recording, event)
    of = f" of {leaves}" if leaves else ""
    after = f", after {seen}{of} step{'' if (leaves or seen) == 1 else 's'}{missed}"
    return joined([seconds(event.t), f" {whose}the goal is ", goal, after])


def _steps_of(recording: Recording, prediction: Event) -> int:
    """How many actions the plan has that was read; 0 where nobody says."""
    reading = _behind(recording, prediction)
    best = [] if reading is None else [row for row in reading.data["best"] if row["goal"] == prediction.data["goal"]]
    return len(best[0]["leaves"]) if best else 0


def _truth(recording: Recording, tell: Telling) -> Iterator[Markup]:
    """What the partner really wanted, where somebody knows."""
    end = recording.summary
    if end is None or end.data.get("goal") is None:
        return
    wanted = [_wanted(row, tell, len(recording.partners) > 1) for row in end.data.get("partners", [end.data])]
    right = end.data.get("correct")
    mark = tag("span", "right" if right else "wrong", class_="good" if right else "bad")
    yield tag("p", "Really wanted: ", "; ".join(wanted), ". The reading was ", mark, ".")


def _wanted(row: Any, tell: Telling, named: bool) -> str:
    goals = ", then ".join(map(tell.goal, row.get("goals") or [row["goal"]]))
    return f"{tell.name(row['agent'])}: {goals}" if named else goals


def _why(recording: Recording) -> Markup:
    """The reading behind each prediction: what was seen, and what speaks against the other goals."""
    found = [(event, reading) for event in recording.of_type("prediction") if (reading := _behind(recording, event))]
    parts = [_reason(e.data["goal"], reading.data, names_of(recording, e).tell) for e, reading in found[:MOST]]
    return joined(parts) if parts else tag("p", "No goal explained what was seen before all others.")


def _behind(recording: Recording, prediction: Event) -> Event | None:
    """The reading that led to a prediction: the last one of the same partner before it."""
    whose, found = prediction.data.get("agent"), None
    for event in recording.events:
        if event is prediction:
            return found
        if event.type == "reading" and event.data.get("agent") == whose:
            found = event
    return None


def _reason(goal: str, reading: Any, tell: Telling) -> Markup:
    seen = "; ".join(map(tell.theirs, reading["observations"]))
    sure = joined(["share ", number(reading["posterior"].get(goal, 0.0))])
    claim = tag("p", tag("b", tell.goal(goal)), f" explains what was seen ({seen}): ", sure, ".")
    against = [
        joined([tag("span", f"not {tell.goal(row['goal'])}: ", class_="faint"), row["reasons"][0]])
        for row in reading["rejected"][:MOST]
        if row["reasons"]
    ]
    return joined([claim, listed(against) if against else ""])


def _helped(recording: Recording, tell: Telling) -> Markup:
    rows = [
        joined([seconds(event.t), " ", told])
        for event in recording.of_type("plan", "withdrawn", "robot")
        if (told := _step(recording, event, tell)) is not None
    ]
    if not rows:
        return tag("p", "It did nothing.")
    return joined([_listed(rows), *_result(recording)])


def _step(recording: Recording, event: Event, tell: Telling) -> Markup | None:
    """What the robot said or did; a plan is told when it is new, not when it waits for less."""
    data = event.data
    if event.type == "withdrawn":
        return joined([tag("span", "took back ", class_="warning"), f"its part in {tell.goal(data['goal'])}"])
    if event.type == "plan":
        return _announced(data, tell) if _is_new(recording, event) else None
    if data["status"] == "asked":
        return None
    roles = {"done": "good", "failed": "bad", "stopped": "warning"}
    why = f": {data['reason']}" if data.get("reason") else ""
    step = tell.step(data["action"], str(data.get("agent", recording.robot)))
    return joined([tag("span", data["status"], class_=roles.get(data["status"], "faint")), f": {step}{why}"])


def _announced(data: Any, tell: Telling) -> Markup:
    if not data["actions"]:
        return joined([f"could do nothing for {tell.goal(data['goal'])}"])
    steps = len(data["waiting"])
    when = f"after {steps} more step{'' if steps == 1 else 's'} of the partner" if steps else "now"
    will = "; ".join(tell.step(action, str(data["agent"])) for action in data["actions"])
    return joined([f"announced what it will do {when}: {will}"])


def _is_new(recording: Recording, plan: Event) -> bool:
    """Whether the plan was not announced before it with the same part for the same goal."""
    last = None
    for event in recording.of_type("plan", "withdrawn", "episode"):
        if event is plan:
            break
        if event.data.get("partner", event.data.get("agent")) == plan.data.get("partner"):
            last = event if event.type == "plan" else None
    return last is None or any(last.data[key] != plan.data[key] for key in ("goal", "actions"))


def _result(recording: Recording) -> Iterator[Markup]:
    end = recording.summary
    if end is not None and end.data["robot"]["actions"]:
        done = end.data["robot"]["done"]
        word = tag("span", "finished" if done else "not finished", class_="good" if done else "bad")
        yield tag("p", "Its part was ", word, ".")


def _listed(rows: Sequence[Markup]) -> Markup:
    rest = [tag("span", f"… and {len(rows) - MOST} more", class_="faint")] if len(rows) > MOST else []
    return listed([*rows[:MOST], *rest])


def moments_html(found: Sequence[Moment]) -> Markup:
    """The list of moments; each takes the page to its time."""
    rows = [
        tag("li", seconds(each.t), lines_html(each.lines), class_=each.kind, data_t=repr(each.t)) for each in found
    ]
    return tag("ol", *rows, class_="moments")
