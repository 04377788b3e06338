"""``casper check``: every mistake in a domain at once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from casper.cli.terminal.options import AsJson, DomainName, Quiet

if TYPE_CHECKING:
    from casper.kb.checks.finding import Finding


def check(domain: DomainName, quiet: Quiet = False, as_json: AsJson = False) -> None:
    """Find mistakes in a domain: undefined names, rules that give nothing, plans nobody can do, and the like.

    Exit code 0 without errors (there may be warnings and notes), 1 with errors, 2 when there is no such domain.
    """
    from casper.cli.terminal.progress import progress
    from casper.engine.domain.domain import SHIPPED, find_domain
    from casper.kb.checks.finding import Severity
    from casper.sim_adapter.checking import check_whole

    with progress("checking", None, quiet):
        findings = check_whole(domain)
    show_findings(findings, (find_domain(domain), SHIPPED), as_json)
    raise typer.Exit(1 if any(f.severity is Severity.ERROR for f in findings) else 0)


def show_findings(findings: Sequence[Finding], folders: Sequence[Path], as_json: bool) -> None:
    """Print findings, one object a line or for a person; lines of files are shown of those in the folders only."""
    from casper.cli.terminal.output import print_json

    if as_json:
        for finding in findings:
            print_json(_json(finding))
    else:
        _show(findings, folders)


def _json(finding: Finding) -> dict[str, Any]:
    return {**finding.to_json(), "file": _path(finding.place.file)}


def _path(file: str) -> str:
    """The file as one would name it from here."""
    path, here = Path(file), Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else file


def _show(findings: Sequence[Finding], folders: Sequence[Path]) -> None:
    from casper.cli.terminal.output import console
    from casper.cli.terminal.showing import say, show
    from casper.kb.checks.printing import excerpt_lines, finding_line, tally
    from casper.kb.text.files import is_within

    out = console()
    for finding in findings:
        place = finding.place
        show(out, [finding_line(place, finding.severity, finding.message, _path(place.file))])
        if is_within(Path(place.file), folders):  # nothing is shown of a file that lies in none of the folders
            show(out, excerpt_lines(place))
    say(out, tally(finding.severity for finding in findings))
