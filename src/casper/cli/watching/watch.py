"""``casper watch``: read world states (JSON lines) from standard input, so that any robot can feed the mind.

A robot may say in between what it did of its part, as ``casper run`` prints it, with the status ``done`` or ``failed``:
``{"type": "robot", "t": 40.0, "action": "wash(plate, sink)", "status": "done"}``.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated, TextIO

import typer

from casper.cli.terminal.options import (
    AsJson,
    DomainName,
    Goals,
    Language,
    Noise,
    PolicyName,
    Report,
    Stops,
    Unverified,
)

if TYPE_CHECKING:
    from casper.engine.events import Event
    from casper.engine.live import Live, Partners
    from casper.engine.mind import Mind
    from casper.report.recorder import Recorder

LONGEST = 10_000_000  # characters of a world state


def watch(
    domain: DomainName,
    no_verification: Unverified = False,
    policy: PolicyName = "strict",
    noise: Noise = None,
    goals: Goals = 1,
    stop: Stops = False,
    reload: Annotated[bool, typer.Option("--reload", help="Read the domain anew when its files change.")] = False,
    language: Language = None,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Watch partners through world states on standard input; a bad line is reported and left out."""
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import show
    from casper.engine.domain.domain import Domain
    from casper.engine.events.timeline import Timeline
    from casper.engine.live import Partners
    from casper.engine.live.memory import keep_loaded
    from casper.report.writing import reporting

    loaded = Domain.load(domain, language)
    minds = Partners(loaded, verification=not no_verification, policy=policy, noise=noise, goals=goals, stops=stop)
    out, timeline = console(), Timeline(loaded.partner, loaded.robot, loaded.kb.words)
    keep_loaded()
    with reporting(loaded, report) as recorder:
        for event in watched(minds, _lines(sys.stdin), reload, recorder):
            if as_json:
                print_json(event.to_json())
            else:
                show(out, timeline.lines(event))


def watched(
    mind: Mind | Partners, lines: Iterable[str], reload: bool = False, recorder: Recorder | None = None
) -> Iterator[Event]:
    """The events of a mind, or of those of all partners, for JSON lines; one that cannot be used becomes a ``warning``.

    With ``reload`` changes in the domain's files are taken in between two lines, and told as warnings, too. A
    ``recorder`` sees the world as it is believed to be, and hears every event.
    """
    from casper.engine.live import Live

    live = Live(mind)
    for event in _told(live, lines, reload):
        if recorder is not None:
            recorder.see(live.mind.tracker.latest)
            recorder.take(event, live.mind)
        yield event


def _told(live: Live, lines: Iterable[str], reload: bool) -> Iterator[Event]:
    from casper.engine.events import Event
    from casper.engine.live import heard
    from casper.kb.errors import ReadError, WorldStateError

    now = 0.0
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        for message in live.refresh() if reload else ():
            yield Event("warning", now, {"message": message})
        try:
            _check_line(line)
            events, now = heard(live.mind, line, now)
        except (WorldStateError, ReadError) as mistake:
            yield Event("warning", now, {"message": f"line {number} is left out: {mistake.sentence}"})
            continue
        yield from events
    yield from live.mind.end(now)
    yield Event("summary", now, live.mind.summary())


def _lines(stream: TextIO) -> Iterator[str]:
    """The lines of a stream of JSON, which is UTF-8 whatever the terminal speaks; what is too long is cut."""
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(encoding="utf-8-sig", errors="surrogateescape")
    while line := stream.readline(LONGEST + 1):
        rest = line
        while rest and not rest.endswith("\n"):
            rest = stream.readline(LONGEST)
        yield line


def _check_line(line: str) -> None:
    """Refuse a line that is too long to be read, or that held bytes of no character."""
    from casper.kb.errors import WorldStateError

    if len(line.rstrip("\n")) > LONGEST:
        raise WorldStateError(f"it is longer than {LONGEST:,} characters")
    try:
        line.encode("utf-8")
    except UnicodeEncodeError as mistake:
        byte = ord(line[mistake.start]) & 0xFF
        sentence = f"it is not UTF-8 (byte 0x{byte:02x} at column {mistake.start + 1}); send JSON in UTF-8"
        raise WorldStateError(sentence) from None
