"""``casper run``: simulate a partner, watch, predict, help."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import (
    AsJson,
    Certainty,
    DomainName,
    Goals,
    Language,
    Noise,
    PolicyName,
    Quiet,
    Record,
    Report,
    Rerun,
    Robot,
    Speed,
    Unverified,
)

if TYPE_CHECKING:
    from casper.engine.events import Event
    from casper.sim_adapter.trial import Trial
    from casper.streams.recordings.writing import Writer


def _goals(incomplete: str) -> list[str]:
    """The goals of the domain that was typed before, for completion in a shell."""
    from casper.cli.terminal.completing import goals, typed_domain

    return goals(typed_domain("run"), incomplete)


def _behaviours(incomplete: str) -> list[str]:
    from casper.cli.terminal.completing import behaviours

    return behaviours(incomplete)


def run(
    domain: DomainName,
    goal: Annotated[
        list[str] | None,
        typer.Option(
            help="What the partner is after, one goal after the other; by default drawn from the seed.",
            autocompletion=_goals,
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Of the start, the partner's pace and the sensor's noise.")] = 0,
    no_verification: Unverified = False,
    no_robot: Annotated[bool, typer.Option("--no-robot", help="Watch and predict only.")] = False,
    robot: Robot = "primitive",
    policy: PolicyName = "strict",
    noise: Noise = None,
    goals: Goals = 1,
    goals_in_a_row: Annotated[
        int | None, typer.Option("--goals-in-a-row", metavar="N", help="How many goals, one after the other.")
    ] = None,
    changes_mind: Annotated[
        bool, typer.Option("--changes-mind", help="The first goal is given up for the next after its first action.")
    ] = False,
    certainty: Certainty = None,
    partner: Annotated[
        str,
        typer.Option(
            metavar="HOW",
            help="How the partner behaves: plain; "
            "alone (does everything, whatever the robot announces), blocking (stands in the way), "
            "eager (does some of what the robot announced), fickle (goes over to another goal), "
            "forgetful (leaves a step out, comes back to it), juggling (two goals at once), "
            "misplacing (puts a thing elsewhere first), pausing, visited (somebody else moves things), "
            "wandering (handles what is not needed); several with commas; mixed draws one from the seed.",
            autocompletion=_behaviours,
        ),
    ] = "plain",
    speed: Speed = 0.0,
    language: Language = None,
    report: Report = None,
    record: Record = None,
    rerun: Rerun = None,
    video: Annotated[
        Path | None, typer.Option(metavar="FILE.mp4", help="Film it, four times as fast as it was (needs [video]).")
    ] = None,
    view: Annotated[
        bool, typer.Option("--view", help="Watch it in MuJoCo's viewer where there is a screen, in real time.")
    ] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Simulate a partner in the domain's room, read their goals, and do the robot's part."""
    from casper.cli.terminal.extras import needs
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.pacing import check_speed, paced
    from casper.cli.terminal.progress import progress
    from casper.cli.terminal.showing import show
    from casper.engine.domain.domain import Domain
    from casper.engine.events.timeline import Timeline
    from casper.engine.live.memory import keep_loaded, tidied
    from casper.report.writing import check_page, reporting
    from casper.rrd.writing import check_rrd, logging
    from casper.streams.recordings.header import header_of
    from casper.streams.recordings.writing import check_recording, recording

    check_speed(speed)
    loaded = Domain.load(domain, language)
    needs("mujoco", "sim")
    if video is not None:
        _without_a_screen()
    from casper.sim_adapter.eye.film import check_film, filming
    from casper.sim_adapter.eye.viewer import check_screen, viewing
    from casper.sim_adapter.trial import Trial, TrialSettings

    day = (",".join(goal) if goal else None, seed, not no_verification, not no_robot, policy, noise, goals)
    if video is not None:
        check_film(video)
    if view:
        check_screen()
    if report is not None:
        check_page(report)
    if record is not None:
        check_recording(record)
    if rerun is not None:
        check_rrd(rerun)
    trial = Trial(loaded, TrialSettings(*day, goals_in_a_row, changes_mind, certainty, partner, robot))
    out, timeline = console(), Timeline(loaded.partner, loaded.robot, loaded.kb.words)
    header = header_of(loaded, language, trial.minds.choices, seed)
    keep_loaded()
    waits = progress("simulating", None, quiet or sys.stdout.isatty())
    pace = speed or (1.0 if view else 0.0)
    seen = filming(trial.simulation, video), viewing(trial.simulation, pace if view else None)
    shown = reporting(loaded, report), logging(loaded, rerun)
    with recording(record, header) as writer, seen[0], seen[1], shown[0] as page, shown[1] as log, waits:
        if not as_json and not quiet:
            show(out, timeline.open(loaded.name, seed))
        events = trial.events() if writer is None else _recorded(trial, writer)
        listeners = [listener for listener in (page, log) if listener is not None]
        if listeners:
            trial.each_step = lambda: [listener.see(trial.simulation.truth()) for listener in listeners]
        for listener in listeners:
            events = listener.heard(events, trial.minds)
        for event in tidied(paced(events, pace)):
            if as_json:
                print_json(event.to_json())
            elif not quiet or event.type == "summary":
                show(out, timeline.lines(event))


def _without_a_screen() -> None:
    """MuJoCo is told how to draw where there is no screen; it asks when it is imported."""
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        os.environ.setdefault("MUJOCO_GL", "egl")


def _recorded(trial: Trial, writer: Writer) -> Iterator[Event]:
    """The events of a trial, and what a replay needs of it on the way into a recording."""
    trial.sensed = writer.given
    for event in writer.heard(trial.events()):
        yield event if _is_of_a_mind(event) else writer.aside(event)


def _is_of_a_mind(event: Event) -> bool:
    """Whether a replay makes it again: what the body does, and says on its way, no mind knows of."""
    if event.type == "says":
        return "goal" in event.data  # a mind announces, a body asks to be let through
    return event.type not in ("robot", "summary")
