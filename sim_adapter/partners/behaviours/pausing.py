"""Pauses: stands still for a while before some steps."""

from __future__ import annotations

import random

from casper.sim_adapter.partners.conduct import Conduct, Surroundings
from casper.sim_adapter.steps import Step

MOST = 3  # pauses
SHORTEST, LONGEST = 5.0, 25.0  # seconds of one


def pausing(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """One to three pauses of 5 to 25 seconds, before steps that they do themselves."""
    for at, stretch in enumerate(conduct.stretches):
        where = range(max(1, surroundings.own(stretch)))
        for before in sorted(draw.choices(where, k=draw.randint(1, MOST)), reverse=True):
            seconds = round(draw.uniform(SHORTEST, LONGEST), 1)
            stretch = stretch.with_asides(before, Step("still", seconds=seconds))
            conduct = conduct.changed(at, stretch, f"pauses for {seconds:g} s before step {before + 1}")
    return conduct
