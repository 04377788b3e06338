"""World states of a kitchen as lines, and what a watch says of them."""

import json

from casper import Domain
from casper.engine.live import Partners
from casper.streams.items import Line, Note
from casper.streams.recordings.kept import Kept
from casper.streams.watching import watched

KITCHEN = Domain.load("kitchen")


def state(t, *, human=(0.0, 0.0), agents=None, **objects):
    """A world state as its object; objects are places, and there is a plate."""
    who = {"human": {"x": human[0], "y": human[1], "heading": 0.0, "holding": None}} if agents is None else agents
    places = {"plate": (3.0, 0.0), **objects}
    return {"t": t, "agents": who, "objects": {n: {"x": p[0], "y": p[1]} for n, p in places.items() if p is not None}}


def line(what):
    return what if isinstance(what, (str, Line, Note)) else json.dumps(what)


class Watched(list, Kept):
    """The events of a watch, and what the minds took in."""

    def __init__(self, lines, window=0.0):
        self.taken = []
        super().__init__(watched(Partners(KITCHEN), lines, window=window, kept=self))

    def given(self, message):
        self.taken.append(message)


def watch(*what, window=0.0):
    """The events of a watch."""
    return Watched(map(line, what), window)


def warnings(events):
    return [event.data["message"] for event in events if event.type == "warning"]


def times(events):
    """Of what the minds took in."""
    return [message.t for message in events.taken]
