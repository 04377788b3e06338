"""What was brought somewhere while the partner was out of sight: known from where it lies."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from casper.engine.perception.world import WorldState

CARRYING = "pick_and_place"  # the action that brings a thing to a place (paper, section "Movement Classification")
AT = 0.3  # metres from the middle of a place within which a thing lies there
MOVED = 0.5  # metres between two places of a thing from which it was carried


@dataclass
class Unwatched:
    """Where things lay last, and which of them the partner may have carried since."""

    partner: str
    _lay: dict[str, tuple[float, float]] = field(default_factory=dict)
    _alone: set[str] = field(default_factory=set)  # the partner has been out of sight since they were seen to lie there

    def update(self, world: WorldState) -> list[tuple[str, str]]:
        """What lies where it did not lie, and in what: (thing, place).

        Nothing that somebody else was seen to hold since, nor what came along with something else.
        """
        held = {agent.holding: name for name, agent in world.agents.items()}
        if self.partner not in world.agents:
            self._alone.update(self._lay)
        moved = []
        for name, thing in world.objects.items():
            here, before = (thing.x, thing.y), self._lay.get(name)
            if name in held:
                if held[name] != self.partner:
                    self._lay.pop(name, None)
                    self._alone.discard(name)
                continue
            if before is not None and math.dist(before, here) > MOVED:
                if name in self._alone:
                    moved.append(name)
                self._alone.discard(name)
            self._lay[name] = here
        return [(name, place) for name in moved for place in self._in(name, moved, world)]

    def _in(self, name: str, moved: list[str], world: WorldState) -> list[str]:
        """What stayed where it was, and is where a thing is now."""
        here = self._lay[name]
        rest = ((other, (at.x, at.y)) for other, at in world.objects.items() if other not in moved)
        return [other for other, at in rest if math.dist(at, here) < AT]
