"""Arguments and options that several commands share."""

from __future__ import annotations

from typing import Annotated

import typer

DomainName = Annotated[str, typer.Argument(help="A shipped domain (kitchen) or the folder of one.", metavar="DOMAIN")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object a line.")]
Unverified = Annotated[bool, typer.Option("--no-verification", help="Never ask the knowledge base about observations.")]
PolicyName = Annotated[str, typer.Option("--policy", help="When to commit to a goal: strict or best.")]
Noise = Annotated[
    float | None,
    typer.Option("--noise", metavar="PRICE", help="Allow needless actions: the factor each one multiplies a score by."),
]
Goals = Annotated[int, typer.Option("--goals", metavar="N", help="How many goals may be pursued at once.")]
Stops = Annotated[bool, typer.Option("--stop", help="Stop at an action that fits no plan, instead of leaving it out.")]
Language = Annotated[
    str | None,
    typer.Option("--language", metavar="L", help="Tell reasons in this language, as far as the domain words them: fr."),
]
