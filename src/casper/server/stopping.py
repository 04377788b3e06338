"""Stopping work that runs: an exception in the main thread, at its next instruction, in what it is meant for only."""

from __future__ import annotations

import _thread
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, TypeAlias

from casper.server.protocol import Id, ProtocolError

Key: TypeAlias = tuple[type, Any]
_TICK = 0.02  # seconds between two looks at the clock


def key_of(number: Id) -> Key:
    """An id as a key: 1 and 1.0 are one number, "1" is another id."""
    return (str if isinstance(number, str) else float, number)


class _Stop(BaseException):
    """Raised in the middle of the work; no ``except Exception`` on the way takes it for a mistake."""


class Stopper:
    """Runs work that may be stopped, by its id or when it takes longer than so many seconds.

    Works where `ready` was entered in the main thread; elsewhere nothing is stopped.
    """

    def __init__(self, longest: float) -> None:
        self.longest = longest
        self._running: tuple[Key, float] | None = None  # what is worked on, and since when
        self._wanted: tuple[Key, str] | None = None  # what is to be stopped, and why (a key of `protocol.CODES`)

    def run(self, number: Id, work: Callable[[], Any]) -> Any:
        """What the work gives.

        Raises:
            ProtocolError: it was stopped.
        """
        reason = ""
        try:
            self._running = (key_of(number), time.monotonic())
            found = work()
            self._running = None  # from here on nothing stops it
            return found
        except _Stop as stop:
            reason = str(stop)
        finally:
            self._running = None
        raise stopped(reason, self.longest)

    def stop(self, number: Id, reason: str = "cancelled") -> None:
        """Stop the work of that id, if it runs. Called from another thread."""
        running = self._running
        if running is not None and running[0] == key_of(number):
            self._interrupt(running[0], reason)

    @contextmanager
    def ready(self) -> Iterator[None]:
        """While it lasts, an interrupt of ours stops the work it is meant for; one of the user's stays what it is."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        over = threading.Event()
        before = signal.signal(signal.SIGINT, self._interrupted)
        threading.Thread(target=self._watch, args=(over,), daemon=True).start()
        try:
            yield
        finally:
            over.set()
            signal.signal(signal.SIGINT, before)

    def _interrupted(self, number: int, frame: FrameType | None) -> None:
        wanted, self._wanted = self._wanted, None
        if wanted is None:
            raise KeyboardInterrupt
        if self._running is not None and self._running[0] == wanted[0]:
            raise _Stop(wanted[1])

    def _interrupt(self, key: Key, reason: str) -> None:
        self._wanted = (key, reason)
        _thread.interrupt_main(signal.SIGINT)

    def _watch(self, over: threading.Event) -> None:
        while not over.wait(_TICK):
            running = self._running
            if running is not None and time.monotonic() - running[1] > self.longest:
                self._interrupt(running[0], "limit")


def stopped(reason: str, longest: float = 0.0) -> ProtocolError:
    """The mistake of a request that was stopped."""
    if reason == "limit":
        return ProtocolError("limit", f"stopped after {longest:g} s, the limit of a request; the answer is unknown")
    return ProtocolError("cancelled", "cancelled")
