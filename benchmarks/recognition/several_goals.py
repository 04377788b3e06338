"""Figures of several goals at once."""

from __future__ import annotations

import random
import statistics
import time
from collections.abc import Sequence

from comparison import compared
from engines import Interleaving, engine, name_of
from episodes import blurred, carried_out, episode, interleaved
from libraries import AndOr, chains, partly_ordered, strands, with_parameters
from timing import median, significant, times, told

from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import Options
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

TWO = Options(goals=2)


def by_name() -> None:
    """Two of ten goals against the baseline, two of a hundred."""
    plans, chance = chains(10, 8, 2), random.Random(5)
    episodes = [episode(plans, 3, chance, 2)[:5]]
    compared("two of 10 goals x 8 leaves, 2 names, 5 observations", plans, NameMatcher(plans), TWO, episodes)
    plans = chains(100, 24, 10)
    teller = recogniser(plans, NameMatcher(plans), TWO)
    episodes = [episode(plans, 5, chance, together=2) for _ in range(4)]
    figure = 1e3 * median(teller.fork, episodes, rounds=2)
    told("two of 100 goals x 24 leaves, 10 names", figure, "ms", 20, name_of(teller))


def with_arguments() -> None:
    """Two of a hundred goals with parameters."""
    for symbols in (10, 20):
        plans, chance = with_parameters(100, 24, symbols), random.Random(5)
        teller = recogniser(plans, ParameterMatcher(plans), TWO)
        taken = times(teller.fork, [episode(plans, 5, chance, together=2) for _ in range(6)])
        note = f"longest {significant(1e3 * max(taken))} ms, {name_of(teller)}"
        what = f"two of 100 goals x 24 leaves with parameters, {symbols} names"
        told(what, 1e3 * statistics.median(taken), "ms", 20, note)


def partial_orders(quick: bool) -> None:
    """Two of ten goals with parameters: of partly ordered steps, and of two rows of steps that interleave."""
    libraries = {"partly ordered steps": partly_ordered(10, 6), "two interleaving rows": strands(10, 2, 8, 6)}
    for what, plans in libraries.items():
        matcher, rows = ParameterMatcher(plans), pairs(plans, 3, 8, missing=0.5)
        compared(f"two of 10 goals, {what}, 6 names, 8 observations", plans, matcher, TWO, rows)
        names = [blurred(row[:6]) for row in rows[: 1 if quick else 3]]
        compared("  only names seen, 6 observations", plans, matcher, TWO, names)
        if not quick:
            compared("  only names seen, 8 observations", plans, matcher, TWO, [blurred(rows[0])])


def and_or() -> None:
    """Two goals of an and/or library of 245 productions, nine observations."""
    for symbols in (100, 50):
        library = AndOr(symbols=symbols).library()
        plans = library.ways
        what = f"and/or, two of 5 goals, {len(library.productions)} productions, partly, {symbols} names"
        compared(what, plans, NameMatcher(plans), TWO, pairs(plans, 5, 9))


def pairs(plans: Sequence[Plan], number: int, length: int, missing: float = 0.1) -> list[list[Observation]]:
    """So many episodes of two goals that interleave."""
    chance = random.Random(0)
    both = [[carried_out(plan, chance, missing) for plan in chance.sample(plans, 2)] for _ in range(number)]
    return [interleaved(rows, chance)[:length] for rows in both]


def five() -> None:
    """Five of twenty goals of partly ordered steps, up to fifty observations."""
    for names in (40, 12):
        longest, right = 0.0, 0
        for seed in range(6):
            plans, chance = partly_ordered(20, names, seed), random.Random(seed)
            pursued = chance.sample(plans, 5)
            seen = interleaved([carried_out(plan, chance) for plan in pursued], chance)[:50]
            teller = engine(Interleaving, 5)(plans, ParameterMatcher(plans))
            for observation in seen:
                began = time.perf_counter()
                teller.observe(observation)
                teller.posterior()
                best = next(teller.explanations(), None)
                longest = max(longest, time.perf_counter() - began)
            right += best is not None and set(best.goals) == {plan.label for plan in pursued}
        what = f"five of 20 goals, 5-17 partly ordered steps, {names} names: longest"
        told(what, longest, "s", 1, f"goals right in {right} of 6 episodes")


def figures(quick: bool) -> None:
    """Tell them all."""
    by_name()
    with_arguments()
    partial_orders(quick)
    and_or()
    five()
