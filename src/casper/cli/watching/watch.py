"""``casper watch``: read world states (JSON lines) from a stream, so that any robot can feed the mind.

A robot may say in between what it did of its part, as ``casper run`` prints it, with the status ``done`` or ``failed``:
``{"type": "robot", "t": 40.0, "action": "wash(plate, sink)", "status": "done"}``.
"""

from __future__ import annotations

from typing import Annotated

import typer

from casper.cli.terminal.options import (
    AsJson,
    Certainty,
    DomainName,
    Goals,
    Language,
    Listens,
    Noise,
    PolicyName,
    Reconnect,
    Record,
    Report,
    Rerun,
    SourceName,
    Stops,
    Unverified,
    Window,
)


def watch(
    domain: DomainName,
    source: SourceName = "-",
    no_verification: Unverified = False,
    policy: PolicyName = "strict",
    noise: Noise = None,
    goals: Goals = 1,
    certainty: Certainty = None,
    stop: Stops = False,
    window: Window = None,
    listen: Listens = False,
    reconnect: Reconnect = 0.0,
    reload: Annotated[bool, typer.Option("--reload", help="Read the domain anew when its files change.")] = False,
    language: Language = None,
    report: Report = None,
    record: Record = None,
    rerun: Rerun = None,
    as_json: AsJson = False,
) -> None:
    """Watch partners through world states from standard input, a file or a socket; a bad line is told and left out.

    Exit code 1 when a connection was lost before it was ended.
    """
    from casper.cli.watching.streaming import opened
    from casper.cli.watching.telling import Teller, listening
    from casper.engine.domain.domain import Domain
    from casper.engine.live import Live, Partners
    from casper.engine.live.listening import followed
    from casper.engine.live.memory import keep_loaded, tidied
    from casper.streams.recordings.header import header_of
    from casper.streams.recordings.writing import check_recording, recording
    from casper.streams.watching import watched

    if record is not None:
        _check_reload(reload)
        check_recording(record)
    loaded = Domain.load(domain, language)
    chosen = {"verification": not no_verification, "policy": policy, "noise": noise, "goals": goals, "stops": stop}
    chosen["certainty"] = certainty
    live = Live(Partners(loaded, **chosen))
    stream, seconds = opened(source, listen, reconnect, window)
    teller = Teller(loaded, as_json)
    keep_loaded()
    written = recording(record, header_of(loaded, language, chosen))
    with written as writer, listening(loaded, report, rerun) as listeners:
        events = watched(live, stream.items(), reload, seconds, writer)
        events = tidied(events if writer is None else writer.heard(events))
        for event in followed(events, listeners, lambda: live.mind):
            teller.tell(event)
    raise typer.Exit(1 if stream.lost else 0)


def _check_reload(reload: bool) -> None:
    from casper.kb.errors import CasperError

    if reload:
        raise CasperError("--record and --reload do not go together: a recording is of one domain")
