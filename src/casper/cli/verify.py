"""``casper verify``: is it valid, and why or why not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from casper.cli.options import AsJson, DomainName

if TYPE_CHECKING:
    from casper.kb.base import KnowledgeBase
    from casper.kb.reasons.validity import Verdict


def verify(
    domain: DomainName,
    statements: Annotated[list[str], typer.Argument(help='Such as "eat(human, biscuits, plate)"; _ is unknown.')],
    as_json: AsJson = False,
) -> None:
    """Judge statements, each with its proof, or with the reasons against it and what would mend it."""
    from casper.cli.output import print_json
    from casper.engine.domain.domain import Domain
    from casper.kb.errors import DomainError

    loaded = Domain.load(domain)
    if not loaded.verifies:
        raise DomainError(f"the domain {loaded.name} has no ontology.pl, so it verifies nothing; write one")
    all_valid = True
    for text in statements:
        verdict = loaded.kb.verify(text)
        all_valid = all_valid and verdict.valid is True
        if as_json:
            print_json(_json(text, verdict, loaded.kb))
        else:
            _show(verdict, loaded.kb)
    raise typer.Exit(0 if all_valid else 1)


def _json(text: str, verdict: Verdict, kb: KnowledgeBase) -> dict[str, Any]:
    proof = kb.why(verdict.completed) if verdict.valid else None
    return {
        "statement": text,
        "valid": verdict.valid,
        "completed": repr(verdict.completed) if verdict.valid else None,
        "proof": proof.to_json() if proof is not None else None,
        "reasons": list(verdict.reasons),
        "repair": [repair.to_json() for repair in kb.repair(verdict.statement)] if verdict.valid is False else [],
    }


def _show(verdict: Verdict, kb: KnowledgeBase) -> None:
    from casper.cli.output import console, escape
    from casper.kb.terms.syntax import term_text
    from casper.kb.terms.terms import as_term

    out, statement = console(), escape(term_text(as_term(verdict.statement)))
    if verdict.valid:
        out.print(f"[green]✔[/] {statement} is valid")
        if verdict.completed != verdict.statement:
            out.print(f"  so it is {escape(term_text(as_term(verdict.completed)))}")
        out.print("\n".join(f"  {escape(line)}" for line in str(kb.why(verdict.completed)).splitlines()))
        return
    word = "is not valid" if verdict.valid is False else "is unknown"
    out.print(f"[red]✘[/] {statement} {word}")
    for reason in verdict.reasons:
        out.print(f"  because {escape(reason)}")
    for repair in kb.repair(verdict.statement) if verdict.valid is False else []:
        out.print(f"  it would be: {escape(str(repair))}")
