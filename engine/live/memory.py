"""When Python's garbage collector walks: not through what was loaded, between two episodes, and not within a step.

A domain is hundreds of thousands of objects, and a collection that walks through them all is the longest pause that a
step of the mind can have; one through what an hour has brought is the longest that is left. Programs that load first
and then go on for ever call `keep_loaded` between the two, and hear events through `tidied`.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator

from casper.engine.events.event import Event


def keep_loaded() -> None:
    """What there is now is never looked at by the collector again (what nobody holds any more still goes)."""
    gc.freeze()


class Uninterrupted:
    """While this lasts the collector waits; where it was switched off it stays so."""

    __slots__ = ("_was_on",)

    def __enter__(self) -> None:
        self._was_on = gc.isenabled()
        gc.disable()

    def __exit__(self, *_: object) -> None:
        if self._was_on:
            gc.enable()


def tidied(events: Iterable[Event]) -> Iterator[Event]:
    """The same events; after one that ends an episode what nobody holds any more goes."""
    for event in events:
        yield event
        if event.type == "episode":
            gc.collect()
