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
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.pacing import check_speed, paced
    from casper.cli.terminal.showing import complain, show
    from casper.engine.events.timeline import Timeline
    from casper.engine.live.memory import keep_loaded, tidied
    from casper.report.writing import reporting
    from casper.streams.recordings.replaying import Replay

    check_speed(speed)
    again = Replay(file, domain)
    for difference in again.differences:
        complain(difference)
    loaded, minds = again.domain, again.minds
    out, timeline = console(), Timeline(loaded.partner, loaded.robot, loaded.kb.words)
    keep_loaded()
    with reporting(loaded, report) as recorder:
        if not as_json and not quiet and again.header.seed is not None:
            show(out, timeline.open(loaded.name, again.header.seed))
        for event in tidied(paced(again.events(), speed, None)):
            if recorder is not None:
                recorder.see(minds.tracker.latest)
                recorder.take(event, minds)
            if as_json:
                print_json(event.to_json())
            elif not quiet or event.type == "summary":
                show(out, timeline.lines(event))
    if again.end:
        complain(again.end)
    if again.is_same is False:
        complain("the events are not those that were recorded")
        raise typer.Exit(1)
