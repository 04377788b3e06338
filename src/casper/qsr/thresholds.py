"""What counts as no motion: a length per step, or a speed that is a length once the step's duration is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from casper.kb.errors import TraceError


@dataclass(frozen=True, slots=True)
class Distance:
    """Metres a step, whatever its duration (QSRlib's quantisation factor)."""

    metres: float

    def __post_init__(self) -> None:
        if not self.metres >= 0.0:
            raise TraceError(f"a threshold is a length from 0, not {self.metres} m")

    def per_step(self, dt: Any) -> Any:
        """Metres in a step of ``dt`` seconds: a number, whatever that is."""
        return self.metres


@dataclass(frozen=True, slots=True)
class Speed:
    """Metres a second: what it means for a step depends on how long the step is, so frame rates do not matter."""

    metres_per_second: float

    def __post_init__(self) -> None:
        if not self.metres_per_second >= 0.0:
            raise TraceError(f"a threshold is a speed from 0, not {self.metres_per_second} m/s")

    def per_step(self, dt: Any) -> Any:
        """Metres in a step of ``dt`` seconds: a number; an array of durations gives an array."""
        return self.metres_per_second * dt


Threshold = Distance | Speed
PAPER = Speed(0.09)
"""The paper's: .09 m in a step of 1 s."""
NONE = Distance(0.0)
