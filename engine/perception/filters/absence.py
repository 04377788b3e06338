"""What is gone: a thing that goes unseen where its neighbours are seen, too often for that to be chance."""

from __future__ import annotations

import math
from collections.abc import Mapping

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
        self, seen: Mapping[str, ObjectState], spots: Mapping[str, tuple[float, float]], quality: Quality
    ) -> None:
        """One world state.

        Args:
            seen: what is detected.
            spots: where each thing is believed to be, x and y in metres.
            quality: of the sensor.
        """
        lost = quality.lost + MARGIN
        for name, (x, y) in spots.items():
            if name in seen:
                self._chances.pop(name, None)
            elif lost <= MOST and any(math.hypot(other.x - x, other.y - y) <= BESIDE for other in seen.values()):
                self._chances[name] = self._chances.get(name, 1.0) * lost

    def is_gone(self, name: str) -> bool:
        """Whether it is hardly there any more."""
        return self._chances.get(name, 1.0) < GONE
