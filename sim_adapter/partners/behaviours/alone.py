"""Asks for nothing: does everything alone, whatever the robot announces, and waits for nobody."""

from __future__ import annotations

import random
from dataclasses import replace

from casper.sim_adapter.partners.conduct import Conduct, Surroundings


def alone(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """Every step that is not another one's by the plan, they do."""
    return replace(conduct, keeps=None, told=(*conduct.told, "does everything alone"))
