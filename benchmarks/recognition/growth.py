"""How the time of an observation grows: a table, and a picture.

    python benchmarks/recognition/growth.py [--picture benchmarks/recognition/growth.svg]

A point is the mean time of an observation with posterior and best explanation over an episode; of several episodes the
median. A line ends where an episode took more than two seconds, or where a list of explanations would be too long.
"""

from __future__ import annotations

import argparse
import gc
import random
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from baseline import Baseline
from engines import Arrays, Chains, Interleaving, NoisyArrays, Pairs, engine
from episodes import episode
from growth_picture import draw
from libraries import chains, with_parameters
from timing import times

from casper.engine.explanation import tree_copying
from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import Matcher, NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

PATIENCE = 2.0  # seconds for an episode
EPISODES = 5
PRICE = 0.1  # of a needless observation

Plans: TypeAlias = Sequence[Plan]
Timed: TypeAlias = Callable[[Sequence[Observation]], float]  # the seconds of an episode


@dataclass(frozen=True, slots=True)
class Case:
    """Goals of so many leaves, drawn from so many action names; how many actions are seen of each goal pursued."""

    goals: int
    leaves: int
    names: int
    seen: int


@dataclass(frozen=True, slots=True)
class Line:
    """A recogniser: ``prepare`` makes its tables of a library. ``most`` is how many explanations it can list."""

    prepare: Callable[[Plans, Matcher], Timed]
    most: int | None = None


@dataclass(frozen=True, slots=True)
class Panel:
    """What grows along the axis: the field ``at`` of the cases. ``together`` goals are pursued at once."""

    title: str
    axis: str
    at: str
    cases: Sequence[Case]
    lines: dict[str, Line]
    together: int = 1
    parameters: bool = False


def forked(make: Callable[[Plans, Matcher], Any], best: str = "standing") -> Callable[..., Timed]:
    """A recogniser that is made once; each episode starts from a copy."""

    def prepare(plans: Plans, matcher: Matcher) -> Timed:
        prototype = make(plans, matcher)
        return lambda seen: sum(times(prototype.fork, [seen], best, 1))

    return prepare


def copied(plans: Plans, matcher: Matcher) -> Timed:
    """The specification, which takes all observations at once: what it needs for posteriors is not counted."""

    def timed(seen: Sequence[Observation]) -> float:
        began = time.perf_counter()
        tree_copying.explanations(plans, seen, matcher)
        return time.perf_counter() - began

    return timed


def listed(goals: int) -> Callable[..., Timed]:
    """The plain baseline."""
    return forked(lambda plans, matcher: Baseline(plans, matcher, goals), "best")


ONE = {
    "tree copies": Line(copied, 5_000),
    "plain list": Line(listed(1), 100_000),
    "chains": Line(forked(engine(Chains), "best")),
    "noisy arrays": Line(forked(engine(NoisyArrays, PRICE))),
    "arrays": Line(forked(engine(Arrays), "best")),
}
TWO = {
    "plain list": Line(listed(2), 100_000),
    "interleaving": Line(forked(engine(Interleaving, 2, budget=10**9)), 1_000_000),
    "pairs": Line(forked(engine(Pairs))),
}
GOALS = (10, 30, 100, 300, 1_000, 3_000, 10_000, 30_000, 100_000)
PAIRS = [Case(goals, 24, 10, 5) for goals in (3, 5, 10, 20, 50, 100)]
PANELS = (
    Panel("12 leaves, 10 names, 5 observations", "goals", "goals", [Case(n, 12, 10, 5) for n in GOALS], ONE),
    Panel("1,000 goals, 10 names, 5 observations", "leaves of a goal", "leaves",
          [Case(1_000, n, 10, 5) for n in (8, 12, 16, 24, 32, 48, 64)], ONE),
    Panel("1,000 goals, 12 leaves, 5 observations", "action names", "names",
          [Case(1_000, 12, n, 5) for n in (1_000, 300, 100, 30, 10, 3, 1)], ONE),
    Panel("100 goals, 24 leaves, 3 names", "observations", "seen",
          [Case(100, 24, 3, n) for n in (1, 2, 3, 4, 6, 8, 12, 16)], ONE),
    Panel("two goals at once, 24 leaves, 10 names", "goals", "goals", PAIRS, TWO, together=2),
    Panel("the same with parameters", "goals", "goals", PAIRS,
          {name: TWO[name] for name in ("plain list", "interleaving")}, together=2, parameters=True),
)  # fmt: skip
Points: TypeAlias = dict[str, list[tuple[int, float]]]  # by line: where, and seconds of an observation


def measured(panel: Panel) -> Points:
    """All lines of a panel, case by case; a line that took too long goes no further."""
    points: Points = {name: [] for name in panel.lines}
    going = dict(panel.lines)
    for case in panel.cases:
        plans = (with_parameters if panel.parameters else chains)(case.goals, case.leaves, case.names)
        matcher, chance = (ParameterMatcher if panel.parameters else NameMatcher)(plans), random.Random(1)
        episodes = [episode(plans, case.seen, chance, panel.together) for _ in range(EPISODES)]
        explanations = most(plans, matcher, episodes, panel.together)
        for name, line in list(going.items()):
            taken = PATIENCE
            if line.most is None or explanations <= line.most:
                timed = line.prepare(plans, matcher)
                gc.collect()
                taken = statistics.median(quickest(timed, seen) for seen in episodes)
                points[name].append((getattr(case, panel.at), taken / (case.seen * panel.together)))
            if taken >= PATIENCE:
                del going[name]
    return points


def quickest(timed: Timed, seen: Sequence[Observation]) -> float:
    """The shortest of two to twenty runs: the first fills an engine's tables, and the machine has other work."""
    runs: list[float] = []
    while len(runs) < 2 or (len(runs) < 20 and sum(runs) < 0.5):
        runs.append(timed(seen))
    return min(runs)


def most(plans: Plans, matcher: Matcher, episodes: Sequence[Sequence[Observation]], together: int) -> int:
    """The largest number of explanations there are in any of the episodes."""
    numbers = []
    for seen in episodes:
        engine = recogniser(plans, matcher, Options(goals=together))
        for observation in seen:
            engine.observe(observation)
            numbers.append(engine.count)
    return max(numbers)


def table(panel: Panel, points: Points) -> str:
    """The figures in microseconds."""
    columns = {name: dict(found) for name, found in points.items()}
    heading = "  ".join([f"{panel.axis:>20}", *(f"{name:>12}" for name in columns)])
    lines = [f"{panel.title}: µs an observation", heading]
    for case in panel.cases:
        at = getattr(case, panel.at)
        cells = [f"{1e6 * column[at]:,.1f}" if at in column else "–" for column in columns.values()]
        lines.append("  ".join([f"{at:>20,}", *(f"{cell:>12}" for cell in cells)]))
    return "\n".join(lines)


def main() -> None:
    """Print the table; draw it where files are named."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--picture", nargs="+", default=[], help="files: .svg, .png or .pdf")
    pictures = parser.parse_args().picture
    results = []
    for panel in PANELS:
        points = measured(panel)
        print(f"{table(panel, points)}\n", flush=True)
        results.append((panel.title, panel.axis, points))
    for picture in pictures:
        draw(results, picture)


if __name__ == "__main__":
    main()
