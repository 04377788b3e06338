"""``casper verify``: is it valid, and why or why not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Language, Quiet

if TYPE_CHECKING:
    from casper.kb.base import KnowledgeBase
    from casper.kb.reasons.validity import Verdict


def verify(
    domain: DomainName,
    statements: Annotated[list[str], typer.Argument(help='Such as "eat(human, biscuits, plate)"; _ is unknown.')],
    language: Language = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Judge statements, each with its proof, or with the reasons against it and what would mend it."""
    from casper.cli.terminal.hints import hint
    from casper.cli.terminal.output import print_json
    from casper.engine.domain.domain import Domain
    from casper.kb.errors import DomainError
    from casper.server.answers import verdict_json

    loaded = Domain.load(domain, language)
    if not loaded.verifies:
        raise DomainError(f"the domain {loaded.name} has no ontology.pl, so it verifies nothing; write one")
    all_valid = True
    for text in statements:
        verdict = loaded.kb.verify(text)
        all_valid = all_valid and verdict.valid is True
        if as_json:
            print_json(verdict_json(loaded.kb, text, verdict))
        else:
            _show(verdict, loaded.kb)
    if not all_valid:
        hint(loaded, statements, quiet)
    raise typer.Exit(0 if all_valid else 1)


def _show(verdict: Verdict, kb: KnowledgeBase) -> None:
    from casper.cli.terminal.output import console
    from casper.cli.terminal.showing import show
    from casper.kb.text.lines import indented, line, lines_of

    out, proof = console(), kb.why(verdict.completed) if verdict.valid else None
    show(out, verdict.lines())
    if proof is not None:
        show(out, indented(lines_of(str(proof))))
    for repair in kb.repair(verdict.statement) if verdict.valid is False else []:
        show(out, [line(f"  it would be: {repair}")])
