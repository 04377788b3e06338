"""``casper experiment``: the paper's tables and figures, and studies beyond it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, Quiet, Robot

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from typing import Any


def _names(incomplete: str) -> list[str]:
    """Experiments, and sets of them, for completion in a shell."""
    from casper.experiments.registry import EXPERIMENTS, SETS

    return [name for name in (*SETS, *EXPERIMENTS) if name.startswith(incomplete)]


def experiment(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]…", help="kitchen is all of the paper; none lists them.", autocompletion=_names),
    ] = None,
    trials: Annotated[
        int | None, typer.Option(metavar="N", help="How many trials; by default as many as the experiment takes.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of the first trial; the others have those after it.")] = 0,
    robot: Robot = "primitive",
    jobs: Annotated[int, typer.Option(min=1, metavar="J", help="How many processes run trials.")] = 1,
    cluster: Annotated[str | None, typer.Option(metavar="URL", help="Run on a Dask cluster: tcp://host:8786.")] = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Where data, figures and page go.")] = Path("experiments"),
    page: Annotated[
        Path | None, typer.Option(metavar="FILE.md", help="Renew the experiments' parts of this page, too.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Forget the trials that are kept in the folder.")] = False,
    redraw: Annotated[bool, typer.Option("--redraw", help="Run nothing; draw the data in the folder anew.")] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Reproduce the paper's tables and figures, or run a study; a run that was interrupted goes on where it was.

    Writes NAME.csv and NAME.json, figures as SVG and PNG that are drawn from the JSON alone, and paper.md, which sets
    the paper's numbers beside ours. Trials are kept in trials.jsonl as they come; more of them are added to those.
    """
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import say
    from casper.experiments.registry import EXPERIMENTS
    from casper.experiments.runner import PAGE, Where, run_experiments

    out_to = console()
    if not names:
        for one in EXPERIMENTS.values():
            told = {"experiment": one.name, "shows": one.shows, "paper": one.paper or None}
            if as_json:
                print_json(told)
            else:
                say(out_to, f"{one.name:<14}{one.shows}{f' ({one.paper})' if one.paper else ''}")
        return
    shown = not quiet and sys.stderr.isatty()
    where = Where(out, jobs, cluster, fresh, redraw, page, shown)
    for one, data, files in run_experiments(names, where, trials, seed, robot):
        for row in data.summary if as_json else ():
            print_json({"experiment": one.name, **row})
        if not as_json and not quiet:
            say(out_to, f"{one.name}: {one.shows}")
            say(out_to, "\n".join(f"  {line}" for line in columns(data.summary)))
            say(out_to, f"  written: {', '.join(file.name for file in files)}")
    if not as_json and not quiet:
        say(out_to, f"{out / PAGE}: the paper's numbers beside ours")


def columns(rows: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Rows as lines of a table with a header; each column is as wide as it must be."""
    from casper.experiments.experiment import shown

    header = list(dict.fromkeys(name for row in rows for name in row))
    values = [[row.get(name) for name in header] for row in rows]
    cells = [header, *([f"{v:.4g}" if isinstance(v, float) else shown(v) for v in row] for row in values)]
    widths = [max(len(row[at]) for row in cells) for at in range(len(header))]
    for row in cells:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
