"""``casper explain``: what goals a row of observed actions speaks for."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from casper.cli.terminal.options import AsJson, DomainName, Goals, Language, Noise, PolicyName, Quiet, Unverified
from casper.kb.errors import CasperError

if TYPE_CHECKING:
    from casper.engine.reading.reading import Reading
    from casper.kb.text.lines import Line


def explain(
    domain: DomainName,
    actions: Annotated[list[str], typer.Argument(help='In order: "eat" or "eat(biscuits, plate)".')],
    policy: PolicyName = "strict",
    top: Annotated[int, typer.Option(min=0, help="How many of the best explanations to show.")] = 3,
    no_verification: Unverified = False,
    noise: Noise = None,
    goals: Goals = 1,
    questions: Annotated[
        int, typer.Option("--questions", min=0, metavar="N", help="Show the N questions whose answer would tell most.")
    ] = 0,
    picture: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the best explanations of all actions: .svg, .png or .pdf.")
    ] = None,
    changes: Annotated[
        float | None,
        typer.Option(
            "--changes",
            metavar="PRICE",
            help="Goal after goal, several at once, or given up at this price: an explanation is a row of episodes.",
        ),
    ] = None,
    language: Language = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Explain observed actions: after each one, the goals, the best explanations, and why the others are out."""
    from casper.cli.terminal.hints import hint
    from casper.engine.domain.domain import Domain

    if changes is not None:
        if picture is not None or questions:
            raise CasperError("--changes explains by rows of episodes: leave --picture and --questions out")
        day = Domain.load(domain, language).day(abandon=changes, needless=noise, verification=not no_verification)
        for action in actions:
            day.observe(action)
            _tell(day.to_json(top) if as_json else day.lines(top))
        return
    if picture is not None:
        from casper.engine.explanation.pictures import check_picture

        check_picture(picture)
    loaded = Domain.load(domain, language)
    reading = loaded.reading(policy, verification=not no_verification, noise=noise, goals=goals)
    for action in actions:
        reading.observe(action)
        _tell(_json(reading, top, questions) if as_json else reading.lines(top, questions))
    if not reading.count and not no_verification:
        hint(loaded, actions, quiet)
    if picture is not None:
        from casper.engine.explanation.pictures import save_picture

        save_picture([part for explanation in reading.best(max(top, 1)) for part in explanation.parts], picture)


def _json(reading: Reading, top: int, questions: int) -> dict[str, Any]:
    """A reading's data, with the questions to ask where some are wanted."""
    asked = {"questions": [q.to_json() for q in reading.questions()[:questions]]} if questions else {}
    return {**reading.to_json(top), **asked}


def _tell(told: dict[str, Any] | Iterator[Line]) -> None:
    """Print what was read after an action: its data, or its lines."""
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import show

    if isinstance(told, dict):
        print_json(told)
    else:
        show(console(), told)
