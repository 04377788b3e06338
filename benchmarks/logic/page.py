"""The page: one table a family, amounts beside ratios, promises, what was left out, the machine.

Each family's part stands between marks of its own, so that one can be measured and written anew without the others.
"""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Iterable, Iterator, Sequence
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from math import inf
from pathlib import Path

from .bounds import Bound
from .figures import OURS, PROCESSOR, Figure, Skipped, clock
from .peers import prolog
from .sections import Section

PAGE = Path(__file__).resolve().parents[2] / "docs" / "benchmarks.md"
START, END = "<!-- logic: written by benchmarks/logic -->", "<!-- logic: end -->"
PART = re.compile(r"<!-- logic (\w+) -->\n(.*?)\n<!-- logic \w+: end -->", re.DOTALL)
HEAD = (
    "## The knowledge base and its peers\n\n`python benchmarks/logic --write` makes this page, `python "
    "benchmarks/logic FAMILY… --write` the parts of some families (`--help` lists them). Each part says when and "
    "where it was measured: all engines in that one run, medians of repeated runs. In brackets how many times the "
    f"first {OURS} column of the row, so above 1 the peer is slower; a ratio is given, and a promise judged, only "
    "where every engine of the row found the same answers."
)
CLOCKS = {"wall": "wall clock", PROCESSOR: "processor time"}
PROMISES = ("| promise | measured | bound | |", "|---|--:|--:|---|")


def page(sections: Iterable[Section]) -> Iterator[str]:
    """The report as paragraphs of Markdown."""
    sections = list(sections)
    yield HEAD
    yield "\n".join(summary(bound.held for found in sections for bound in found.promises))
    for found in sections:
        yield part(found)


def summary(held: Iterable[bool | None]) -> Iterator[str]:
    """How many promises are kept."""
    judged = list(held)
    counted = (judged.count(True), judged.count(False), judged.count(None))
    yield "Of {} promises {} are kept, {} are not, {} were not judged.".format(len(judged), *counted)


def part(found: Section) -> str:
    """One family's part: what is timed, the table, what was left out, the promises."""
    return "\n\n".join(_paragraphs(found))


def _paragraphs(found: Section) -> Iterator[str]:
    yield f"### {found.title}\n\n{found.timed}"
    yield f"{date.today().isoformat()}, {machine()}."
    if found.differing:
        yield "\n".join(["**Answers differ:**", "", *(f"- {line}" for line in found.differing.values())])
    if found.figures:
        yield "\n".join(table(found.figures, found.differing))
    if skipped := [f"- {x.task}: {x.engine} left out: {x.reason}" for x in found.found if isinstance(x, Skipped)]:
        yield "\n".join(skipped)
    if found.promises:
        yield "\n".join([*PROMISES, *map(_line, found.promises)])


def table(figures: Sequence[Figure], differing: Iterable[str] = ()) -> Iterator[str]:
    """A row for each task, a column for each engine."""
    engines = sorted({x.engine: None for x in figures}, key=lambda name: not name.startswith(OURS))
    yield f"| | {' | '.join(engines)} |"
    yield "|---|" + "--:|" * len(engines)
    cells: dict[str, dict[str, Figure]] = {}
    for figure in figures:
        cells.setdefault(figure.task, {})[figure.engine] = figure
    for task, found in cells.items():
        ours = next((found[name] for name in engines if name in found and name.startswith(OURS)), None)
        compared = None if task in differing else ours
        yield f"| {task} | " + " | ".join(_cell(found.get(name), compared) for name in engines) + " |"


def _cell(figure: Figure | None, ours: Figure | None) -> str:
    if figure is None:
        return "–"
    shown = amount(figure.amount, figure.unit)
    if ours is None or figure is ours or figure.unit not in ("s", "bytes"):
        return shown
    return f"{shown} ({_number(figure.amount / max(ours.amount, 1e-12))}×)"


def amount(value: float, unit: str) -> str:
    """Three digits with the unit that suits them."""
    if unit == "s":
        return duration(value)
    if unit == "bytes":
        return f"{_number(value / 2**20)} MiB" if value >= 2**20 else f"{_number(value)} bytes"
    return f"{_number(value)} {unit}".rstrip()


def duration(seconds: float) -> str:
    """Seconds, milli- or microseconds."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{_number(seconds / size)} {unit}"
    return f"{_number(seconds * 1e6)} µs"


def _number(value: float) -> str:
    if value == inf:
        return "∞"
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def _line(promise: Bound) -> str:
    value = "–" if promise.value is None else f"{_number(promise.value)} {promise.unit}"
    word = "at least" if promise.at_least else "at most"
    judged = {True: "kept", False: "**not kept**", None: "**not judged**: something it needs is missing above"}
    cells = (promise.promise, value, f"{word} {_number(promise.bound)} {promise.unit}", judged[promise.held])
    return f"| {' | '.join(cells)} |"


def machine() -> str:
    """The processor, how busy it is, and the versions, without the machine's name."""
    processor = platform.processor() or platform.machine()
    described = Path("/proc/cpuinfo")
    if described.exists() and (found := re.search(r"model name\s*: (.*)", described.read_text())):
        processor = found[1].strip()
    parts = [
        f"{os.cpu_count()} cores, {processor}, load {os.getloadavg()[0]:.1f}, {CLOCKS[clock()]}",
        f"Python {platform.python_version()}",
    ]
    packages = ("miniKanren", "numpy", "clingo", "rdflib", "pyswip", "janus-swi", "swiplserver")
    parts += [f"{name} {shown}" for name in packages if (shown := _version(name))]
    if prolog.is_installed():
        parts.append(prolog.version())
    return ", ".join(parts)


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def keep(sections: Iterable[Section], order: Sequence[str], path: Path) -> None:
    """Put the parts into the logic part of a page; its other parts, and the rest of the page, stay."""
    old = path.read_text() if path.exists() else "# Benchmarks\n"
    before, _, rest = old.partition(START)
    inside, _, after = rest.partition(END)
    parts = parts_of(inside) | {found.name: part(found) for found in sections}
    kept = [f"<!-- logic {name} -->\n{parts[name]}\n<!-- logic {name}: end -->" for name in order if name in parts]
    held = [
        None if "not judged" in line else "not kept" not in line
        for line in "\n".join(kept).splitlines()
        if _judges(line)
    ]
    text = "\n\n".join([HEAD, *summary(held), *kept])
    path.write_text(f"{before.rstrip()}\n\n{START}\n{text}\n{END}\n{after.lstrip()}")


def _judges(line: str) -> bool:
    return line.endswith(("| kept |", "| **not kept** |")) or "| **not judged**" in line


def parts_of(inside: str) -> dict[str, str]:
    """The parts of the page by family."""
    return {name: text for name, text in PART.findall(inside)}
