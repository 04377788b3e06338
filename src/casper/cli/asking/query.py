"""``casper query``: answers in any direction."""

from __future__ import annotations

from typing import Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Quiet


def query(
    domain: DomainName,
    goal: Annotated[str, typer.Argument(help='Such as "eat(A, T, D)" or "valid(S)"; capitals are asked for.')],
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after this many answers.")] = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Answer a question to a domain, whichever of its parts are known.

    Exit code 0 with an answer, 1 without any; names in the question that the domain has nowhere are told.
    """
    from casper.cli.terminal.hints import hint
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import say
    from casper.engine.domain.domain import Domain
    from casper.kb.text.writer import answer_json, answer_text

    out, found, loaded = console(), False, Domain.load(domain)
    for answer in loaded.kb.query(goal, limit):
        found = True
        if as_json:
            print_json(answer_json(answer))
        else:
            say(out, answer_text(answer))
    if not found:
        if not as_json:
            say(out, "no")
        hint(loaded, [goal], quiet)
        raise typer.Exit(1)
