"""Wanders: goes here and there between steps, and handles things that the goal does not need."""

from __future__ import annotations

import random

from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings
from casper.sim_adapter.steps import Step

MOST = 3  # times that they wander
SHORTEST, LONGEST = 1.0, 4.0  # seconds that they stay where they went


def wandering(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """One to three times, before steps of their own: to some object; to take up and put back, or to put elsewhere, a
    thing that no step needs. The first time it is a thing, where there is one."""
    for at, stretch in enumerate(conduct.stretches):
        where = range(max(1, surroundings.own(stretch)))
        times = sorted(draw.choices(where, k=draw.randint(1, MOST)), reverse=True)
        for number, before in enumerate(times):
            steps, told = _wander(stretch, surroundings, draw, handles=number == 0)
            stretch = stretch.with_asides(before, *steps)
            conduct = conduct.changed(at, stretch, f"{told} before step {before + 1}")
    return conduct


def _wander(
    stretch: Stretch, surroundings: Surroundings, draw: random.Random, handles: bool
) -> tuple[tuple[Step, ...], str]:
    """What they do once, and how it is told."""
    needless = sorted(set(surroundings.scene.movables) - stretch.things)
    how = draw.choice(["goes", "handles", "moves"]) if not handles else draw.choice(["handles", "moves"])
    thing = draw.choice(needless) if needless else None
    spots = surroundings.spots(thing) if thing is not None and how == "moves" else []
    if thing is not None and spots:
        return (Step("set_down", thing, spot=draw.choice(spots)),), f"puts {thing} elsewhere"
    if thing is not None and how != "goes":
        return (Step("handle", thing),), f"takes {thing} up and puts it back"
    place = draw.choice(sorted(surroundings.scene.things))
    pause = Step("still", seconds=round(draw.uniform(SHORTEST, LONGEST), 1))
    return (Step("walk_to", place), pause), f"goes to {place}"
