"""Every benchmark in one run, or some: measured, answers compared, promises judged; the page is in `page`."""

import argparse
import os
import sys
import time
import traceback
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from types import ModuleType

from . import meaning
from .asking import demand, from_python, join, lists, programs, queries, reasons, rows
from .deriving import closures, counts, games, large, ontology, shortest, updates
from .figures import CLOCK, FULL, OURS, PROCESSOR, TINY, Figure, Sizes, Skipped
from .loading import rdf, texts
from .page import PAGE, keep, page
from .sections import Section

FAMILIES: tuple[ModuleType, ...] = (
    *(queries, rows, join, demand, lists, programs, from_python, reasons),
    *(closures, ontology, games, counts, shortest, updates, large),
    *(texts, rdf, meaning),
)

BUSY = 5  # times as long may a peer's process take where only its processor time counts
ALONE = ("meaning",)  # takes longer than all others; run when it is named


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print, and with --write keep it.

    Returns:
        2 when answers differ or a benchmark fails, 1 when a promise is not kept or could not be judged, else 0.
    """
    parser = argparse.ArgumentParser(
        prog="benchmarks/logic", description=f"{__doc__} Only when named: {', '.join(ALONE)}."
    )
    names = [name_of(family) for family in FAMILIES]
    names_of_a_run = [name for name in names if name not in ALONE]
    parser.add_argument("family", nargs="*", help=f"only some of: {', '.join(names)}")
    parser.add_argument("--tiny", action="store_true", help="tiny sizes: does everything run?")
    parser.add_argument("--write", action="store_true", help="put the families' parts into docs/benchmarks.md")
    parser.add_argument("--cpu", action="store_true", help="processor time: for a machine busy with other things, too")
    options = parser.parse_args(arguments)
    if unknown := set(options.family) - set(names):
        parser.error(f"there is no family {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    sizes, began = TINY if options.tiny else FULL, time.perf_counter()
    if options.cpu:
        os.environ[CLOCK] = PROCESSOR
        sizes = replace(sizes, limit=BUSY * sizes.limit)
    sections = []
    for family in (f for f in FAMILIES if name_of(f) in (options.family or names_of_a_run)):
        sections.append(section(family, sizes))
        if options.write:  # at once: what was measured is kept, whatever comes
            keep(sections[-1:], names, PAGE)
    print("\n\n".join(page(sections)), f"\nThe run took {time.perf_counter() - began:.0f} s.")
    if any(found.differing or found.broken for found in sections):
        return 2
    return int(any(promise.held is not True for found in sections for promise in found.promises))


def name_of(family: ModuleType) -> str:
    """The name of a family on the command line."""
    return family.__name__.rpartition(".")[2]


def section(family: ModuleType, sizes: Sizes) -> Section:
    """Measure one family, with a line on the error output while it runs.

    A failure ends the family, not the run: it stands on the page as what was left out.
    """
    began, broken = time.perf_counter(), False
    print(f"… {name_of(family)}", end="", file=sys.stderr, flush=True)
    found: list[Figure | Skipped] = []
    try:
        for one in family.measure(sizes):
            found.append(one)
    except Exception as mistake:
        traceback.print_exc()
        broken = True
        found.append(Skipped(family.TITLE, OURS, f"it failed: {type(mistake).__name__}: {mistake}"))
    print(f" {time.perf_counter() - began:.0f} s", file=sys.stderr, flush=True)
    figures = [x for x in found if isinstance(x, Figure)]
    differing = dict(disagreements(figures))
    amounts = {(x.task, x.engine): x.amount for x in figures if x.task not in differing}
    promises = tuple(family.promises(amounts, sizes))
    return Section(name_of(family), family.TITLE, family.TIMED, tuple(found), differing, promises, broken)


def disagreements(figures: Iterable[Figure]) -> Iterator[tuple[str, str]]:
    """Every task on which two engines differ, with a line; such a task has no ratio and keeps no promise."""
    first: dict[str, Figure] = {}
    for figure in figures:
        if figure.answers is None:
            continue
        other = first.setdefault(figure.task, figure)
        if other.answers != figure.answers:
            yield figure.task, f"{figure.task}: {other.engine} found {other.answers}, {figure.engine} {figure.answers}"
