"""``casper train``: learn the movements from trials, simulated or recorded, and write them as clauses."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Quiet


def train(
    domain: DomainName,
    trials: Annotated[int, typer.Option(min=2, max=1000, help="Scripted trials to learn from.")] = 10,
    seed: Annotated[int, typer.Option(help="Of the trials and the tree; the same seed gives the same file.")] = 1,
    leaves: Annotated[int | None, typer.Option(min=2, help="Leaves the tree may have; 5, with --timed 64.")] = None,
    timed: Annotated[
        bool,
        typer.Option("--timed", help="Look back, too: how long the hand has been full, whether it has been carried."),
    ] = False,
    noise: Annotated[
        list[float] | None, typer.Option(metavar="METRES", help="Of a sensor to learn for; may be repeated.")
    ] = None,
    period: Annotated[
        list[float] | None, typer.Option(metavar="SECONDS", help="Between its world states; may be repeated.")
    ] = None,
    trace: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="Learn from labelled recordings instead (.jsonl, .csv, .parquet)."),
    ] = None,
    plans: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="Learn the prices of plans instead, from a recorded day; may be repeated."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="Where to write; movements.pl of the domain, and prices on the screen.")
    ] = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Learn which movement it is from qualitative relations, judged by leaving one trial out.

    With --noise and --period each trial is seen through a sensor of each; with --timed through four noises at three
    rates. The accuracy is told by sensor, also where it was left out of what was learned from.

    With --trace: from recordings of your own, a world state a line with what was done under "movement" (and perhaps
    "trial" and "level", the sensor); or tables with the columns t, name, x, y, heading, holding and movement.

    With --plans: what it costs to begin, give up, add and skip, from recorded days. A file holds a day, one JSON object
    a line: {"action": "eat(biscuits, plate)", "t": 3.5, "agent": "human", "goal": "breakfast"}, all but the action as
    far as it is known; the goal of an action that serves none is null.
    """
    if plans:
        from casper.cli.authoring.prices import learn_prices

        learn_prices(domain, plans, output, quiet, as_json)
        return
    from casper.cli.authoring.movements import Lesson, learn_movements

    lesson = Lesson(trials, seed, leaves, timed, noise or (), period or (), trace or ())
    learn_movements(domain, lesson, output, quiet, as_json)
