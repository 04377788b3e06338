"""A mind, or those of all partners, over a stream: events, and a ``warning`` for whatever could not be taken in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TypeAlias

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.live import Live, Partners, heard
from casper.engine.mind import Mind
from casper.kb.errors import WorldStateError
from casper.streams.items import Item, Line, Note
from casper.streams.order.messages import messages
from casper.streams.order.sightings import sighted
from casper.streams.order.window import in_order
from casper.streams.recordings.kept import Kept

Watching: TypeAlias = Mind | Partners | Live


def watched(
    mind: Watching,
    lines: Iterable[Line | Note | str],
    reload: bool = False,
    window: float = 0.0,
    kept: Kept | None = None,
    ahead: int = 1,
) -> Iterator[Event]:
    """The events of a mind, or of those of all partners, for lines of JSON; the last one is the ``summary``.

    Args:
        mind: who watches; a `Live` one is followed when it is made anew.
        lines: of world states and reports, or their texts.
        reload: changes in the domain's files are taken in between two lines, and told as warnings, too.
        window: seconds by which a line may be late (`order.window`).
        kept: is handed what the mind takes in, before it does, and the warnings that are not the mind's.
        ahead: how much is read before the mind takes in the first of it: reading many lines and then thinking is faster
            than both by turns, and nobody who watches a file waits for an answer.
    """
    live = mind if isinstance(mind, Live) else Live(mind)
    items = taken_in(lines, live.mind.domain, window)
    read = items if ahead == 1 else _by(ahead, items)
    return _told(live, read, reload, Kept() if kept is None else kept)


def taken_in(lines: Iterable[Line | Note | str], domain: Domain, window: float) -> Iterator[Item]:
    """What minds of a domain can take in, in order, and a sentence for all else."""
    return sighted(in_order(messages(_numbered(lines)), window), domain)


def recorded(kept: Kept, lines: Iterable[Line | Note | str], domain: Domain, window: float) -> Iterator[Event]:
    """Keep what minds of a domain would take in, without any; the warnings."""
    now = 0.0
    for item in taken_in(lines, domain, window):
        if isinstance(item, Note):
            yield kept.aside(warning(now, item.sentence))
        else:
            kept.given(item.message)
            now = item.message.t


def warning(t: float, message: str) -> Event:
    """A sentence about the stream as an event."""
    return Event("warning", t, {"message": message})


def _by(number: int, items: Iterator[Item]) -> Iterator[Item]:
    """The same, so many at once."""
    while some := list(islice(items, number)):
        yield from some


def _numbered(lines: Iterable[Line | Note | str]) -> Iterator[Line | Note]:
    """Lines with their numbers, where they are texts alone."""
    for number, line in enumerate(lines, 1):
        if not isinstance(line, str):
            yield line
        elif line.strip():
            yield Line(line, number)


def _told(live: Live, items: Iterable[Item], reload: bool, kept: Kept) -> Iterator[Event]:
    now = 0.0
    for item in items:
        for change in live.refresh() if reload else ():
            yield kept.aside(warning(now, change))
        if isinstance(item, Note):
            yield kept.aside(warning(now, item.sentence))
            continue
        kept.given(item.message)
        try:
            events = heard(live.mind, item.message)
        except WorldStateError as mistake:
            yield kept.aside(warning(now, f"{item.where} is left out: {mistake.sentence}"))
            continue
        now = item.message.t
        yield from events
    yield from live.mind.end(now)
    yield Event("summary", now, live.mind.summary())
