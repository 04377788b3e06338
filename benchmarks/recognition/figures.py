"""Plan recognition in figures: time for an observation with posterior and best explanation, and what it is compared to.

    python benchmarks/recognition/figures.py [--quick]

Every comparison first checks that the answers are equal. Exit code 1 when a bound of the project is not held.
"""

from __future__ import annotations

import argparse
import random
import statistics
import sys
import time
import tracemalloc
from collections.abc import Callable, Sequence
from typing import Any

from baseline import Baseline
from libraries import carried_out, chains, episode, interleaved, partly_ordered

from casper import Domain
from casper.engine import tree_copying
from casper.engine.arrays import Arrays
from casper.engine.chains import Chains
from casper.engine.interleaving import Interleaving
from casper.engine.matching import NameMatcher, ParameterMatcher
from casper.engine.observation import Observation
from casper.engine.pairs import Pairs
from casper.plans.library import PlanLibrary

held: list[bool] = []


def told(what: str, figure: float, unit: str, bound: float | None = None, note: str = "") -> None:
    ok = bound is None or figure <= bound
    held.append(ok)
    shown = "" if bound is None else f"bound {bound:g} {unit}: {'held' if ok else 'NOT held'}"
    print(f"{what:<62} {figure:10.4g} {unit:<3} {shown} {note}".rstrip())


def medians(
    make: Callable[[], Any],
    episodes: Sequence[Sequence[Observation]],
    best: str = "best",
    rounds: int = 3,
    later: bool = False,
) -> float:
    """Median seconds of one observation (or of those after an episode's first), posterior and best explanation.

    Tables of the library are there already; nothing of an episode is kept from one round to the next.
    """
    times: list[float] = []
    prototype = make()
    for _ in range(rounds):
        times.clear()
        for seen in episodes:
            engine = prototype.fork()
            for observation in seen:
                began = time.perf_counter()
                engine.observe(observation)
                engine.posterior()
                getattr(engine, best)()
                if not later or observation is not seen[0]:
                    times.append(time.perf_counter() - began)
    return statistics.median(times)


def small() -> None:
    """The kitchen, by names."""
    plans = Domain.load("kitchen").library.ways
    pick = "pick_and_place"  # the trials of the paper's table
    rows = [f"{pick} eat", f"{pick} sip", f"{pick} cook", f"{pick} {pick} eat", f"{pick} {pick} {pick}"]
    rows += [f"{pick} {pick} wash", "sip", "eat", "wash"]
    episodes = [[Observation(name) for name in row.split()] for row in rows * 200]
    make = lambda: Chains(plans, NameMatcher(plans))  # noqa: E731
    told("kitchen (3 goals), plain Python", 1e6 * medians(make, episodes), "µs", 4)
    told("  after the first observation of an episode", 1e6 * medians(make, episodes, later=True), "µs", 4)


def large(quick: bool) -> None:
    """Ten thousand goals and more, by names."""
    cases = ((10_000, 10, 150), (10_000, 1_000, None), (100_000, 10, 1_500), (100_000, 1_000, None))
    for goals, symbols, bound in cases:
        if quick and goals > 10_000:
            continue
        plans, chance = chains(goals, 12, symbols), random.Random(1)
        episodes = [episode(plans, 5, chance) for _ in range(20)]
        figure = 1e6 * medians(lambda plans=plans: Arrays(plans, NameMatcher(plans)), episodes)
        told(f"{goals:,} goals x 12 leaves, {symbols:,} symbols, numpy", figure, "µs", bound)


def memory() -> None:
    """Bytes a leaf, for growing libraries, after forty observations."""
    for goals in (2_000, 4_000, 8_000):
        plans, chance = chains(goals, 12, 10), random.Random(1)
        _ = [plan.leaves for plan in plans]
        tracemalloc.start()
        engine = Arrays(plans, NameMatcher(plans))
        for _ in range(20):
            fork = engine.fork()
            for observation in episode(plans, 2, chance):
                fork.observe(observation)
                fork.best()
        held_bytes, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        told(f"memory, {goals:,} goals x 12 leaves", held_bytes / (12 * goals), "B", 500, "a leaf")


def explosion() -> None:
    """3.3e13 explanations, counted exactly."""
    plans, seen = chains(10, 64, 1), Observation("a0")
    times = []
    for _ in range(20):
        engine = Arrays(plans, NameMatcher(plans))
        began = time.perf_counter()
        for _ in range(12):
            engine.observe(seen)
            engine.posterior()
            engine.best()
        times.append(time.perf_counter() - began)
    assert engine.count == 32_842_147_030_560  # 10 * C(64, 12)
    what = f"10 goals x 64 leaves, 1 symbol, 12 observations: {engine.count:.2g}"
    told(what, 1e3 * statistics.median(times), "ms", 5)


def specification(quick: bool) -> None:
    """Against Algorithm 1 on copied trees, and against the enumerating baseline."""
    plans = chains(20 if quick else 100, 24, 3)
    matcher = NameMatcher(plans)
    seen = episode(plans, 3, random.Random(2))
    began = time.perf_counter()
    engine = Chains(plans, matcher)
    for observation in seen:
        engine.observe(observation)
        engine.posterior()
    ours = time.perf_counter() - began
    began = time.perf_counter()
    trees = tree_copying.explanations(plans, seen, matcher)
    theirs = time.perf_counter() - began
    assert len(trees) == engine.count
    assert trees[0].score == next(engine.explanations()).score
    told(f"{len(plans)} goals x 24 leaves, 3 symbols, {len(seen)} observations, in all", 1e3 * ours, "ms")
    what = f"  tree-copying specification ({engine.count:,} explanations)"
    told(what, 1e3 * theirs, "ms", None, f"x {theirs / ours:,.0f}")
    against(Chains(plans, matcher), Baseline(plans), seen + seen[:1])


def against(engine: Any, baseline: Baseline, seen: Sequence[Observation]) -> None:
    ours = theirs = 0.0
    for observation in seen:
        began = time.perf_counter()
        engine.observe(observation)
        posterior = engine.posterior()
        ours += time.perf_counter() - began
        began = time.perf_counter()
        baseline.observe(observation)
        expected = baseline.posterior()
        theirs += time.perf_counter() - began
        assert engine.count == len(baseline.explanations)
        assert all(abs(posterior[label] - expected[label]) < 1e-9 for label in expected)
    goals = f"up to {baseline.goals} goals at once" if baseline.goals > 1 else "one goal at a time"
    told(f"  {goals}, {len(seen)} observations, {engine.count:,} explanations", 1e3 * ours, "ms")
    told("  the same by the PHATT-style baseline", 1e3 * theirs, "ms", None, f"x {theirs / ours:,.0f}")


def several() -> None:
    """Two goals in a hundred, and five in twenty."""
    plans, chance = chains(10, 8, 2), random.Random(5)
    against(Pairs(plans, NameMatcher(plans)), Baseline(plans, 2), episode(plans, 3, chance, together=2)[:5])
    plans = chains(100, 24, 10)
    episodes = [episode(plans, 5, chance, together=2) for _ in range(4)]
    figure = medians(lambda: Pairs(plans, NameMatcher(plans)), episodes, best="standing", rounds=2)
    told("two interleaved goals of 100 x 24 leaves, 10 symbols", 1e3 * figure, "ms", 20)
    for names in (40, 12):
        longest, right = 0.0, 0
        for seed in range(6):
            chance = random.Random(seed)
            plans = partly_ordered(20, names, chance)
            pursued = chance.sample(plans, 5)
            seen = interleaved([carried_out(plan, chance) for plan in pursued], chance)[:50]
            engine = Interleaving(plans, ParameterMatcher(plans), 5)
            for observation in seen:
                began = time.perf_counter()
                engine.observe(observation)
                engine.posterior()
                best = next(engine.explanations(), None)
                longest = max(longest, time.perf_counter() - began)
            right += best is not None and set(best.goals) == {plan.label for plan in pursued}
        what = f"five of 20 goals, 5-17 partly ordered steps, {names} names: longest"
        told(what, longest, "s", 1, f"goals right in {right} of 6 episodes")


def loading(quick: bool) -> None:
    """A library of ten thousand goals, from text and from Python."""
    goals, chance = 1_000 if quick else 10_000, random.Random(0)
    rows = [[f"a{chance.randrange(10)}" for _ in range(12)] for _ in range(goals)]
    began = time.perf_counter()
    library = PlanLibrary()
    for number, row in enumerate(rows):
        library.plan(f"g{number}", *row)
    assert len(library.ways) == goals
    told(f"{goals:,} goals loaded from Python", time.perf_counter() - began, "s", 1)
    text = library.to_text()
    began = time.perf_counter()
    again = PlanLibrary.from_text(text)
    told(f"{goals:,} goals loaded from text", time.perf_counter() - began, "s", 10)
    assert again.ways == library.ways


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="smaller libraries, half a minute")
    quick = parser.parse_args().quick
    small()
    large(quick)
    memory()
    explosion()
    specification(quick)
    several()
    loading(quick)
    print(f"\n{'every bound held' if all(held) else 'some bound NOT held'}")
    return int(not all(held))


if __name__ == "__main__":
    sys.exit(main())
