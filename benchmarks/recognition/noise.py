"""Figures with needless observations at a price."""

from __future__ import annotations

import random
from dataclasses import replace

from comparison import compared
from engines import name_of
from episodes import carried_out, episode
from libraries import chains, with_parameters
from timing import median, told

from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import NameMatcher, ParameterMatcher

NOISE = Options(noise=0.1)


def large(quick: bool) -> None:
    """Ten thousand goals by names, the engine that a reading picks."""
    for goals in (10_000,) if quick else (10_000, 100_000):
        plans, chance = chains(goals, 12, 10), random.Random(1)
        teller = recogniser(plans, NameMatcher(plans), NOISE)
        episodes = [episode(plans, 5, chance) for _ in range(20)]
        figure = 1e6 * median(teller.fork, episodes)
        told(f"noise, {goals:,} goals x 12 leaves, 10 names", figure, "µs", None, name_of(teller))


def small() -> None:
    """Against the baseline: by names, with parameters, and two goals at once."""
    chance = random.Random(1)
    plans = chains(20, 24, 5)
    for length in (5, 10):
        what = f"noise, 20 goals x 24 leaves, 5 names, {length} observations"
        compared(what, plans, NameMatcher(plans), NOISE, [episode(plans, length, chance)])
    plans = with_parameters(20, 24, 5)
    episodes = [carried_out(plan, chance, missing=0.5)[:9] for plan in chance.sample(plans, 3)]
    compared("  with parameters, 9 observations", plans, ParameterMatcher(plans), NOISE, episodes)
    plans = chains(20, 12, 5)
    seen, two = episode(plans, 2, chance, together=2), replace(NOISE, goals=2)
    compared("noise, two of 20 goals x 12 leaves, 5 names, 4 observations", plans, NameMatcher(plans), two, [seen])


def figures(quick: bool) -> None:
    """Tell them all."""
    large(quick)
    small()
