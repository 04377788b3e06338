"""``casper train --plans``: the prices of a day, learned from recorded ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from casper.cli.authoring.written import write_output
from casper.cli.terminal.output import console, print_json
from casper.cli.terminal.progress import progress
from casper.cli.terminal.showing import say
from casper.engine.domain.domain import Domain
from casper.engine.episodes.training import learn, read_day


def learn_prices(domain: str, files: Sequence[Path], output: Path | None, quiet: bool, as_json: bool) -> None:
    """Learn what it costs to begin, give up, add and skip.

    Args:
        domain: whose plans.
        files: a recorded day each.
        output: where the clauses go besides the screen; None: nowhere.
        quiet, as_json: how it is told.

    Raises:
        CasperError: a domain or a file with a mistake, or a place where nothing can be written.
    """
    loaded = Domain.load(domain)
    with progress("reading the days", None, quiet):
        learned = learn(lambda prices: loaded.day(**asdict(prices)), [read_day(file) for file in files], loaded.prices)
    if output is not None:
        write_output(learned.to_text(), output)
    if as_json:
        told = {"days": learned.days, "observations": learned.observations, "episodes": learned.episodes}
        print_json({**asdict(learned.prices), **told, "file": None if output is None else str(output)})
        return
    out = console()
    say(out, f"% from {learned.observations} observations of {learned.episodes} episodes; for plans.pl")
    say(out, learned.to_text().rstrip())
    if output is not None:
        say(out, f"% written to {output}")
