"""Events as series and bands: posteriors, focus, target, movements, actions, goals and the robot's part over time."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from casper.engine.events.event import Event

Shows = Callable[[Any, str, Event], None]


def show_event(stream: Any, event: Event) -> None:
    """What an event changes, at the time that the stream was set to; most events change nothing here."""
    shows = TABLE.get(event.type)
    if shows is not None:
        shows(stream, str(event.data.get("partner", event.data.get("agent", "partner"))), event)


def _focus(stream: Any, who: str, event: Event) -> None:
    _numbers(stream, ["focus", who], event.data["scores"])
    _band(stream, who, "target", event.data["target"])
    _band(stream, who, "destination", event.data["destination"])


def _movement(stream: Any, who: str, event: Event) -> None:
    _band(stream, who, "movement", event.data["movement"])


def _verdict(stream: Any, who: str, event: Event) -> None:
    if event.data["valid"]:
        _band(stream, who, "action", event.data["completed"])
        _band(stream, who, "refused", None)
    else:
        _band(stream, who, "refused", event.data["statement"])


def _reading(stream: Any, who: str, event: Event) -> None:
    _numbers(stream, ["posterior", who], event.data["posterior"])


def _prediction(stream: Any, who: str, event: Event) -> None:
    _band(stream, who, "goal", event.data["goal"])


def _over(stream: Any, who: str, event: Event) -> None:
    _band(stream, who, "goal", None)


def _plan(stream: Any, who: str, event: Event) -> None:
    actions = ", ".join(event.data["actions"])
    _band(stream, who, "announced", actions or None)


def _withdrawn(stream: Any, who: str, event: Event) -> None:
    _band(stream, who, "announced", None)


def _robot(stream: Any, who: str, event: Event) -> None:
    """A band for each action, from when the robot is asked for it until it is done; for good where it failed."""
    status, action = event.data["status"], event.data["action"]
    lane = ".".join(re.findall(r"\w+", f"{event.data['agent']} {action}"))  # other letters are shown escaped
    _band(stream, who, lane, {"asked": action, "done": None}.get(status, f"{action}: {status}"))


TABLE: Mapping[str, Shows] = {
    "focus": _focus,
    "movement": _movement,
    "verdict": _verdict,
    "reading": _reading,
    "prediction": _prediction,
    "episode": _over,
    "plan": _plan,
    "withdrawn": _withdrawn,
    "robot": _robot,
}
"""What is shown of each type of event. Of every partner ``bands/<partner>/<band>``, ``focus/<partner>/<thing>`` and
``posterior/<partner>/<goal>``.
"""


def _numbers(stream: Any, entity: list[str], values: Mapping[str, float]) -> None:
    import rerun

    for name, value in values.items():
        stream.log([*entity, name], rerun.Scalars(value))


def _band(stream: Any, who: str, band: str, state: str | None) -> None:
    """A band goes on until it is told otherwise; None is a gap."""
    import pyarrow
    import rerun

    # An array, for in a list None would become the word.
    stream.log(["bands", who, band], rerun.StateChange(state=pyarrow.array([state], pyarrow.utf8())))
