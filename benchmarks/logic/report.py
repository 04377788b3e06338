"""The report: every benchmark in one run, answers compared, times beside ratios, promises, the machine."""

import argparse
import os
import platform
import re
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import ModuleType

from . import closures, ontology, prolog, queries, reasons, rows, updates
from .bounds import Bound, bounds
from .figures import FULL, OURS, TINY, Figure, Sizes, Skipped
from .memory import Memory, measured

FAMILIES: tuple[ModuleType, ...] = (queries, rows, closures, ontology, updates, reasons)
PAGE = Path(__file__).resolve().parents[2] / "docs" / "benchmarks.md"
START, END = "<!-- logic: written by benchmarks/logic -->", "<!-- logic: end -->"


@dataclass(frozen=True, slots=True)
class Section:
    """One family's figures."""

    title: str
    timed: str
    found: tuple[Figure | Skipped, ...]

    @property
    def figures(self) -> list[Figure]:
        """What was measured."""
        return [x for x in self.found if isinstance(x, Figure)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print, and with --write keep it; exit code 2 when answers differ, 1 when a promise is not kept."""
    parser = argparse.ArgumentParser(prog="benchmarks/logic", description=__doc__)
    names = [name_of(family) for family in FAMILIES]
    parser.add_argument("family", nargs="*", help=f"only some of: {', '.join([*names, 'memory'])}")
    parser.add_argument("--tiny", action="store_true", help="tiny sizes: does everything run?")
    parser.add_argument("--write", action="store_true", help="put the report into docs/benchmarks.md")
    options = parser.parse_args(arguments)
    if unknown := set(options.family) - {*names, "memory"}:
        parser.error(f"there is no family {', '.join(sorted(unknown))}")
    sizes, began = TINY if options.tiny else FULL, time.perf_counter()
    sections = [section(f, sizes) for f in FAMILIES if not options.family or name_of(f) in options.family]
    memory = measured(sizes.ontology) if not options.family or "memory" in options.family else None
    different = [line for found in sections for line in disagreements(found.figures)]
    promises = list(promised(sections, sizes, memory))
    text = "\n\n".join(page(sections, promises, memory, different))
    print(text, f"\nThe run took {time.perf_counter() - began:.0f} s.")
    if options.write:
        keep(text, PAGE)
    return 2 if different else int(any(promise.held is False for promise in promises))


def name_of(family: ModuleType) -> str:
    """The name of a family on the command line."""
    return family.__name__.rpartition(".")[2]


def section(family: ModuleType, sizes: Sizes) -> Section:
    """Measure one family, with a line on the error output while it runs."""
    print(f"… {name_of(family)}", file=sys.stderr, flush=True)
    return Section(family.TITLE, family.TIMED, tuple(family.measure(sizes)))


def disagreements(figures: Iterable[Figure]) -> Iterator[str]:
    """A line for every task on which two engines differ."""
    first: dict[str, Figure] = {}
    for figure in figures:
        if figure.answers is None:
            continue
        other = first.setdefault(figure.task, figure)
        if other.answers != figure.answers:
            yield f"{figure.task}: {other.engine} found {other.answers}, {figure.engine} {figure.answers}"


def promised(sections: Iterable[Section], sizes: Sizes, memory: Memory | None) -> Iterator[Bound]:
    """The promises about what was measured; those about nothing that ran are left out."""
    times = {(x.task, x.engine): x.seconds for found in sections for x in found.figures}
    return (bound for bound in bounds(times, sizes, memory) if bound.value is not None)


def page(
    sections: Iterable[Section], promises: Iterable[Bound], memory: Memory | None, different: Sequence[str]
) -> Iterator[str]:
    """The report as paragraphs of Markdown."""
    yield f"## The knowledge base and its peers\n\n{date.today().isoformat()}. {machine()}."
    yield (
        f"Medians of repeated warm runs, all in one run; in brackets how many times the first {OURS} column "
        "of the row, so above 1 the peer is slower. `python benchmarks/logic --write` makes this page."
    )
    yield "\n".join(["Answers differ:", *different]) if different else "All engines give equal answers."
    for found in sections:
        yield f"### {found.title}\n\n{found.timed}"
        yield "\n".join(table(found.figures))
        if skipped := [
            f"- {x.task}: {x.engine} left out: {x.reason}" for x in found.found if isinstance(x, Skipped)
        ]:
            yield "\n".join(skipped)
    if memory is not None:
        yield f"### Memory of the large base\n\n{memory}."
    yield "\n".join(
        ["### Promises", "", "| promise | measured | bound | |", "|---|--:|--:|---|", *map(_line, promises)]
    )


def table(figures: Sequence[Figure]) -> Iterator[str]:
    """A row for each task, a column for each engine."""
    engines = sorted({x.engine: None for x in figures}, key=lambda name: not name.startswith(OURS))
    yield f"| | {' | '.join(engines)} |"
    yield "|---|" + "--:|" * len(engines)
    cells: dict[str, dict[str, float]] = {}
    for figure in figures:
        cells.setdefault(figure.task, {})[figure.engine] = figure.seconds
    for task, found in cells.items():
        ours = next((found[name] for name in engines if name in found), None)
        yield f"| {task} | " + " | ".join(_cell(found.get(name), ours) for name in engines) + " |"


def _cell(seconds: float | None, ours: float | None) -> str:
    if seconds is None or ours is None:
        return "–"
    return (
        duration(seconds)
        if seconds == ours
        else f"{duration(seconds)} ({_number(seconds / max(ours, 1e-12))}×)"
    )


def duration(seconds: float) -> str:
    """Three digits with the unit that suits them."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{_number(seconds / size)} {unit}"
    return f"{_number(seconds * 1e6)} µs"


def _number(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def _line(promise: Bound) -> str:
    value = _number(promise.value) if promise.value is not None else "–"
    word = "at least" if promise.at_least else "at most"
    cells = (
        promise.promise,
        f"{value} {promise.unit}",
        f"{word} {_number(promise.bound)} {promise.unit}",
        "kept" if promise.held else "**not kept**",
    )
    return f"| {' | '.join(cells)} |"


def machine() -> str:
    """The processor and the versions, without the machine's name."""
    processor = platform.processor() or platform.machine()
    described = Path("/proc/cpuinfo")
    if described.exists() and (found := re.search(r"model name\s*: (.*)", described.read_text())):
        processor = found[1].strip()
    parts = [f"{os.cpu_count()} cores, {processor}", f"Python {platform.python_version()}"]
    parts += [f"{name} {shown}" for name in ("miniKanren", "numpy", "clingo") if (shown := _version(name))]
    if prolog.is_installed():
        parts.append(prolog.version())
    return ", ".join(parts)


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def keep(text: str, path: Path) -> None:
    """Replace the logic part of a page, or append it; the rest of the page stays."""
    old = path.read_text() if path.exists() else "# Benchmarks\n"
    before, _, rest = old.partition(START)
    after = rest.partition(END)[2]
    path.write_text(f"{before.rstrip()}\n\n{START}\n{text}\n{END}\n{after.lstrip()}")
