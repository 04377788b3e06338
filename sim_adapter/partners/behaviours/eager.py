"""Does the robot's part although it was announced, or a piece of it."""

from __future__ import annotations

import random
from dataclasses import replace

from casper.sim_adapter.partners.conduct import Conduct, Surroundings

MOST = 2  # steps


def eager(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """The first step or two of what the robot announces they do all the same; the others are left to the robot."""
    keeps = draw.randint(1, MOST)
    count = "the first step" if keeps == 1 else f"the first {keeps} steps"
    return replace(conduct, keeps=keeps, told=(*conduct.told, f"does {count} of what the robot announces"))
