"""How a summary is shown: what was predicted and done of every partner, and what became of the robot's part."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from casper.engine.events.entries import NAMES, Data, Names, at, under
from casper.kb.text.lines import Line, Span

_FATES = {
    "announced": "announced, and its time never came",
    "asked": "begun, and not ended",
    "dropped": "not needed any more",
    "failed": "given up",
    "stopped": "stopped",
    "taken over": "done by the partner",
    "withdrawn": "withdrawn",
}  # what became of an announced step that the robot has not done


def summary_lines(t: float, data: Data, names: Names = NAMES) -> Iterator[Line]:
    """What was predicted and done, and whether it was right, of every partner; of several goals, how each ended."""
    rows, partners = data.get("episodes", ()), data.get("partners", ())
    for row in partners:
        theirs = [episode for episode in rows if episode["agent"] == row["agent"]]
        yield from _wanted_lines(t, {**row, "episodes": theirs}, replace(names, partner=row["agent"]))
    if not partners:
        yield from _wanted_lines(t, data, names)
    behaviour = data.get("behaviour") or {"names": [], "told": []}
    if behaviour["names"]:
        yield under(f"{names.partner} was {', '.join(behaviour['names'])}: {'; '.join(behaviour['told'])}")
    for row in rows if len(rows) > max(1, len(partners)) else ():
        yield under(f"{row['agent']}: ", Span(row["goal"] or "?", "strong"), f" {row['outcome']} at {row['to']:.1f} s")
    if data.get("goal") is not None and data["robot"]["actions"]:
        done = Span("finished", "good") if data["robot"]["done"] else Span("not finished", "bad")
        part = ", ".join(names.tell.step(action, names.robot) for action in data["robot"]["actions"])
        yield under(f"{names.tell.name(names.robot)}'s part ({part}) is ", done)
    truth = data.get("truth") or {"help": [], "wrong_interventions": []}
    for step in (step for step in truth["help"] if step["outcome"] != "done"):
        because = f": {step['because']}" if step["because"] else ""
        yield under(f"{names.tell.step(step['action'], names.robot)} was {_FATES[step['outcome']]}{because}")
    for wrong in truth["wrong_interventions"]:
        yield under(Span("wrong intervention: ", "bad"), wrong)


def _wanted_lines(t: float, data: Data, names: Names) -> Iterator[Line]:
    """What the partner was after, where somebody knows, and what was taken for it."""
    predicted = data["predicted"] or "nothing"
    when = f" at {data['prediction_time']:.1f} s" if data["prediction_time"] is not None else ""
    mark = Span("right", "good") if data.get("correct") else Span("wrong", "bad")
    if data.get("goal") is None:
        yield at(t, Span(f"predicted {predicted}{when}", "strong"))
    elif data.get("goals"):
        read = ", ".join(row["goal"] or "?" for row in data.get("episodes", ()))
        yield at(t, Span(f"{names.partner} wanted {', '.join(data['goals'])}; read {read}", "strong"), ": ", mark)
    else:
        wanted = f"{names.partner} wanted {data['goal']}; predicted {predicted}{when}"
        yield at(t, Span(wanted, "strong"), ": ", mark)
