"""How the time of one observation grows with goals, leaves, symbols and observations: a table, and plots.

    python benchmarks/recognition/growth.py [--picture growth.svg]
"""

from __future__ import annotations

import argparse
import random
import statistics
import time
from typing import Any

from libraries import chains, episode

from casper.engine.arrays import Arrays
from casper.engine.chains import Chains
from casper.engine.matching import NameMatcher

GROWTH: dict[str, list[tuple[int, int, int, int]]] = {  # what grows: (goals, leaves, symbols, observations)
    "goals": [(goals, 12, 10, 5) for goals in (10, 30, 100, 300, 1_000, 10_000, 100_000)],
    "leaves": [(1_000, leaves, 10, 5) for leaves in (8, 12, 16, 24, 32, 48, 64)],
    "symbols": [(1_000, 12, symbols, 5) for symbols in (1, 3, 10, 30, 100, 1_000)],
    "observations": [(1_000, 24, 3, observations) for observations in (1, 2, 4, 8, 16)],
}
PLAIN_GOALS = 1_000  # plain Python is not measured above


def measured(engine: type[Any], goals: int, leaves: int, symbols: int, observations: int) -> float:
    """Median microseconds of the last observation with posterior and best explanation."""
    plans, chance = chains(goals, leaves, symbols), random.Random(1)
    prototype, times = engine(plans, NameMatcher(plans)), []
    for _ in range(12):
        seen = episode(plans, observations, chance)
        for _ in range(2):  # the first time fills the caches
            fork = prototype.fork()
            for observation in seen:
                began = time.perf_counter()
                fork.observe(observation)
                fork.posterior()
                fork.best()
                last = time.perf_counter() - began
        times.append(last)
    return 1e6 * statistics.median(times)


def main() -> None:
    """Print the table; draw it where a file is named."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--picture", help="a file: .svg, .png or .pdf")
    picture = parser.parse_args().picture
    results: dict[str, dict[str, list[tuple[int, float]]]] = {}
    for at, (what, cases) in enumerate(GROWTH.items()):
        print(f"{what:>13}   Python µs    numpy µs")
        results[what] = {"plain Python": [], "numpy": []}
        for case in cases:
            plain = measured(Chains, *case) if case[0] <= PLAIN_GOALS else None
            arrays = measured(Arrays, *case)
            print(f"{case[at]:13,d}  {'–' if plain is None else format(plain, '10.1f'):>10}  {arrays:10.1f}")
            if plain is not None:
                results[what]["plain Python"].append((case[at], plain))
            results[what]["numpy"].append((case[at], arrays))
    if picture:
        draw(results, picture)


def draw(results: dict[str, dict[str, list[tuple[int, float]]]], file: str) -> None:
    """One panel for each thing that grows."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(results), figsize=(3.6 * len(results), 3.2), sharey=True)
    for axis, (what, lines) in zip(axes, results.items()):
        for name, points in lines.items():
            axis.loglog(*zip(*points), marker="o", markersize=3, label=name)
        axis.set_xlabel(what)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("µs an observation")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(file)


if __name__ == "__main__":
    main()
