"""The ballots of many steps at once, and their elections: the same winners as `engine.perception.votes`.

Many steps are counted by `engine.perception.counting`, few, or those it cannot count, one by one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from casper.engine.perception.counting import Count
from casper.engine.perception.votes import NOBODY, Ballot, Votes, Windows

Array = NDArray[Any]
BITS = 62
"""Names of which a set is a number."""
FEW = 48
"""Steps up to which counting one by one is faster."""


@dataclass(frozen=True, eq=False)
class Counted:
    """The ballots of some steps: sets of objects (objects by steps), and one truth value a step.

    clear: the best are above the threshold. worthy: they may be a destination. alive: anything scores.
    """

    best: Array
    second: Array
    clear: Array
    worthy: Array
    alive: Array

    @staticmethod
    def of(scores: Array, threshold: float, minimum: float, tolerance: float) -> Counted:
        """From scores; -inf for what is not there."""
        top = np.maximum.reduce(scores, axis=0)
        best = scores >= (top * (1.0 - tolerance) if tolerance else top)
        alive = top > 0.0
        rest = np.where(best, -np.inf, scores)
        next_ = np.maximum.reduce(rest, axis=0)
        least = np.where(next_ > minimum, next_ * (1.0 - tolerance) if tolerance else next_, np.inf)
        second = rest >= least
        if tolerance:
            second &= rest > minimum
        return Counted(best, second, top > threshold, top > minimum, alive)


class Elections:
    """Holds one after the other; the windows go on from chunk to chunk."""

    def __init__(self, objects: Sequence[str], windows: Windows, minimum: float, tolerance: float) -> None:
        self._objects, self._minimum, self._tolerance = objects, minimum, tolerance
        self._row = {name: i for i, name in enumerate(objects)}
        self._by_name = np.array(sorted(range(len(objects)), key=objects.__getitem__), dtype=np.intp)
        self._votes = Votes(windows)

    def hold(self, counted: Counted, scores: Array, seen: Array) -> tuple[Array, Array, Array]:
        """The rows of target and destination after each step, -1 for nobody, and whether each object is attended to.

        Steps not seen do not count.
        """
        steps = np.flatnonzero(seen)
        target, destination = np.full(len(seen), -1, dtype=np.int32), np.full(len(seen), -1, dtype=np.int32)
        attended = np.zeros((len(self._objects), len(seen)), dtype=bool)
        found: tuple[ArrayLike, ArrayLike, Array] | None = None
        if len(steps) > FEW and not self._tolerance:
            found = self._at_once(counted, steps)
        if found is None:
            found = self._one_by_one(counted, scores, steps)
        target[steps], destination[steps], attended[:, steps] = found
        return target, destination, attended

    def _one_by_one(self, counted: Counted, scores: Array, steps: Array) -> tuple[list[int], list[int], Array]:
        votes, row, targets, destinations = self._votes, self._row, [], []
        attended = np.zeros((len(self._objects), len(steps)), dtype=bool)
        for at, step in enumerate(steps.tolist()):
            votes.cast(self._ballot(counted, scores, step))
            targets.append(-1 if votes.target is None else row[votes.target])
            destinations.append(-1 if votes.destination is None else row[votes.destination])
            attended[[row[name] for name in votes.attended], at] = True
        return targets, destinations, attended

    def _ballot(self, counted: Counted, scores: Array, step: int) -> Ballot:
        if not counted.alive[step]:
            return NOBODY
        best = self._named(counted.best, scores, step)
        second = self._named(counted.second, scores, step) if len(best) == 1 else ()
        worthy = best if counted.worthy[step] else ()
        if self._tolerance:
            worthy = tuple([name for name in best if scores[self._row[name], step] > self._minimum])
        return Ballot(best, worthy, second, bool(counted.clear[step]))

    def _named(self, chosen: Array, scores: Array, step: int) -> tuple[str, ...]:
        """By score, then by name."""
        rows = self._by_name[chosen[self._by_name, step]]
        if self._tolerance:
            rows = rows[np.argsort(-scores[rows, step], kind="stable")]
        return tuple([self._objects[row] for row in rows])

    def _at_once(self, counted: Counted, steps: Array) -> tuple[Array, Array, Array] | None:
        """None where there are too many names, or guesses lead nowhere."""
        used = self._used(counted)
        if len(used) > BITS:
            return None
        names = [self._objects[row] for row in used]
        count = Count(names, self._votes, *_sets(counted, used, steps))
        if not count.settle():
            return None
        self._votes.state = count.state()
        rows = np.append(used, -1)
        attended = np.zeros((len(self._objects), len(steps)), dtype=bool)
        for bit, row in enumerate(used.tolist()):
            attended[row] = count.attended >> bit & 1
        return rows[_places(count.target, len(names))], rows[_places(count.destination, len(names))], attended

    def _used(self, counted: Counted) -> Array:
        """The rows of whoever is on a ballot or in a window, in the order of their names."""
        on: Array = np.logical_or(counted.best.any(axis=1), counted.second.any(axis=1))
        slots = self._votes.state
        for name in {name for window in slots[:2] for slot in window for name in slot} | {*slots[2:4], *slots[4]}:
            if name is not None:
                on[self._row[name]] = True
        return np.asarray(self._by_name[on[self._by_name]])


def _sets(counted: Counted, used: Array, steps: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Sets as numbers: best, second; how many are best; which are clear and worthy."""
    best = counted.best[used] & counted.alive
    masks = []
    for chosen in (best, counted.second[used] & counted.alive):
        total = np.zeros(chosen.shape[1], dtype=np.int64)
        for bit, row in enumerate(chosen):
            total |= row.astype(np.int64) << bit
        masks.append(total[steps])
    many = np.add.reduce(best, axis=0, dtype=np.int16)[steps]
    return masks[0], masks[1], many, counted.clear[steps], counted.worthy[steps]


def _places(sets: Array, nobody: int) -> Array:
    """The only member of each set as its bit's number."""
    return np.where(sets == 0, nobody, np.frexp(sets.astype(np.float64))[1] - 1)
