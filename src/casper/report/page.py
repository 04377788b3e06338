"""A recording as one HTML page: no other file, no network, which its own content security policy forbids."""

from __future__ import annotations

import base64
import hashlib
from functools import cache
from importlib.resources import files
from string import Template

from casper.notebook.markup import Markup, joined, tag, text
from casper.report.floor import floor_svg
from casper.report.helped import parts_html
from casper.report.lanes import lanes_html, looks
from casper.report.payload import payload, script_json
from casper.report.recording import Recording
from casper.report.steps import steps_html
from casper.report.story import answers, moments, moments_html, names_of

MOST_PARTNERS = 4
MOST_BELIEVED = 12  # goals with a bar that moves


def page_of(recording: Recording) -> str:
    """The whole page as text.

    The policy lets the one script of the page run, by its hash, and nothing be fetched from anywhere.
    """
    script = _asset("page.js")
    goals = looks(_goals(recording))
    things = looks(_things(recording))
    tell = names_of(recording).tell
    who = ", ".join(map(tell.name, recording.partners))
    return Template(_asset("page.html")).substitute(
        hash=base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
        style=_asset("page.css"),
        script=script,
        title=text(f"{recording.domain}: {tell.name(recording.robot)} watches {who}"),
        about=_about(recording),
        answers=joined(tag("div", tag("h2", asked), tag("div", told)) for asked, told in answers(recording)),
        floor=floor_svg(recording, things),
        moments=moments_html(moments(recording)),
        believed=joined(_believed(partner, goals, recording) for partner in recording.partners[:MOST_PARTNERS]),
        lanes=lanes_html(recording, things, goals),
        steps=steps_html(recording),
        parts=parts_html(recording),
        left=_left_out(recording),
        partner=text(tell.name(recording.partners[0])),
        robot=text(tell.name(recording.robot)),
        start=repr(recording.span[0]),
        end=repr(recording.span[1]),
        data=script_json(payload(recording)),
    )


@cache
def _asset(name: str) -> str:
    return (files("casper.report") / "assets" / name).read_text(encoding="utf-8")


def _goals(recording: Recording) -> list[str]:
    """Every goal that had a share, in the order of the library."""
    return list(dict.fromkeys(goal for event in recording.of_type("reading") for goal in event.data["posterior"]))


def _things(recording: Recording) -> list[str]:
    """Everything there is or that was looked at."""
    seen = (name for event in recording.of_type("focus") for name in event.data["scores"])
    return sorted({*seen, *(name for state in recording.states for name in state.objects)})


def _about(recording: Recording) -> Markup:
    end = recording.summary
    first, last = recording.span
    parts = [f"{last - first:.1f} s"]
    if end is None:
        parts.append("broken off before the end")
    else:
        parts += [f"seed {end.data['seed']}"] if end.data.get("seed") is not None else []
        parts.append("every action verified" if end.data["verification"] else "without verification")
    return text(" · ".join(parts))


def _believed(partner: str, goals: dict[str, str], recording: Recording) -> Markup:
    """A bar for each goal, which the script sets."""

    def row(goal: str, colour: str) -> Markup:
        empty = tag("span", tag("i", style=f"background:{colour}"), class_="bar")
        return tag("tr", tag("td", goal), tag("td", empty), tag("td", "0.00"), data_goal=goal)

    named = [tag("caption", names_of(recording).tell.name(partner))] if len(recording.partners) > 1 else []
    rows = (row(goal, colour) for goal, colour in list(goals.items())[:MOST_BELIEVED])
    return tag("table", *named, *rows, data_whose=partner)


def _left_out(recording: Recording) -> Markup:
    if not recording.left_out:
        return text("")
    told = ", ".join(f"{count} of type {kind}" for kind, count in recording.left_out.items())
    return tag("p", f"So that the page stays small, events are left out: {told}.")
