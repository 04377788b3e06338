"""Whether a thing was put where it was taken to be put, before anybody could see where."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from casper.engine.perception.perception import Relations
from casper.engine.perception.world import WorldState

AROUND = 0.6  # metres from a place within which a thing was put there
STEPS = 4  # in a row for which it is in no hand and stays where it is: then it was put down
STILL = 0.1  # metres that it may seem to move meanwhile


@dataclass
class Assumed:
    """A thing that was taken up, and the place where the rules say it can only be going."""

    target: str
    place: str
    _spots: list[tuple[float, float]] = field(default_factory=list)

    def update(self, relations: Relations, world: WorldState) -> bool | None:
        """Whether it was put there; None while it is not put down, or one of the two is not seen."""
        thing, place = world.objects.get(self.target), world.objects.get(self.place)
        if thing is None or place is None or relations.holding == self.target:
            self._spots = []
            return None
        self._spots = [*self._spots, (thing.x, thing.y)][-STEPS:]
        if len(self._spots) < STEPS or math.dist(self._spots[0], self._spots[-1]) > STILL:
            return None
        return math.hypot(thing.x - place.x, thing.y - place.y) <= AROUND


def assumed(destination: str | None, args: Sequence[object]) -> Assumed | None:
    """What the rules say of the destination of an action (its arguments, filled in), where nobody saw one."""
    if destination is not None or len(args) != 2 or not all(isinstance(arg, str) for arg in args):
        return None
    return Assumed(str(args[0]), str(args[1]))
