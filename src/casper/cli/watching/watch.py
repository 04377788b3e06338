"""``casper watch``: read world states (JSON lines) from standard input, so that any robot can feed the mind."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Goals, Noise, PolicyName, Stops, Unverified

if TYPE_CHECKING:
    from casper.engine.events import Event
    from casper.engine.mind import Mind


def watch(
    domain: DomainName,
    no_verification: Unverified = False,
    policy: PolicyName = "strict",
    noise: Noise = None,
    goals: Goals = 1,
    stop: Stops = False,
    reload: Annotated[bool, typer.Option("--reload", help="Read the domain anew when its files change.")] = False,
    as_json: AsJson = False,
) -> None:
    """Watch a partner through world states on standard input; a bad line is reported and left out."""
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import show
    from casper.engine.domain.domain import Domain
    from casper.engine.events.timeline import Timeline
    from casper.engine.mind import Mind

    loaded = Domain.load(domain)
    mind = Mind(loaded, verification=not no_verification, policy=policy, noise=noise, goals=goals, stops=stop)
    out, timeline = console(), Timeline(loaded.partner, loaded.robot)
    for event in watched(mind, sys.stdin, reload):
        if as_json:
            print_json(event.to_json())
        else:
            show(out, timeline.lines(event))


def watched(mind: Mind, lines: Iterable[str], reload: bool = False) -> Iterator[Event]:
    """The mind's events for JSON lines of world states; a line that cannot be used becomes a ``warning``.

    With ``reload`` changes in the domain's files are taken in between two lines, and told as warnings, too.
    """
    from casper.engine.events import Event
    from casper.engine.live import Live
    from casper.engine.perception.world import world_state_from_json
    from casper.kb.errors import WorldStateError

    now, live = 0.0, Live(mind)
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        for message in live.refresh() if reload else ():
            yield Event("warning", now, {"message": message})
        try:
            world = world_state_from_json(line)
            events = live.mind.update(world)
            now = world.t
        except WorldStateError as mistake:
            yield Event("warning", now, {"message": f"line {number} is left out: {mistake.sentence}"})
            continue
        yield from events
    yield Event("summary", now, live.mind.summary())
