"""``casper import``: ontologies of the web become a folder of text."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from casper.cli.terminal.options import AsJson


def import_(
    files: Annotated[list[Path], typer.Argument(metavar="FILE… FOLDER", help="Ontologies, then where the text goes.")],
    replace: Annotated[bool, typer.Option("--replace", help="Write over a text that is there already.")] = False,
    as_json: AsJson = False,
) -> None:
    """Turn OWL 2 RL and SWRL (.owl .rdf .ttl .nt .owx .ofn) into a folder of readable text.

    What no rule can say is listed with its place. Exit code 0, or 1 when the ontology contradicts itself.
    """
    from casper.cli.authoring.check import show_findings
    from casper.cli.terminal.extras import needs
    from casper.cli.terminal.output import console
    from casper.cli.terminal.showing import say
    from casper.kb.checks.finding import Severity
    from casper.kb.errors import DomainError

    *sources, folder = files
    if not sources:
        raise DomainError("there is nothing to import: give one or more files, and then the folder for the text")
    if folder.suffix and not folder.is_dir() and folder.is_file():
        raise DomainError(f"{folder} is a file; the last argument is the folder for the text")
    needs("rdflib", "owl")
    from casper.kb.ontologies.importing import import_ontologies

    findings = import_ontologies(sources).write(folder, replace=replace)
    show_findings(findings, [source.resolve().parent for source in sources], as_json)
    if not as_json:
        say(console(), f"written to {folder}")
    raise typer.Exit(1 if any(f.severity is Severity.ERROR for f in findings) else 0)
