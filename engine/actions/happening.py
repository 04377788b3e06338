"""Where each action seems to have happened, while it is not sure that it did: chances by target and place.

An action that is made out late is about what was there when it happened. So whatever chance an action gains is put down
to the target and the places of that moment, as they are known best before the agent walks on.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import fsum
from typing import TypeAlias

Spot: TypeAlias = tuple[str | None, str | None]
"""Target and destination; None is unknown."""

NEWS = 0.3  # share of the last step in what is known of a place where somebody stands


class _Chances:
    """Those of one action: where the agent was before, and where it stands now."""

    __slots__ = ("gained", "here", "total", "where")

    def __init__(self) -> None:
        self.total = self.gained = 0.0
        self.here: Mapping[Spot, float] = {}
        self.where: dict[Spot, float] = {}

    def note(self, score: float, here: Mapping[Spot, float], walks: bool) -> None:
        if score < self.total:
            left = score / self.total
            self.gained *= left
            self.where = {spot: chance * left for spot, chance in self.where.items()}
        else:
            self.gained += score - self.total
        self.total = score
        self.here = here if not self.here else self.here if walks else _faded(self.here, here)
        if walks:
            self.where, self.gained = self.shares, 0.0
            self.here = {}

    @property
    def shares(self) -> dict[Spot, float]:
        shares = dict(self.where)
        for spot, share in self.here.items():
            shares[spot] = shares.get(spot, 0.0) + share * self.gained
        return shares


def _faded(before: Mapping[Spot, float], now: Mapping[Spot, float]) -> Mapping[Spot, float]:
    """What was known of a place where somebody stands, with what is known by now; nothing known changes nothing."""
    if all(place is None for _, place in now):
        return before
    if all(place is None for _, place in before):
        return now
    return {spot: (1 - NEWS) * before.get(spot, 0.0) + NEWS * now.get(spot, 0.0) for spot in {**before, **now}}


class Happening:
    """Takes in what every step says (`note`); tells it of an action (`of`)."""

    def __init__(self) -> None:
        self._of: dict[str, _Chances] = {}

    def reset(self) -> None:
        """An action was accepted: whatever comes now begins anew."""
        self._of.clear()

    def note(self, scores: Mapping[str, float], here: Mapping[Spot, float], walks: bool) -> None:
        """One step.

        Args:
            scores: the probability of each action to have happened by now.
            here: what an action of this moment would be about, shares that add up to 1.
            walks: whether the agent is on its way.
        """
        for action, score in scores.items():
            self._of.setdefault(action, _Chances()).note(score, here, walks)

    def of(self, action: str) -> dict[Spot, float]:
        """What the action is about, likeliest first; shares that add up to 1, none where nothing speaks for it."""
        found = self._of[action].shares if action in self._of else {}
        total = fsum(found.values())
        return {s: c / total for s, c in sorted(found.items(), key=lambda item: -item[1]) if c} if total > 0.0 else {}
