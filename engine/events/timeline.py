"""The live timeline: events as lines a person enjoys reading. There is a line when something changes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from casper.engine.events.entries import Names
from casper.engine.events.event import Event
from casper.engine.events.printing import movement_lines, opening_lines, reading_lines
from casper.kb.reasons.says import SILENT, Words
from casper.kb.text.lines import Line, Span


class Timeline:
    """Tells events; focus and movement only when target, destination or movement change, a reason only once.

    Where several partners are watched, every line begins with the name of the one it is about.
    """

    def __init__(self, partner: str, robot: str, words: Words = SILENT) -> None:
        self.names = Names(partner, robot, words)
        self._told: dict[str, _Told] = {}  # by partner

    def open(self, domain: str, seed: int) -> Iterator[Line]:
        """The heading."""
        return opening_lines(domain, seed, self.names)

    def lines(self, event: Event) -> Iterator[Line]:
        """What there is to say about the next event, perhaps nothing."""
        whose = event.data.get("partner", event.data.get("agent", self.names.partner))
        told = self._told.setdefault(str(whose), _Told())
        several = len(self._told) > 1 and event.type != "summary"
        for spans in self._lines(event, told):
            yield (Span(f"{whose}  ", "strong"), *spans) if several else spans

    def _lines(self, event: Event, told: _Told) -> Iterator[Line]:
        match event.type:
            case "focus":
                told.focus = dict(event.data)
            case "movement":
                yield from told.movement(event)
            case "reading":
                yield from told.reading(event)
            case "action":  # its verdict, or its reading, tells
                pass
            case "robot" if event.data["status"] == "asked":  # the plan told
                pass
            case "plan" if event.data.get("ready"):  # what the robot says tells
                pass
            case _:
                partner = str(event.data.get("partner", self.names.partner))  # whose it is, where there are several
                yield from event.lines(replace(self.names, partner=partner))


class _Told:
    """What was told last of one partner."""

    def __init__(self) -> None:
        self.focus: dict[str, Any] = {}
        self._last: tuple[Any, ...] = ()
        self._ruled_out: set[str] = set()  # goals whose reason was told already

    def movement(self, event: Event) -> Iterator[Line]:
        """A movement, when it or what it is about has changed."""
        movement, focus = event.data["movement"], self.focus
        now = (movement, focus.get("target"), focus.get("destination"))
        if now != self._last:
            self._last = now
            yield from movement_lines(event.t, movement, focus)

    def reading(self, event: Event) -> Iterator[Line]:
        """A reading, with the reasons that were not told yet."""
        yield from reading_lines(event.data, self._ruled_out)
        self._ruled_out = {entry["goal"] for entry in event.data["rejected"]}
