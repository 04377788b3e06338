"""Changes their mind: the first goal is given up for another one at a random point; the world is as it was left."""

from __future__ import annotations

import random
from dataclasses import replace

from casper.kb.errors import DomainError
from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings


def fickle(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """After one step or more, and before all is done that only they can do, the partner goes over to another goal.

    Until then nothing was moved that the other goal needs where it was.
    """
    first = conduct.stretches[0]
    second = surroundings.another(first, conduct, draw)
    points = [n for n in range(1, surroundings.own(first)) if _moved(first, n).isdisjoint(second.things)]
    if not points:
        raise DomainError(f"{first.goals[0]} cannot be given up for {second.goals[0]}: it needs what was moved by then")
    stops = draw.choice(points)
    given_up = replace(first, stops=stops)
    told = f"gives {first.goals[0]} up for {second.goals[0]} after step {stops}"
    changed = replace(conduct, stretches=(given_up, second, *conduct.stretches[2:]))
    return replace(changed, told=(*conduct.told, told))


def _moved(stretch: Stretch, steps: int) -> set[str | None]:
    """What has been moved after so many steps."""
    return {scripted.step.target for scripted in stretch.script[:steps] if scripted.step.skill != "walk_to"}
