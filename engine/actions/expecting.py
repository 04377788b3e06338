"""What the reading expects next, as weights on actions that are being made out: who follows a plan goes on with it.

Used where a sensor is poor. One that is good is believed without.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from math import fsum

SURPRISE = 0.2  # share of actions that are not what the reading expects


def planned(actions: Iterable[str], skills: Mapping[str, str], known: Collection[str]) -> frozenset[str]:
    """Those of the recognised actions that some plan has, or that are one of a plan's at some place.

    Args:
        actions: as they are recognised.
        skills: by what actions are called in their contexts, what they are recognised as.
        known: the plans' actions.
    """
    meant = {skill for meaning, skill in skills.items() if meaning in known}
    return frozenset(action for action in actions if action in known or action in meant)


def weights(
    coming: Mapping[str | None, float], skills: Mapping[str, str], actions: Collection[str]
) -> Mapping[str, float]:
    """How much likelier each action is than if nothing were known; none where nothing is expected.

    Args:
        coming: the probability of each step of a plan, as text, to be the next; None: the plan is complete.
        skills: as in `planned`.
        actions: as they are recognised.
    """
    shares = dict.fromkeys(actions, 0.0)
    for step, share in coming.items():
        name = "" if step is None else step.split("(", 1)[0]
        action = name if name in shares else skills.get(name, "")
        if action in shares:
            shares[action] += share
    total, count = fsum(shares.values()), len(shares)
    if total <= 0.0:
        return {}
    return {a: count * ((1.0 - SURPRISE) * share / total + SURPRISE / count) for a, share in shares.items()}
