"""``casper run``: simulate a partner, watch, predict, help."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

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
    from casper.cli.terminal.pacing import check_speed
    from casper.engine.domain.domain import Domain

    check_speed(speed)
    loaded = Domain.load(domain, language)
    needs("mujoco", "sim")
    if video is not None:
        _without_a_screen()
    from casper.cli.watching.simulating import Wanted, simulate
    from casper.cli.watching.telling import Teller
    from casper.sim_adapter.trial import TrialSettings

    wanted = Wanted(report, record, rerun, video, view)
    day = (",".join(goal) if goal else None, seed, not no_verification, not no_robot, policy, noise, goals)
    settings = TrialSettings(*day, goals_in_a_row, changes_mind, certainty, partner, robot)
    simulate(loaded, settings, wanted, speed, Teller(loaded, as_json, quiet), language)


def _without_a_screen() -> None:
    """MuJoCo is told how to draw where there is no screen; it asks when it is imported."""
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        os.environ.setdefault("MUJOCO_GL", "egl")
