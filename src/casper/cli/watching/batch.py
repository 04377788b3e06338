"""``casper batch``: many rows of a table at once."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from casper.cli.terminal.options import DomainName, Goals, Language, Noise, PolicyName, Unverified
from casper.kb.errors import CasperError

PLAIN = {"policy": "strict", "verification": True, "noise": None, "goals": 1}


class What(StrEnum):
    """What is done with each row."""

    explain = "explain"
    verify = "verify"
    watch = "watch"


def batch(
    what: Annotated[What, typer.Argument(help="explain (actions), verify (statement) or watch (recording).")],
    domain: DomainName,
    table: Annotated[Path, typer.Argument(help="A .csv, .jsonl or .parquet file with that column.")],
    out: Annotated[Path, typer.Argument(help="The results: a .csv, .jsonl or .parquet file.")],
    jobs: Annotated[int, typer.Option(min=1, metavar="N", help="How many processes work on it.")] = 1,
    cluster: Annotated[str | None, typer.Option(metavar="URL", help="Work on a Dask cluster: tcp://host:8786.")] = None,
    policy: PolicyName = "strict",
    no_verification: Unverified = False,
    noise: Noise = None,
    goals: Goals = 1,
    language: Language = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Show no progress.")] = False,
) -> None:
    """Explain, verify or watch every row of a table; a run that was interrupted goes on where it was.

    A row that cannot be worked on is kept, with its mistake. Exit code 1 when there was one.
    """
    from casper.batch.many import run
    from casper.engine.domain.domain import Domain

    options: dict[str, Any] = {"policy": policy, "verification": not no_verification, "noise": noise, "goals": goals}
    if what is What.verify:
        if options != PLAIN:
            raise CasperError("--policy, --noise, --goals and --no-verification are about readings, not about verify")
        options = {}
    shown = not quiet and sys.stderr.isatty()
    spoken = Domain.load(domain, language) if language else domain
    found = run(what.value, spoken, table, options, jobs=jobs, cluster=cluster, out=out, progress=shown)
    mistakes = [row for row in found if row["mistake"]]
    if not quiet:
        print(f"{out}: {len(found)} rows, {len(mistakes)} with a mistake")
        for row in mistakes[:10]:
            print(f"  row {row['row']}: {row['mistake'].splitlines()[0]}")
        if len(mistakes) > 10:
            print(f"  … and {len(mistakes) - 10} more: see the column mistake")
    raise typer.Exit(1 if mistakes else 0)
