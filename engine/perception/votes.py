"""Who is attended to, by votes in a window of steps; a winner stays until another wins.

The paper's section Focus Estimation: a target and a destination, each with a window of its own.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from typing import NamedTuple

Slots = tuple[Sequence[str], ...]
State = tuple[Slots, Slots, str | None, str | None, Sequence[str]]
"""Both windows, target, destination, and whoever was attended to last."""


class Windows(NamedTuple):
    """How many steps are looked back on, and how many of them a winner needs."""

    target: int
    target_votes: int
    destination: int
    destination_votes: int


class Ballot(NamedTuple):
    """What one step says, in the order of the scores.

    best: the names whose score is best, none where nothing scores. worthy: those of them that may be a destination.
    second: where one is best alone, those that come next and may be a destination. clear: the best is above the
    threshold.
    """

    best: Sequence[str]
    worthy: Sequence[str]
    second: Sequence[str]
    clear: bool


NOBODY = Ballot((), (), (), False)


class Votes:
    """The two windows and their winners.

    A step in which nothing is clearly best casts an empty vote. Ties: two equal best of which one
    is the target leave it the target and make the other a candidate for the destination; otherwise both are
    candidates for the target, in the same step. Of three or more none can be clearly best: they vote for the
    target that is, if it is one of them, the others for the destination, else all for the target. There is no
    destination without a target.
    """

    __slots__ = ("_attended", "_destinations", "_targets", "attended", "destination", "target", "windows")

    def __init__(self, windows: Windows) -> None:
        self.windows = windows
        self.reset()

    def reset(self) -> None:
        """Forget the target, the destination and the votes."""
        self.target: str | None = None
        self.destination: str | None = None
        self.attended: tuple[str, ...] = ()
        self._attended: Sequence[str] = ()
        self._targets: deque[Sequence[str]] = deque(maxlen=self.windows.target)
        self._destinations: deque[Sequence[str]] = deque(maxlen=self.windows.destination)

    @property
    def state(self) -> State:
        """All that decides what later votes do."""
        return tuple(self._targets), tuple(self._destinations), self.target, self.destination, self._attended

    @state.setter
    def state(self, given: State) -> None:
        targets, destinations, self.target, self.destination, self._attended = given
        self._targets = deque(targets, self.windows.target)
        self._destinations = deque(destinations, self.windows.destination)

    def cast(self, ballot: Ballot) -> None:
        """Take in one step."""
        for_target, for_destination = self._candidates(ballot)
        self._targets.append(for_target)
        self.target = _winner(_elected(self._targets, self.windows.target_votes), self.target, None)
        if self.destination == self.target:
            self.destination = None
        self.attended = ()
        if self.target is not None:
            now = tuple([name for name in for_destination if name != self.target])
            self._destinations.append(now)
            elected = _elected(self._destinations, self.windows.destination_votes)
            self.destination = _winner(elected, self.destination, self.target)
            self.attended = self._looked_at(now, elected)

    def _looked_at(self, now: Sequence[str], elected: Mapping[str, int]) -> tuple[str, ...]:
        """The destinations with enough votes, if one of them is voted for in this step; as before where nothing is."""
        if now:
            if elected.keys().isdisjoint(now):
                return ()
            self._attended = tuple(elected)
        return tuple([name for name in self._attended if name != self.target])

    def _candidates(self, ballot: Ballot) -> tuple[Sequence[str], Sequence[str]]:
        """Who this step votes for, as target and as destination."""
        best, worthy, second, clear = ballot
        if len(best) < 2:
            return best if clear else (), second
        if self.target not in best:
            return best if clear or len(best) > 2 else (), ()
        stays = (self.target,) if self.target is not None and self.target in best and (clear or len(best) > 2) else ()
        return stays, tuple([name for name in worthy if name != self.target])


def _elected(window: deque[Sequence[str]], needed: int) -> dict[str, int]:
    """Who has the votes, and how many, in the order of being named."""
    times = len(window)
    if window.count(window[0]) == times:  # as mostly: everybody in it has every vote
        return dict.fromkeys(window[0], times) if times >= needed else {}
    votes: dict[str, int] = {}
    for slot in window:
        for name in slot:
            votes[name] = votes.get(name, 0) + 1
    return {name: count for name, count in votes.items() if count >= needed}


def _winner(elected: Mapping[str, int], current: str | None, barred: str | None) -> str | None:
    """The current one if it is elected, else whoever has most votes (the first named, if equal)."""
    if current is not None and current in elected:  # who is barred is nobody's current choice
        return current
    return max((name for name in elected if name != barred), key=elected.__getitem__, default=current)
