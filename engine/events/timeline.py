"""The live timeline: events as lines a person enjoys reading. There is a line when something changes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from casper.engine.events.event import Event
from casper.engine.events.printing import Names, movement_lines, opening_lines, reading_lines
from casper.kb.text.lines import Line


class Timeline:
    """Tells events; focus and movement only when target, destination or movement change, a reason only once."""

    def __init__(self, partner: str, robot: str) -> None:
        self.names = Names(partner, robot)
        self._focus: dict[str, Any] = {}
        self._last: tuple[Any, ...] = ()
        self._ruled_out: set[str] = set()  # goals whose reason was told already

    def open(self, domain: str, seed: int) -> Iterator[Line]:
        """The heading."""
        return opening_lines(domain, seed, self.names)

    def lines(self, event: Event) -> Iterator[Line]:
        """What there is to say about the next event, perhaps nothing."""
        match event.type:
            case "focus":
                self._focus = dict(event.data)
            case "movement":
                yield from self._movement(event)
            case "reading":
                yield from self._reading(event)
            case "action":  # its verdict, or its reading, tells
                pass
            case "robot" if event.data["status"] == "asked":  # the plan told
                pass
            case _:
                yield from event.lines(self.names)

    def _movement(self, event: Event) -> Iterator[Line]:
        movement, focus = event.data["movement"], self._focus
        now = (movement, focus.get("target"), focus.get("destination"))
        if now != self._last:
            self._last = now
            yield from movement_lines(event.t, movement, focus)

    def _reading(self, event: Event) -> Iterator[Line]:
        yield from reading_lines(event.data, self._ruled_out)
        self._ruled_out = {entry["goal"] for entry in event.data["rejected"]}
