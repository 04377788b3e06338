"""What is gone: a thing that goes unseen where its neighbours are seen, too often for that to be chance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from casper.engine.perception.filters.quality import Quality
from casper.engine.perception.world import ObjectState

BESIDE = 1.0  # metres: who sees one of two things within it looks at the other, too
MARGIN = 0.1  # share of lost detections above what is sure that there may be
MOST = 0.85  # share of lost detections beyond which nothing can be said
GONE = 1e-3  # the chance that it is there and all of its detections were lost


class Absences:
    """Takes in what is seen (`update`); says what is gone (`is_gone`), until it is seen again."""

    def __init__(self) -> None:
        self._chances: dict[str, float] = {}

    def update(
        self, seen: Mapping[str, ObjectState], spots: Mapping[str, Sequence[float]], quality: Quality
    ) -> None:
        """One world state.

        Args:
            seen: what is detected.
            spots: where things are believed to be, x and y in metres first; of what is detected it does not matter.
            quality: of the sensor.
        """
        for name in [name for name in self._chances if name in seen]:
            del self._chances[name]
        lost = quality.lost + MARGIN
        for name, (x, y, *_) in spots.items():
            if name not in seen and lost <= MOST and _is_beside(x, y, seen):
                self._chances[name] = self._chances.get(name, 1.0) * lost

    def is_gone(self, name: str) -> bool:
        """Whether it is hardly there any more."""
        return self._chances.get(name, 1.0) < GONE


def _is_beside(x: float, y: float, seen: Mapping[str, ObjectState]) -> bool:
    """Whether something is seen beside a place."""
    return any(math.hypot(other.x - x, other.y - y) <= BESIDE for other in seen.values())
