"""Replaying a recording: the same minds take in the same, and the events are the same, bit for bit."""

from __future__ import annotations

import platform
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from casper import __version__
from casper.engine.domain.digest import digest
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.live import Message, Partners, heard, message_from_json
from casper.engine.live.decoding import plain_world_state
from casper.engine.perception.world import json_object
from casper.kb.errors import CasperError, DomainError, ReadError, WorldStateError
from casper.streams.items import Line, Note
from casper.streams.recordings.header import Header, header_from_json
from casper.streams.recordings.writing import Digest
from casper.streams.sources.files import File
from casper.streams.sources.lines import check_line

OWN = ("predicted", "prediction_time", "observed", "missed", "waiting", "planned", "verification", "episodes")
"""What minds know of a summary; the rest, of a run, only the simulation does."""


class Replay:
    """A recording, to be replayed once.

    Args:
        file: the recording.
        domain: the name or folder of a domain to read it with; None: the one that was recorded.

    Attributes:
        differences: what is not as it was when it was recorded, a sentence each. After the events: end, a sentence
        where it is cut off, and is_same, whether the events are those that were recorded (None: it does not say).

    Raises:
        CasperError: no recording, or a domain that is not there or has a mistake.
    """

    def __init__(self, file: Path, domain: str | Path | None = None) -> None:
        self.file = file
        self._lines = File(file).items()
        self.header = self._read_header()
        self.domain = self._load(domain)
        self.minds = Partners(self.domain, **self.header.settings)
        self.differences = list(self._compared())
        self.end = ""
        self.is_same: bool | None = None
        self._digest = Digest()
        self._end: Mapping[str, Any] | None = None
        self._summed = False
        self._now = 0.0

    def events(self) -> Iterator[Event]:
        """All events; a line that cannot be read is told in a ``warning``, and passed over."""
        number = 1
        for line in self._lines:
            if isinstance(line, Note):
                self.end = line.sentence
                break
            number = line.number
            for event in self._replayed(line):
                yield self._heard(event)
            if self._end is not None:
                break
        if not self._summed:
            for event in (*self.minds.end(self._now), Event("summary", self._now, self.minds.summary())):
                yield self._heard(event)
        self._finish(number)

    def _heard(self, event: Event) -> Event:
        self._digest.add(event)
        return event

    def _replayed(self, line: Line) -> Iterator[Event]:
        try:
            check_line(line.text)
            world = plain_world_state(line.text)
            if world is not None:
                yield from self._told(world)
                return
            data = json_object(line.text)
            kind = data.get("type")
            if kind == "told":
                yield from self._aside(data)
            elif kind == "end":
                self._end = data
            else:
                message = message_from_json(data)
                if kind == "robot" and self.header.is_simulated:
                    yield _event(data)
                yield from self._told(message)
        except (WorldStateError, ReadError) as mistake:
            if line.is_whole:
                yield Event("warning", self._now, {"message": f"{line.where} is left out: {mistake.sentence}"})

    def _told(self, message: Message) -> Iterator[Event]:
        with suppress(WorldStateError):  # as when it was recorded: what was told of it is a line of its own
            events = heard(self.minds, message)
            self._now = message.t
            yield from events

    def _aside(self, data: Mapping[str, Any]) -> Iterator[Event]:
        event = _event(data.get("event"))
        if event.type == "summary":
            self._summed = True
            yield from self.minds.end(event.t)
            fresh = self.minds.summary(seed=self.header.seed)
            own = {key: fresh[key] for key in OWN if key in fresh and key in event.data}
            event = Event("summary", event.t, {**event.data, **own})
        yield event

    def _finish(self, number: int) -> None:
        if self._end is None:
            cut = f"{self.file.name} is cut off behind line {number}; it was replayed to t={self._now:g}"
            self.end = self.end or cut
        elif "sha256" in self._end:
            told = (self._end.get("events"), self._end["sha256"])
            self.is_same = told == (self._digest.count, self._digest.hex)

    # --- before ------------------------------------------------------------------------------------------------------

    def _read_header(self) -> Header:
        first = next(self._lines, None)
        if not isinstance(first, Line):
            raise CasperError(f"{self.file} is no recording: {'it is empty' if first is None else first.sentence}")
        try:
            data = json_object(first.text)
        except WorldStateError as mistake:
            raise CasperError(f"{self.file} is no recording: {mistake.sentence}") from None
        return header_from_json(data, self.file.name)

    def _load(self, domain: str | Path | None) -> Domain:
        try:
            return Domain.load(domain or self.header.domain, self.header.language)
        except DomainError as mistake:
            advice = "" if domain else "; say with --domain what it is to be read with"
            raise CasperError(f"{self.file.name} is of the domain {self.header.domain}: {mistake}{advice}") from None

    def _compared(self) -> Iterator[str]:
        header = self.header
        if header.digest != digest(self.domain):
            yield f"the domain {self.domain.name} says something else than when {self.file.name} was recorded"
        if header.casper != __version__:
            yield f"{self.file.name} was recorded by casper {header.casper}, and this is {__version__}"
        if header.python.split(".")[:2] != platform.python_version().split(".")[:2]:
            yield f"{self.file.name} was recorded on Python {header.python}, and this is {platform.python_version()}"


def _event(data: object) -> Event:
    """The event of a line.

    Raises:
        WorldStateError: it is none.
    """
    if not isinstance(data, Mapping) or not isinstance(data.get("type"), str):
        raise WorldStateError("it holds no event")
    t = data.get("t")
    if isinstance(t, bool) or not isinstance(t, (int, float)):
        raise WorldStateError('its event has no number under "t"')
    return Event(data["type"], t, {key: value for key, value in data.items() if key not in ("type", "t")})
