"""What is kept of a stream on its way: the plain one keeps nothing, `Writer` a recording."""

from __future__ import annotations

from casper.engine.events import Event
from casper.engine.live import Message


class Kept:
    """Keeps nothing."""

    def given(self, message: Message) -> None:
        """A mind is about to take this in."""

    def aside(self, event: Event) -> Event:
        """An event that no mind makes; it goes on its way."""
        return event
