"""A mind, or those of all partners, over a stream: events, and a ``warning`` for whatever could not be taken in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from casper.engine.events import Event
from casper.engine.live import Live, Partners, Report, heard
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState
from casper.kb.errors import WorldStateError
from casper.streams.items import Given, Item, Line, Note
from casper.streams.order.messages import messages
from casper.streams.order.sightings import Sightings
from casper.streams.order.window import in_order

if TYPE_CHECKING:
    from collections.abc import Callable


def watched(
    mind: Mind | Partners | Live,
    lines: Iterable[Line | Note | str],
    reload: bool = False,
    window: float = 0.0,
    taken: Callable[[WorldState | Report], object] | None = None,
) -> Iterator[Event]:
    """The events of a mind, or of those of all partners, for lines of JSON; the last one is the ``summary``.

    Args:
        mind: who watches; a `Live` one is followed when it is made anew.
        lines: of world states and reports, or their texts.
        reload: changes in the domain's files are taken in between two lines, and told as warnings, too.
        window: seconds by which a line may be late (`order.window`).
        taken: is handed what the mind takes in, before it does.
    """
    live = mind if isinstance(mind, Live) else Live(mind)
    return told(live, in_order(messages(numbered(lines)), window), reload, taken)


def numbered(lines: Iterable[Line | Note | str]) -> Iterator[Line | Note]:
    """Lines with their numbers, where they are texts alone."""
    for number, line in enumerate(lines, 1):
        if not isinstance(line, str):
            yield line
        elif line.strip():
            yield Line(line, number)


def told(
    live: Live,
    items: Iterable[Item],
    reload: bool = False,
    taken: Callable[[WorldState | Report], object] | None = None,
) -> Iterator[Event]:
    """As `watched`, of what is in order already."""
    now, sightings = 0.0, Sightings(live.mind.domain)
    for item in items:
        for change in live.refresh() if reload else ():
            yield _warning(now, change)
        if isinstance(item, Note):
            yield _warning(now, item.sentence)
            continue
        message = item.message
        sentences: list[str] = []
        if isinstance(message, WorldState):
            message, sentences = sightings.update(message)
        try:
            if taken is not None:
                taken(message)
            events = heard(live.mind, message)
        except WorldStateError as mistake:
            yield _warning(now, _refused(item, mistake.sentence))
            continue
        now = message.t
        yield from (_warning(now, f"{item.where}: {sentence}") for sentence in sentences)
        yield from events
    yield from live.mind.end(now)
    yield Event("summary", now, live.mind.summary())


def _warning(t: float, message: str) -> Event:
    return Event("warning", t, {"message": message})


def _refused(item: Given, why: str) -> str:
    return f"{item.where} is left out: {why}"
