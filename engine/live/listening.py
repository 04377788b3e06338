"""Whoever listens to a run: sees the world states, and hears each event while the minds know what stood behind it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence

from casper.engine.events.event import Event
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState


class Listener(ABC):
    """Takes in what it is handed of one run, in order."""

    def __init__(self) -> None:
        self._latest: float | None = None  # time of the last world state, in seconds

    def see(self, world: WorldState | None) -> None:
        """A world state; one that is no later than the last is left out."""
        if world is not None and (self._latest is None or world.t > self._latest):
            self._latest = world.t
            self.seen(world)

    @abstractmethod
    def seen(self, world: WorldState) -> None:
        """A world state that is later than all before."""

    @abstractmethod
    def take(self, event: Event, minds: Partners | Mind) -> None:
        """An event, while the minds still know what stood behind it."""

    def heard(self, events: Iterable[Event], minds: Partners | Mind) -> Iterator[Event]:
        """The events of a run, taken on their way."""
        for event in events:
            self.take(event, minds)
            yield event


def followed(
    events: Iterable[Event], listeners: Sequence[Listener], minds: Callable[[], Partners | Mind]
) -> Iterator[Event]:
    """The events on their way, taken by listeners who see what the minds see.

    Args:
        events: in the order of time.
        listeners: are shown the world as the minds' tracker tells it, then handed the event.
        minds: who are watching when an event comes; they may be made anew in between.
    """
    for event in events:
        for listener in listeners:
            listener.see(minds().tracker.latest)
            listener.take(event, minds())
        yield event
