"""How long movements last: an Erlang distribution each, by phases that follow one another (explicit state expansion).

A movement of one phase ends at any moment with the same chance, which makes very short ones the likeliest. One of
several phases (Cox's method of stages) lasts about as long as it uses to: its mean stays, its spread is less.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from casper.engine.settings import Rows, number, require

MOST_PHASES = 6
LEARNED = 3  # phases at most, of a duration that is learned
ENOUGH = 10  # times that a movement was seen from beginning to end


@dataclass(frozen=True, slots=True)
class Duration:
    """``mean`` seconds, in ``phases`` of equal length: the standard deviation is mean / √phases."""

    mean: float
    phases: int = 1

    def __post_init__(self) -> None:
        require(self.mean > 0.0 and math.isfinite(self.mean), "a movement lasts longer than no time")
        require(1 <= self.phases <= MOST_PHASES, f"a movement has from 1 to {MOST_PHASES} phases, not {self.phases}")

    def passed(self, dt: float) -> tuple[float, ...]:
        """How likely 0, 1, … phases have passed in ``dt`` seconds, of fewer than all."""
        rate = self.phases * max(dt, 0.0) / self.mean
        first = math.exp(-rate)
        return tuple(first * rate**k / math.factorial(k) for k in range(self.phases))


def read_durations(rows: Rows, movements: tuple[str, ...], otherwise: float) -> Mapping[str, Duration]:
    """Facts ``lasts(Movement, Seconds, Phases)``; a movement without one lasts ``otherwise`` seconds, in one phase.

    Raises:
        DomainError: an unknown movement, a time or a number of phases that is none, or two facts for one movement.
    """
    found: dict[str, Duration] = {}
    for movement, seconds, phases in rows("lasts", 3):
        where = f"lasts({movement}, {seconds}, {phases})"
        require(movement in movements, f"{where} names a movement no transition has")
        require(movement not in found, f"lasts({movement}, …) is there twice")
        require(isinstance(phases, int), f"{where}: phases are counted")
        found[movement] = Duration(number(seconds, where), phases)
    return {movement: found.get(movement, Duration(otherwise)) for movement in movements}


def fitted(seconds: Sequence[float], most: int = MOST_PHASES) -> Duration:
    """The duration with the mean and, as far as that many phases can, the spread of what was measured."""
    mean = math.fsum(seconds) / len(seconds)
    spread = math.fsum([(each - mean) ** 2 for each in seconds]) / len(seconds)
    wanted = most if spread * most <= mean * mean else round(mean * mean / spread)
    return Duration(mean, max(1, min(most, wanted)))


def durations_text(lasted: Mapping[str, Sequence[float]]) -> str:
    """Facts ``lasts/3`` of movements that were measured often enough; people are less regular than scripts."""
    known = {name: fitted(seconds, LEARNED) for name, seconds in sorted(lasted.items()) if len(seconds) >= ENOUGH}
    lines = [f"lasts({name}, {each.mean:.1f}, {each.phases})." for name, each in known.items()]
    return "\n".join(["% lasts(Movement, Seconds, Phases): mean time, and how regular it is.", *lines]) + "\n"
