"""When a goal is sure enough to act on: one rule, one knob (`setting(collaboration, certainty, P)`).

How sure a goal is, is its posterior times the probability that at least one of the actions that speak for it was
really one for it. An action that was recognised with probability p, and that people do for nothing in one case of ten,
is one with probability 0.9 p; so after one action that was clearly seen a goal is 0.9 sure at most, after two 0.99,
after three 0.999.

Below the knob nothing is announced, and nothing is done. At 0, the default, the robot acts on whatever the policy
commits to, as in the paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from casper.engine.settings import Rows, read_settings, require

NEEDLESS = 0.1  # how probable it is that an action serves no goal, or another than it seems to


@dataclass(frozen=True, slots=True)
class ActingSettings:
    """When the robot acts.

    certainty: how sure a goal must be, from 0 (whatever the policy commits to) to 1 (never).
    """

    certainty: float = 0.0

    def __post_init__(self) -> None:
        sentence = f"the certainty from which the robot acts lies between 0 and 1, not {self.certainty:g}"
        require(0.0 <= self.certainty <= 1.0, sentence)


def acting_settings(rows: Rows, certainty: float | None = None) -> ActingSettings:
    """Settings from facts ``setting(collaboration, Name, Value)``, the certainty as it is given where it is.

    Raises:
        DomainError: an unknown setting, a value of the wrong kind, or a certainty that is none.
    """
    settings = read_settings(ActingSettings, rows, "collaboration")
    return settings if certainty is None else replace(settings, certainty=certainty)


def sureness(posterior: float, seen: Iterable[float]) -> float:
    """How sure a goal is.

    Args:
        posterior: its share of all scores.
        seen: of each action that speaks for it the probability with which it was recognised.

    Returns:
        ``posterior * (1 - product(1 - (1 - NEEDLESS) * p for p in seen))``
    """
    return posterior * (1.0 - math.prod(1.0 - (1.0 - NEEDLESS) * p for p in seen))
