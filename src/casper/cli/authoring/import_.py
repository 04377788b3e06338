"""``casper import``: ontologies of the web, and problems of planners, become a folder of text."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Protocol

import typer

from casper.cli.terminal.options import AsJson, Quiet

if TYPE_CHECKING:
    from casper.kb.checks.finding import Finding

FILES = "Ontologies, or a domain and a problem; then where the text goes."
PLANNING = frozenset({".pddl", ".hddl"})


class Imported(Protocol):
    """Texts that can be written."""

    def write(self, folder: Path, *, replace: bool = False) -> list[Finding]:
        """Write them; what is not in them comes back."""


def import_(
    files: Annotated[list[Path], typer.Argument(metavar="FILE… FOLDER", help=FILES)],
    replace: Annotated[bool, typer.Option("--replace", help="Write over a text that is there already.")] = False,
    agent: Annotated[str | None, typer.Option(help="PDDL: the type of those who act (else anybody may).")] = None,
    partner: Annotated[str | None, typer.Option(help="PDDL: who is watched.")] = None,
    robot: Annotated[str | None, typer.Option(help="PDDL: who helps.")] = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Turn ontologies (.owl .rdf .ttl .nt .owx .ofn) or planning (.pddl .hddl) into a folder of readable text.

    What no rule can say is listed with its place. Exit code 0, or 1 when the ontology contradicts itself, or the plans
    mean nothing.
    """
    from casper.cli.authoring.check import show_findings
    from casper.cli.terminal.output import console
    from casper.cli.terminal.progress import progress
    from casper.cli.terminal.showing import say
    from casper.kb.checks.finding import Severity
    from casper.kb.errors import DomainError

    *sources, folder = files
    if not sources:
        raise DomainError("there is nothing to import: give one or more files, and then the folder for the text")
    if folder.suffix and not folder.is_dir() and folder.is_file():
        raise DomainError(f"{folder} is a file; the last argument is the folder for the text")
    with progress("importing", None, quiet):
        findings = _imported(sources, agent, partner, robot).write(folder, replace=replace)
    show_findings(findings, [source.resolve().parent for source in sources], as_json)
    if not as_json and not quiet:
        say(console(), f"written to {folder}")
    raise typer.Exit(1 if any(f.severity is Severity.ERROR for f in findings) else 0)


def _imported(sources: list[Path], agent: str | None, partner: str | None, robot: str | None) -> Imported:
    """What the files say, by their kind."""
    from casper.cli.terminal.extras import needs
    from casper.kb.errors import DomainError

    planning = [source for source in sources if source.suffix.lower() in PLANNING]
    if planning and len(planning) < len(sources):
        other = next(source for source in sources if source not in planning)
        raise DomainError(f"{other} is no PDDL or HDDL: import ontologies and problems into folders of their own")
    if planning:
        needs("unified_planning", "planning")
        from casper.planning.importing.files import import_files
        from casper.planning.importing.vocabulary import Who

        return import_files(sources, Who(agent, partner, robot))
    if agent or partner or robot:
        raise DomainError("--agent, --partner and --robot are about PDDL and HDDL, and these are ontologies")
    needs("rdflib", "owl")
    from casper.kb.ontologies.importing import import_ontologies

    return import_ontologies(sources)
