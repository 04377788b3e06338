"""``casper import``: ontologies of the web, and problems of planners, become a folder of text."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Protocol

import typer

from casper.cli.terminal.options import AsJson, Quiet

if TYPE_CHECKING:
    from casper.kb.checks.finding import Finding

FILES = "Ontologies, or a domain and a problem, or recordings; then where it goes."
PLANNING = frozenset({".pddl", ".hddl"})
RECORDED = frozenset({".mcap"})


class Imported(Protocol):
    """Texts that can be written."""

    def write(self, folder: Path, *, replace: bool = False) -> list[Finding]:
        """Write them; what is not in them comes back."""


def import_(
    files: Annotated[list[Path], typer.Argument(metavar="FILE… FOLDER", help=FILES)],
    replace: Annotated[bool, typer.Option("--replace", help="Write over a text that is there already.")] = False,
    names: Annotated[
        Path | None, typer.Option(metavar="FILE.pl", help="MCAP: what frames are called; agent(human, FRAME).")
    ] = None,
    period: Annotated[
        float | None, typer.Option(metavar="S", help="MCAP: seconds from one world state to the next (usually 0.1).")
    ] = None,
    agent: Annotated[str | None, typer.Option(help="PDDL: the type of those who act (else anybody may).")] = None,
    partner: Annotated[str | None, typer.Option(help="PDDL: who is watched.")] = None,
    robot: Annotated[str | None, typer.Option(help="PDDL: who helps.")] = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Turn ontologies (.owl .rdf .ttl .nt .owx .ofn), planning (.pddl .hddl) or ROS 2 recordings (.mcap) into text.

    Ontologies and planning become a domain, recordings world states for casper watch. What cannot be said is listed
    with its place. Exit code 0, or 1 when the ontology contradicts itself, the plans mean nothing, or nobody is in a
    recording.
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
        if any(source.suffix.lower() in RECORDED for source in sources):
            _only(sources, RECORDED, "MCAP file")
            found = _recordings(sources, names, period, agent, (partner, robot))
        elif names is not None or period is not None:
            raise DomainError("--names and --period are about .mcap files, and these are none")
        else:
            found = _imported(sources, agent, partner, robot)
        findings = found.write(folder, replace=replace)
    show_findings(findings, [source.resolve().parent for source in sources], as_json)
    if not as_json and not quiet:
        say(console(), f"written to {folder}")
    raise typer.Exit(1 if any(f.severity is Severity.ERROR for f in findings) else 0)


def _imported(sources: list[Path], agent: str | None, partner: str | None, robot: str | None) -> Imported:
    """What the files say, by their kind."""
    from casper.cli.terminal.extras import needs
    from casper.kb.errors import DomainError

    if any(source.suffix.lower() in PLANNING for source in sources):
        _only(sources, PLANNING, "PDDL or HDDL")
        needs("unified_planning", "planning")
        from casper.planning.importing.files import import_files
        from casper.planning.importing.vocabulary import Who

        return import_files(sources, Who(agent, partner, robot))
    if agent or partner or robot:
        raise DomainError("--agent, --partner and --robot are about PDDL and HDDL, and these are ontologies")
    needs("rdflib", "owl")
    from casper.kb.ontologies.importing import import_ontologies

    return import_ontologies(sources)


def _only(sources: list[Path], kinds: frozenset[str], called: str) -> None:
    from casper.kb.errors import DomainError

    other = next((source for source in sources if source.suffix.lower() not in kinds), None)
    if other is not None:
        raise DomainError(f"{other} is no {called}: import files of different kinds into folders of their own")


def _recordings(
    sources: list[Path],
    file: Path | None,
    period: float | None,
    agent: str | None,
    people: tuple[str | None, str | None],
) -> Imported:
    """Recordings of ROS 2; without a file of names, partner and robot are the names of their frames."""
    from casper.cli.terminal.extras import needs
    from casper.kb.errors import DomainError

    if agent is not None or (file is not None and any(people)):
        raise DomainError("who acts in a recording is said by --names, or by --partner FRAME and --robot FRAME")
    if period is not None and not 0.001 <= period <= 3600:
        raise DomainError(f"the period is a number of seconds from 0.001 to 3600, not {period}")
    needs("mcap_ros2", "mcap")
    from casper.streams.ros.importing import PERIOD, Recordings
    from casper.streams.ros.names import Names, read_names

    who = {name: name for name in people if name is not None} or {"human": "human"}
    names = Names(who) if file is None else read_names(file)
    return Recordings(sources, names, PERIOD if period is None else period)
