"""Figures of plain plans by names, one goal at a time."""

from __future__ import annotations

import random
import statistics
import time
import tracemalloc
from math import comb

from comparison import compared, seconds
from engines import Arrays, Chains, engine, name_of
from episodes import episode
from libraries import chains
from timing import median, significant, told

from casper import Domain
from casper.engine.explanation import tree_copying
from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import PAPER
from casper.engine.recognition.teller import Teller
from casper.engine.verification.matching import NameMatcher
from casper.engine.verification.observation import Observation


def kitchen() -> None:
    """The kitchen: the trials of the paper's table."""
    plans = Domain.load("kitchen").library.ways
    pick = "pick_and_place"
    rows = [f"{pick} eat", f"{pick} sip", f"{pick} cook", f"{pick} {pick} eat", f"{pick} {pick} {pick}"]
    rows += [f"{pick} {pick} wash", "sip", "eat", "wash"]
    episodes = [[Observation(name) for name in row.split()] for row in rows * 200]

    def make() -> Teller:
        return engine(Chains)(plans, NameMatcher(plans))

    told("kitchen (3 goals), plain Python", 1e6 * median(make, episodes, "best"), "µs", 4)
    later = median(make, episodes, "best", later=True)
    told("  after the first observation of an episode", 1e6 * later, "µs", 4)


def large(quick: bool) -> None:
    """Ten thousand goals and more."""
    cases = ((10_000, 10, 150), (10_000, 1_000, None), (100_000, 10, 1_500), (100_000, 1_000, None))
    for goals, symbols, bound in cases[:2] if quick else cases:
        plans, chance = chains(goals, 12, symbols), random.Random(1)
        episodes = [episode(plans, 5, chance) for _ in range(20)]
        teller = engine(Arrays)(plans, NameMatcher(plans))
        figure = 1e6 * median(teller.fork, episodes, "best")
        told(f"{goals:,} goals x 12 leaves, {symbols:,} names, numpy", figure, "µs", bound)


def memory() -> None:
    """Bytes a leaf, for growing libraries, after forty observations."""
    for goals in (2_000, 4_000, 8_000):
        plans, chance = chains(goals, 12, 10), random.Random(1)
        _ = [plan.leaves for plan in plans]
        tracemalloc.start()
        teller = engine(Arrays)(plans, NameMatcher(plans))
        for _ in range(20):
            fork = teller.fork()
            for observation in episode(plans, 2, chance):
                fork.observe(observation)
                fork.best()
        held_bytes, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        told(f"memory, {goals:,} goals x 12 leaves", held_bytes / (12 * goals), "B", 500, "a leaf")


def explosion() -> None:
    """3.3e13 explanations, counted exactly."""
    plans, seen = chains(10, 64, 1), [Observation("a0")] * 12
    what = "10 goals x 64 leaves, 1 name, 12 observations"
    most = compared(what, plans, NameMatcher(plans), PAPER, [seen], 5)
    assert most == 10 * comb(64, 12)


def specification(quick: bool) -> None:
    """Against the plain baseline, and against Algorithm 1 on copied trees."""
    plans = chains(20 if quick else 100, 24, 3)
    matcher, seen = NameMatcher(plans), episode(plans, 4, random.Random(2))
    compared(f"{len(plans)} goals x 24 leaves, 3 names, 4 observations", plans, matcher, PAPER, [seen])
    seen.pop()
    ours = statistics.median(seconds(recogniser(plans, matcher, PAPER), seen) for _ in range(3))
    began = time.perf_counter()
    trees = tree_copying.explanations(plans, seen, matcher)
    theirs = time.perf_counter() - began
    teller = recogniser(plans, matcher, PAPER)
    for observation in seen:
        teller.observe(observation)
    assert len(trees) == teller.count
    assert trees[0].score == next(teller.explanations()).score
    told("  the first 3 of them", 1e3 * ours, "ms", None, f"{len(trees):,} explanations, {name_of(teller)}")
    told("  tree-copying specification, equal answers", 1e3 * theirs, "ms", None, f"x {significant(theirs / ours)}")


def figures(quick: bool) -> None:
    """Tell them all."""
    kitchen()
    large(quick)
    memory()
    explosion()
    specification(quick)
