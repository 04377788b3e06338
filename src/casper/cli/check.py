"""``casper check``: every mistake in a domain at once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from casper.cli.options import AsJson, DomainName

if TYPE_CHECKING:
    from casper.kb.checks.finding import Finding

_STYLE = {"error": "bold red", "warning": "yellow", "note": "cyan"}


def check(domain: DomainName, as_json: AsJson = False) -> None:
    """Find mistakes in a domain: undefined names, rules that give nothing, plans nobody can do, and the like.

    Exit code 0 without errors (there may be warnings and notes), 1 with errors, 2 when there is no such domain.
    """
    from casper.engine.domain.check import check_domain
    from casper.kb.checks.finding import Severity

    findings = check_domain(domain)
    show_findings(findings, as_json)
    raise typer.Exit(1 if any(f.severity is Severity.ERROR for f in findings) else 0)


def show_findings(findings: Sequence[Finding], as_json: bool) -> None:
    """Print findings, for a person or for a program."""
    from casper.cli.output import print_json

    if not as_json:
        _show(findings)
        return
    for finding in findings:
        print_json(_json(finding))


def _json(finding: Finding) -> dict[str, Any]:
    return {**finding.to_json(), "file": _path(finding.place.file)}


def _path(file: str) -> str:
    """The file as one would name it from here."""
    path, here = Path(file), Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else file


def _show(findings: Sequence[Finding]) -> None:
    from rich.markup import escape

    from casper.cli.output import console

    out = console()
    for finding in findings:
        place, style = finding.place, _STYLE[finding.severity]
        where = f"{_path(place.file)}:{place.line}" if place.line else _path(place.file)
        out.print(f"{escape(where)}: [{style}]{finding.severity}[/]: {escape(finding.message)}")
        for line in _excerpt(finding):
            out.print(f"    {line}", style="dim", markup=False)
    out.print(_tally(findings))


def _excerpt(finding: Finding) -> list[str]:
    """The line of the finding, with a caret under its column."""
    place = finding.place
    try:
        lines = Path(place.file).read_text(encoding="utf-8").split("\n")
    except (OSError, UnicodeDecodeError):
        return []
    if not 0 < place.line <= len(lines):
        return []
    shown = "".join(c if c.isprintable() else " " for c in lines[place.line - 1])
    return [shown, " " * (place.column - 1) + "^"] if place.column else [shown]


def _tally(findings: Sequence[Finding]) -> str:
    counts = [(kind, sum(f.severity == kind for f in findings)) for kind in _STYLE]
    told = [f"{count} {kind}{'s' if count != 1 else ''}" for kind, count in counts if count]
    return ", ".join(told) or "nothing to find fault with"
