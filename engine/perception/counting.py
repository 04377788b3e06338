"""Votes on sets of names that are numbers: all steps of a recording are counted at once.

A step's ballot is decided by its scores alone, except where several are best: then it matters who is the target
already. So the targets are guessed, the votes counted, and that is done again with the targets found until nothing
changes any more; as each step depends on earlier ones only, what does not change is what counting step by step finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from casper.engine.perception.votes import State, Votes

Array = NDArray[Any]
ROUNDS = 12
"""Guesses after which it is given up."""
_NONE = np.int64(0)


class Count:
    """The count of one chunk. Sets of one name stand for that name, the empty set for nobody."""

    def __init__(
        self, names: Sequence[str], votes: Votes, best: Array, second: Array, many: Array, clear: Array, worthy: Array
    ) -> None:
        self.names, self.windows = names, votes.windows
        self._bit = {name: 1 << place for place, name in enumerate(names)}
        slots, further, target, destination, attended = votes.state
        self._slots, self._further = ([self._set(slot) for slot in window] for window in (slots, further))
        self._first, self._first_further = self._set([target]), self._set([destination])
        self._first_attended = self._set(attended)
        self._certain = np.where((many == 1) & clear, best, _NONE)
        self._best, self._second, self._many, self._clear = best, second, many, clear
        self._ties = np.flatnonzero(many > 1)
        self._worthy = np.where(worthy, best, _NONE)
        self._alone = np.where(many == 1, second, _NONE)

    def _set(self, names: Sequence[str | None]) -> Any:
        return np.int64(sum(self._bit[name] for name in names if name is not None))

    def settle(self) -> bool:
        """Find targets and destinations; False if guessing leads nowhere.

        The first guess is that where several are best nobody is voted for: who is the target mostly stays it then.
        """
        guess = self._targets(self._certain)[1] if len(self._ties) else np.full(len(self._best), self._first)
        for _ in range(ROUNDS):
            votes, candidates = self._cast(_shifted(guess, self._first))
            self._all_slots, self.target = self._targets(votes)
            if not len(self._ties) or np.array_equal(self.target, guess):
                return self._settle_destinations(candidates)
            guess = self.target
        return False

    def _cast(self, before: Array) -> tuple[Array, Array]:
        """Who each step votes for as target and as destination, given who was the target."""
        if not len(self._ties):
            return self._certain, self._alone
        votes, candidates, at = self._certain.copy(), self._alone.copy(), self._ties
        best, worthy, many, clear, mine = self._best[at], self._worthy[at], self._many[at], self._clear[at], before[at]
        among = (mine & best) != 0
        stays = np.where(among & (clear | (many > 2)), mine, _NONE)
        votes[at] = np.where(among, stays, np.where(clear | (many > 2), best, _NONE))
        candidates[at] = np.where(among, worthy & ~mine, _NONE)
        return votes, candidates

    def _targets(self, votes: Array) -> tuple[Array, Array]:
        """The windows' slots, and who has the votes at each step."""
        slots = np.concatenate([np.array(self._slots, dtype=np.int64), votes])
        window, needed, first = self.windows.target, self.windows.target_votes, self._first
        won = _with_votes(slots, len(votes), window, needed)
        decided, _ = self._decided(won, np.full(len(votes), first), slots, window, guessed=False)
        return slots, _filled(decided, first)

    def _decided(self, won: Array, before: Array, slots: Array, window: int, guessed: bool) -> tuple[Array, bool]:
        """One winner of several: who it was before, else who has most votes; and whether there never were several.

        Where the same several win in a row, who is chosen at first stays. Who it was before is guessed, or, as long as
        nothing is, taken to be the last winner.
        """
        several = (won & (won - 1)) != 0
        if not several.any():
            return won, True
        begins = several.copy()
        begins[1:] &= ~(several[:-1] & (won[1:] == won[:-1]))
        places = np.arange(len(won))
        run = np.maximum.accumulate(np.where(begins, places, 0))
        last = _shifted(np.maximum.accumulate(np.where(won != 0, places, -1)), -1)
        chosen = won.copy()
        for at in np.flatnonzero(begins).tolist():
            earlier = int(last[at])
            follows = not guessed and earlier >= 0
            current = chosen[run[earlier] if several[earlier] else earlier] if follows else before[at]
            own = won[at] & current
            chosen[at] = own if own else self._most(slots, at + len(slots) - len(won), window, int(won[at]))
        chosen[several] = chosen[run[several]]
        return chosen, False

    def _most(self, slots: Array, last: int, window: int, won: int) -> Any:
        """Of several winners that with most votes; the first named, if equal."""
        votes: dict[int, int] = {}
        for slot in slots[max(last - window + 1, 0) : last + 1].tolist():
            for place in range(len(self.names)):
                if slot >> place & 1 and won >> place & 1:
                    votes[place] = votes.get(place, 0) + 1
        return np.int64(1 << max(votes, key=votes.__getitem__))

    def _settle_destinations(self, candidates: Array) -> bool:
        """The same for destinations, which are voted for once there is a target."""
        begins = int(np.argmax(self.target != 0)) if (self.target != 0).any() else len(self.target)
        target, window, needed = self.target[begins:], self.windows.destination, self.windows.destination_votes
        slots = np.concatenate([np.array(self._further, dtype=np.int64), candidates[begins:] & ~target])
        self._all_further, guess = slots, np.full(len(target), self._first_further)
        for guesses in range(ROUNDS):
            found, sure = self._destinations(slots, target, window, needed, guess, guesses > 0)
            if sure or (guesses and np.array_equal(found, guess)):
                self.destination = np.concatenate([np.zeros(begins, dtype=np.int64), found])
                self.attended = np.zeros(len(self.target), dtype=np.int64)
                self.attended[begins:] = self._looked_at(slots, target)
                return True
            guess = found
        return False

    def _destinations(
        self, slots: Array, target: Array, window: int, needed: int, guess: Array, guessed: bool
    ) -> tuple[Array, bool]:
        before = _shifted(guess, self._first_further) & ~target
        won = _with_votes(slots, len(target), window, needed) & ~target
        won, sure = self._decided(won, before, slots, window, guessed)
        filled = _filled(won, self._first_further)
        places = np.arange(len(won))
        since = np.maximum.accumulate(np.where(won != 0, places, -1))
        lost = np.maximum.accumulate(np.where(filled == target, places, -1))
        # who became the target in the meantime is no destination any more
        return np.where((lost > since) | ((since < 0) & (lost >= 0)), _NONE, filled), sure

    def _looked_at(self, slots: Array, target: Array) -> Array:
        """The destinations with enough votes, if one of them is voted for in this step; as before where nothing is."""
        elected = _with_votes(slots, len(target), self.windows.destination, self.windows.destination_votes)
        now = slots[len(slots) - len(target) :]
        found = np.where((elected & now) != 0, elected, _NONE)
        stays = _filled(found, self._first_attended)
        self._last_attended = stays[-1] if len(stays) else self._first_attended
        return np.where((found != 0) | (now == 0), stays, _NONE) & ~target

    def state(self) -> State:
        """What `Votes.state` would be after the last step."""
        window, further = self.windows.target, self.windows.destination
        slots = tuple(self._told(slot) for slot in self._all_slots[-window:].tolist())
        rest = tuple(self._told(slot) for slot in self._all_further[-further:].tolist())
        target, destination = (self._told(int(sets[-1])) for sets in (self.target, self.destination))
        last = self._told(int(self._last_attended))
        return slots, rest, next(iter(target), None), next(iter(destination), None), last

    def _told(self, members: int) -> tuple[str, ...]:
        return tuple(name for place, name in enumerate(self.names) if members >> place & 1)


def _shifted(sets: Array, first: Any) -> Array:
    """A step later; ``first`` at the beginning."""
    return np.concatenate([[first], sets[:-1]]).astype(np.int64)


def _filled(won: Array, first: Any) -> Array:
    """The winner stays until another wins."""
    since = np.maximum.accumulate(np.where(won != 0, np.arange(len(won)), -1))
    return np.where(since >= 0, won[since], first)


def _with_votes(slots: Array, length: int, window: int, needed: int) -> Array:
    """Who is in at least ``needed`` of the last ``window`` sets, for the last ``length`` of them; all bits at once.

    Counters are numbers of one bit for each name, one number for each digit.
    """
    padded = np.concatenate([np.zeros(max(window - 1 + length - len(slots), 0), dtype=np.int64), slots])
    digits: list[Array] = [np.zeros(length, dtype=np.int64) for _ in range(window.bit_length())]
    for back in range(window):
        carry = padded[len(padded) - length - back : len(padded) - back]
        for place, digit in enumerate(digits):
            digits[place], carry = digit ^ carry, digit & carry
    more, equal = np.zeros(length, dtype=np.int64), np.full(length, -1, dtype=np.int64)
    for place in reversed(range(len(digits))):
        if needed >> place & 1:
            equal = equal & digits[place]
        else:
            more = more | (equal & digits[place])
            equal = equal & ~digits[place]
    return more | equal
