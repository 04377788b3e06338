"""``casper replay``: a recording once more, at any speed, and whether the reading is the same."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from casper.cli.terminal.options import AsJson, Quiet, Report, Speed


def replay(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="What --record or casper record wrote.")],
    domain: Annotated[
        str | None, typer.Option(metavar="DOMAIN", help="Read it with this domain, not with the one that was recorded.")
    ] = None,
    speed: Speed = 0.0,
    report: Report = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Replay a recording: the same minds take in the same, and say the same, bit for bit.

    Exit code 1 when they said something else when it was recorded; what has changed since then is told.
    """
    from casper.cli.terminal.pacing import check_speed, paced
    from casper.cli.terminal.showing import complain
    from casper.cli.watching.telling import Teller, listening
    from casper.engine.live.listening import followed
    from casper.engine.live.memory import keep_loaded, tidied
    from casper.streams.recordings.replaying import Replay

    check_speed(speed)
    again = Replay(file, domain)
    for difference in again.differences:
        complain(difference)
    teller = Teller(again.domain, as_json, quiet)
    keep_loaded()
    with listening(again.domain, report) as listeners:
        if again.header.seed is not None:
            teller.open(again.header.seed)
        events = tidied(paced(again.events(), speed, None))
        for event in followed(events, listeners, lambda: again.minds):
            teller.tell(event)
    if again.end:
        complain(again.end)
    if again.is_same is False:
        complain("the events are not those that were recorded")
        raise typer.Exit(1)
