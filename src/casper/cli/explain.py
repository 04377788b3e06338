"""``casper explain``: what goals a row of observed actions speaks for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.options import AsJson, DomainName, Goals, Noise, PolicyName, Unverified

if TYPE_CHECKING:
    from casper.engine.reading.reading import Reading


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
    as_json: AsJson = False,
) -> None:
    """Explain observed actions: after each one, the goals, the best explanations, and why the others are out."""
    from casper.cli.output import print_json
    from casper.engine.domain.domain import Domain

    if picture is not None:
        from casper.engine.explanation.pictures import check_picture

        check_picture(picture)
    reading = Domain.load(domain).reading(policy, verification=not no_verification, noise=noise, goals=goals)
    for action in actions:
        reading.observe(action)
        if as_json:
            asked = {"questions": [q.to_json() for q in reading.questions()[:questions]]} if questions else {}
            print_json({**reading.to_json(top), **asked})
        else:
            show(reading, top, questions)
    if picture is not None:
        from casper.engine.explanation.pictures import save_picture

        save_picture([part for explanation in reading.best(max(top, 1)) for part in explanation.parts], picture)


def show(reading: Reading, top: int, questions: int = 0) -> None:
    """Print a reading for a person: shares as bars, the best explanations as marked trees, what to ask."""
    from rich.cells import cell_len

    from casper.cli.output import bar, console, escape
    from casper.kb.terms.syntax import term_text
    from casper.kb.terms.terms import as_term
    from casper.plans.trees.tree import tree_text

    out = console()
    heading = " → ".join(map(str, reading.observations))
    out.print(f"[bold]{escape(heading)}[/] [dim]{'─' * (out.width - cell_len(heading) - 1)}[/]")
    best = reading.best(max(top, 1))
    plural = "" if reading.count == 1 else "s"
    least = "" if reading.is_exact else "at least "
    out.print(f"{least}{reading.count} explanation{plural}, confidence {best[0].share if best else 0.0:.2f}")
    for goal, share in reading.posterior.items():
        reasons = "; ".join(reading.rejected.get(goal, ()))
        note = f"  [dim]not this: {escape(reasons)}[/]" if reasons else ""
        out.print(f"  {escape(f'{goal:<12}')} [cyan]{bar(share)}[/] {share:.2f}{note}")
    verdict = f"[bold green]{escape(reading.outcome)}[/]" if reading.outcome else "undecided"
    out.print(f"outcome: {verdict}")
    for explanation in best[:top]:
        out.print(f"[dim]score {explanation.score:.3f}, share {explanation.share:.2f}[/]")
        for part in explanation.parts:
            out.print(escape(tree_text(part.tree())))
        if explanation.needless:
            needless = ", ".join(str(reading.observations[at]) for at in explanation.needless)
            out.print(f"needless: {escape(needless)}")
    if best and best[0].frontier:
        still = ", ".join(term_text(as_term(action)) for action in best[0].frontier)
        out.print(f"yet to come: {escape(still)}")
    for question in reading.questions()[:questions] if questions else ():
        out.print(f"ask: {escape(str(question))} [dim]({question.gain:.2f} bits, yes {question.yes:.2f})[/]")
