"""Figures of libraries being loaded."""

from __future__ import annotations

import random
import time

from timing import told

from casper.plans.library import PlanLibrary


def figures(quick: bool) -> None:
    """A library of ten thousand goals, from Python and from text."""
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
