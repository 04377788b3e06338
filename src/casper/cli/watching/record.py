"""``casper record``: keep what a stream brings, without reading it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from casper.cli.terminal.options import (
    AsJson,
    DomainName,
    Goals,
    Language,
    Listens,
    Noise,
    PolicyName,
    Quiet,
    Reconnect,
    SourceName,
    Stops,
    Unverified,
    Window,
)


def record(
    domain: DomainName,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Where to: .jsonl, or .jsonl.gz.")],
    source: SourceName = "-",
    no_verification: Unverified = False,
    policy: PolicyName = "strict",
    noise: Noise = None,
    goals: Goals = 1,
    stop: Stops = False,
    window: Window = None,
    listen: Listens = False,
    reconnect: Reconnect = 0.0,
    language: Language = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Record world states as casper watch would take them in; casper replay reads them, with these options.

    What is left out is told. Exit code 1 when a connection was lost before it was ended.
    """
    from casper.cli.terminal.output import print_json
    from casper.cli.terminal.showing import complain
    from casper.cli.watching.streaming import opened
    from casper.engine.domain.domain import Domain
    from casper.engine.live import Partners
    from casper.streams.recordings.header import header_of
    from casper.streams.recordings.writing import check_recording, recording
    from casper.streams.watching import recorded

    check_recording(file)
    loaded = Domain.load(domain, language)
    chosen = {"verification": not no_verification, "policy": policy, "noise": noise, "goals": goals, "stops": stop}
    Partners(loaded, **chosen)  # a mistake in the options is told before anything is recorded
    stream, seconds = opened(source, listen, reconnect, window)
    left_out = 0
    with recording(file, header_of(loaded, language, chosen)) as writer:
        assert writer is not None
        for event in recorded(writer, stream.items(), loaded, seconds):
            left_out += 1
            if as_json:
                print_json(event.to_json())
            else:
                complain(event.data["message"])
    if as_json:
        print_json({"file": str(file), "states": writer.states, "seconds": writer.seconds, "warnings": left_out})
    elif not quiet:
        print(f"{file}: {writer.states} world states of {writer.seconds:g} s, {left_out} warnings")
    raise typer.Exit(1 if stream.lost else 0)
