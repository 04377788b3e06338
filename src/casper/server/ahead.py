"""Requests read ahead: which wait, and which of them were cancelled before their turn came."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable
from queue import Queue
from typing import BinaryIO

from casper.server.lines import bounded_lines
from casper.server.protocol import Id, Message, ProtocolError, Request, message_of, too_long
from casper.server.stopping import Key, key_of

AHEAD = 10_000  # lines that are read before those before them are answered
CANCEL = "cancel"


class Ahead:
    """Reads lines in a thread of its own; ``cancel`` is acted on when it is read, whatever is being worked on.

    Args:
        longest: bytes of a line.
        stop: stops the request of that id, if it is being worked on.
    """

    def __init__(self, longest: int, stop: Callable[[Id], None]) -> None:
        self._longest, self._stop = longest, stop
        self._queue: Queue[Message | None] = Queue(AHEAD)
        self._lock = threading.Lock()
        self._waits: Counter[Key] = Counter()  # ids that were read and are not answered yet
        self._cancelled: set[Key] = set()

    def read(self, source: BinaryIO) -> None:
        """Read until the source ends or is closed; blocks."""
        try:
            for line in bounded_lines(source, self._longest):
                message = too_long(self._longest) if line is None else message_of(line)
                self._queue.put(Message(tuple(map(self._noted, message.requests)), message.is_batch))
        except (OSError, ValueError):  # closed under us: what was read is answered
            pass
        finally:
            self._queue.put(None)

    def next(self) -> Message | None:
        """The next message, when there is one; None at the end."""
        return self._queue.get()

    @property
    def is_empty(self) -> bool:
        """Whether nothing waits."""
        return self._queue.empty()

    def is_cancelled(self, request: Request) -> bool:
        """Whether a request was cancelled before its turn came."""
        return request.answers and key_of(request.id) in self._cancelled

    def answered(self, request: Request) -> None:
        """A request waits no more."""
        if not request.answers or request.id is None:
            return
        with self._lock:
            key = key_of(request.id)
            self._waits[key] -= 1
            if self._waits[key] <= 0:
                del self._waits[key]
                self._cancelled.discard(key)

    def _noted(self, request: Request) -> Request:
        if request.mistake is None and request.method == CANCEL:
            return self._cancel(request)
        if request.answers and request.id is not None:
            with self._lock:
                self._waits[key_of(request.id)] += 1
        return request

    def _cancel(self, request: Request) -> Request:
        """Cancel what is named; the request then tells whether there was such a one."""
        params = request.params
        wanted = params.get("id") if isinstance(params, dict) else next(iter(params), None)
        if isinstance(wanted, bool) or not isinstance(wanted, (str, int, float)):
            mistake = ProtocolError("params", "cancel takes the id of a request: a string or a number")
            return Request(request.id, CANCEL, answers=request.answers, mistake=mistake)
        with self._lock:
            found = self._waits[key_of(wanted)] > 0
            if found:
                self._cancelled.add(key_of(wanted))
        self._stop(wanted)
        return Request(request.id, CANCEL, {"found": found}, request.answers)
