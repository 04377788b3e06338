"""A third person comes in and puts something elsewhere that the goal needs."""

from __future__ import annotations

import random
from dataclasses import replace

from casper.kb.errors import DomainError
from casper.sim_adapter.partners.conduct import Conduct, Surroundings
from casper.sim_adapter.steps import Step

LATEST = 20.0  # seconds after which they begin
MOST = 2  # things


def visited(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """One thing or two of the first goal are taken somewhere else by somebody whose goals nobody reads."""
    needed = [name for name in sorted(surroundings.moved(conduct.stretches[0])) if surroundings.spots(name)]
    if not needed:
        raise DomainError("a visitor finds no free spot to put a thing of the goal at: make more furniture")
    things = draw.sample(needed, k=min(len(needed), draw.randint(1, MOST)))
    steps = [Step("still", seconds=round(draw.uniform(0.0, LATEST), 1))]
    taken: list[tuple[float, float, float]] = []
    for thing in things:
        taken.append(draw.choice([spot for spot in surroundings.spots(thing) if spot not in taken]))
        steps.append(Step("set_down", thing, spot=taken[-1]))
    told = f"a visitor puts {' and '.join(things)} elsewhere"
    return replace(conduct, visit=(*conduct.visit, *steps, Step("stand_aside")), told=(*conduct.told, told))
