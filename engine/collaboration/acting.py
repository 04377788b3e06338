"""When a goal is sure enough to act on: one rule, one knob (`setting(collaboration, certainty, P)`).

How sure a goal is, is its posterior times the probability that at least one of the actions that speak for it was
really one for it. An action that was recognised with probability p, and that people do for nothing in one case of ten,
is one with probability 0.9 p; so after one action that was clearly seen a goal is 0.9 sure at most, after two 0.99,
after three 0.999.

That is weighed against what else the goal asks one to believe: that actions before these went unseen (three of ten do,
where the sensor is trusted), and that somebody gave up what they were at (one of ten who seem to). After one action a
goal is 0.73 sure with one unseen before it, 0.45 with two, 0.47 where another goal was given up for it.

Below the knob nothing is announced, and nothing is done. By default a goal must be as likely as not; at 0 the robot
acts on whatever the policy commits to, as in the paper.

Where the sensor is poor many explanations are left, and the policy would hardly ever commit. Then a goal is believed in
from a share of them on, and the robot's turn has come from the same: the knob, but 0.8 at least. A share is not how
sure a goal is: it says which of the explanations, not whether there was anything to explain, so both are asked.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from casper.engine.settings import Rows, read_settings, require

NEEDLESS = 0.1  # how probable it is that an action serves no goal, or another than it seems to
UNSEEN = 0.3  # how probable it is that an action goes unseen
DOUBTFUL = 0.8  # share of all explanations which it takes where the sensor is poor, at least
CHANGED = 0.1  # how probable it is that somebody who seems to have given up a goal has done so


@dataclass(frozen=True, slots=True)
class ActingSettings:
    """When the robot acts.

    certainty: how sure a goal must be, from 0 (whatever the policy commits to) to 1 (never).
    """

    certainty: float = 0.5

    def __post_init__(self) -> None:
        sentence = f"the certainty from which the robot acts lies between 0 and 1, not {self.certainty:g}"
        require(0.0 <= self.certainty <= 1.0, sentence)

    @property
    def share(self) -> float:
        """The share of all explanations from which something is believed where the sensor is poor."""
        return max(self.certainty, DOUBTFUL)


def acting_settings(rows: Rows, certainty: float | None = None) -> ActingSettings:
    """Settings from facts ``setting(collaboration, Name, Value)``, the certainty as it is given where it is.

    Raises:
        DomainError: an unknown setting, a value of the wrong kind, or a certainty that is none.
    """
    settings = read_settings(ActingSettings, rows, "collaboration")
    return settings if certainty is None else replace(settings, certainty=certainty)


def sureness(posterior: float, seen: Iterable[float], unseen: int = 0, instead: bool = False) -> float:
    """How sure a goal is.

    Args:
        posterior: its share of all scores.
        seen: of each action that speaks for it the probability with which it was recognised.
        unseen: how many actions must have gone unseen.
        instead: whether another goal, which was believed in, must have been given up for it.

    Returns:
        ``posterior * for_it / (for_it + chance)``, where ``chance = product(1 - (1 - NEEDLESS) * p for p in seen)``
        and ``for_it = (1 - chance) * UNSEEN**unseen``, times ``CHANGED`` if it is instead of another.
    """
    chance = math.prod(1.0 - (1.0 - NEEDLESS) * p for p in seen)
    for_it = (1.0 - chance) * UNSEEN**unseen * (CHANGED if instead else 1.0)
    return posterior * for_it / (for_it + chance) if for_it else 0.0
