"""Writing a recording, line by line, so that one that is broken off can be replayed up to there.

    {"type": "recording", "format": 1, "domain": "kitchen", …}        the header
    {"t": 0.5, "agents": {…}, "objects": {…}}                           what the minds took in
    {"type": "robot", "t": 40.0, "action": …, "status": "done"}        what the robot did
    {"type": "told", "event": {…}}                                    what no mind makes: warnings, the summary of a run
    {"type": "end", "t": 95.5, "states": 190, "events": 812, "sha256": …}

The last line has a digest of all events, so that a replay knows whether it is the same.
"""

from __future__ import annotations

import gzip
import io
import json
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any, BinaryIO, cast

from casper.engine.events import Event
from casper.engine.live import Message
from casper.engine.perception.world import WorldState, world_state_to_json
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.kb.text.files import unwritable
from casper.streams.recordings.header import Header
from casper.streams.recordings.kept import Kept
from casper.streams.sources.files import is_compressed

OFTEN = 100  # lines after which what is compressed is on the disk


class Digest:
    """The digest of events, in their order."""

    def __init__(self) -> None:
        self.count = 0
        self._hash = sha256()

    def add(self, event: Event) -> None:
        """One more."""
        self.count += 1
        self._hash.update(text_of(event.to_json()).encode("utf-8", "surrogateescape") + b"\n")

    @property
    def hex(self) -> str:
        """Of all until now."""
        return self._hash.hexdigest()


class Writer(Kept):
    """Writes what is handed to it."""

    def __init__(self, path: Path, stream: BinaryIO, header: Header) -> None:
        self.path, self.header = path, header
        self.states, self.digest = 0, Digest()
        self._first: float | None = None
        self._last = 0.0
        self._stream, self._lines = stream, 0
        self._line(header.to_json())

    @property
    def seconds(self) -> float:
        """From the first world state to the last."""
        return 0.0 if self._first is None else self._last - self._first

    def given(self, message: Message) -> None:
        """A world state, or a report."""
        if isinstance(message, WorldState):
            self.states += 1
            self._first = message.t if self._first is None else self._first
            self._last = message.t
            self._line(world_state_to_json(message))
            return
        told = {"type": "robot", "t": message.t, "action": term_text(as_term(message.action)), "status": message.status}
        self._line(told | ({} if message.partner is None else {"partner": message.partner}))

    def aside(self, event: Event) -> Event:
        """An event that no mind makes; the robot's reports are lines of their own."""
        told = event.to_json()
        self._line(told if event.type == "robot" else {"type": "told", "event": told})
        return event

    def heard(self, events: Iterator[Event]) -> Iterator[Event]:
        """All events, whoever made them, on their way."""
        for event in events:
            self.digest.add(event)
            yield event

    def finish(self) -> None:
        """The last line; the digest only where there were events."""
        told: dict[str, Any] = {"type": "end", "t": self._last, "states": self.states}
        if self.digest.count:
            told |= {"events": self.digest.count, "sha256": self.digest.hex}
        self._line(told)

    def _line(self, data: dict[str, Any]) -> None:
        self._lines += 1
        try:
            self._stream.write(text_of(data).encode("utf-8", "surrogateescape") + b"\n")
            if self._lines % OFTEN == 0 or not isinstance(self._stream, gzip.GzipFile):
                self._stream.flush()
        except OSError as mistake:
            raise CasperError(f"cannot write {self.path} ({mistake.strerror or mistake}); it ends here") from None


@contextmanager
def recording(path: Path | None, header: Header | None) -> Iterator[Writer | None]:
    """A writer whose file is closed at the end; it has its last line only when nothing went wrong.

    Raises:
        CasperError: the file is there already, or cannot be written.
    """
    if path is None or header is None:
        yield None
        return
    with _opened(path) as stream:
        writer = Writer(path, stream, header)
        yield writer
        writer.finish()


def check_recording(path: Path) -> None:
    """Refuse a place where no recording can be written.

    Raises:
        CasperError: something is there already, or writing is not allowed.
    """
    if path.exists() and (not path.is_file() or path.stat().st_size):
        raise CasperError(f"{path} is there already; choose another name for the recording")
    reason = unwritable(path)
    if reason is not None:
        raise CasperError(f"cannot write {path} ({reason}); choose another place")


def text_of(data: dict[str, Any]) -> str:
    """A line's text, as ``--json`` prints it."""
    return json.dumps(data, ensure_ascii=False)


@contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
    check_recording(path)
    try:
        plain = path.open("wb")
    except OSError as mistake:
        raise CasperError(f"cannot write {path} ({mistake.strerror or mistake}); choose another place") from None
    with plain:
        if not is_compressed(path):
            yield cast(BinaryIO, plain)
            return
        with gzip.GzipFile(path.stem, "wb", 6, cast(io.BytesIO, plain), mtime=0) as packed:
            yield cast(BinaryIO, packed)
