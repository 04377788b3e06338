"""Stands in the way: where the robot has something to do, for a while."""

from __future__ import annotations

import random

from casper.sim_adapter.partners.conduct import Conduct, Surroundings
from casper.sim_adapter.steps import Step

SHORTEST, LONGEST = 10.0, 45.0  # seconds


def blocking(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """When their own part is done they go to a place of what is left, and stand there for 10 to 45 seconds."""
    for at, stretch in enumerate(conduct.stretches):
        own = surroundings.own(stretch)
        left = [scripted.step for scripted in stretch.script[own:] or stretch.script[-1:]]
        places = sorted({name for step in left for name in (step.target, step.destination) if name is not None})
        place, seconds = draw.choice(places), round(draw.uniform(SHORTEST, LONGEST), 1)
        stretch = stretch.with_asides(own, Step("walk_to", place), Step("still", seconds=seconds))
        conduct = conduct.changed(at, stretch, f"stands before {place} for {seconds:g} s after step {own}")
    return conduct
