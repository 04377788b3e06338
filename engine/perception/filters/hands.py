"""What is told of hands, by a sensor that guesses it from how near things seem to be."""

from __future__ import annotations

import math

IF_NEAR = 0.06  # how often what rests near somebody is told to be in the hand


def told_of_hand(if_carried: float, is_held: bool, is_telling: bool) -> tuple[float, float]:
    """How likely what is told of the hands is when a thing rests and when it is carried.

    A hand is told by how near the thing seems to be, so the more noise the less it says (`told_if_carried`).

    Args:
        if_carried: how often what is in a hand is told to be so.
        is_held: whether somebody is told to hold it.
        is_telling: whether it is seen, and near somebody who is seen.
    """
    if is_held:
        return IF_NEAR, if_carried
    return (1 - IF_NEAR, 1 - if_carried) if is_telling else (1.0, 1.0)


def told_if_carried(noise: float) -> float:
    """How often what is in a hand is told to be so, by how near both seem to be."""
    return max(0.95 * math.exp(-((noise / 0.05) ** 2)), 0.07)


def evidence_of(share: float, noise: float) -> float:
    """What speaks for it that a hand holds something.

    The less the hands are told of, the likelier one that is near something is free, and the more a small share says.
    """
    usual = min(max(0.5 * told_if_carried(noise), 0.12), 0.5)
    held, free = share / usual, (1.0 - share) / (1.0 - usual)
    return held / (held + free)
