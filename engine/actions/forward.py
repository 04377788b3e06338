"""One step of the forward algorithm: movements last, or change along the arcs; then what was seen counts.

`step` is the rule, arc by arc. `Forward` works the same out on arrays, by tables of each time between two steps. It
takes products and sums one after the other and never a matrix product, whose rounding differs between processors: a
recording that is replayed elsewhere gives the same events.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from casper.engine.actions.durations import Duration
from casper.engine.actions.hmm_model import HmmModel

Belief: TypeAlias = NDArray[np.float64]
"""Probabilities by state and phase: number of the state times the phases there are, and the phase."""

NEGLIGIBLE = 1e-7  # share that is not followed up
KEPT = 64  # times between two steps whose tables are kept: a sensor has few


def step(
    model: HmmModel,
    durations: Mapping[str, Duration],
    before: Mapping[int, float],
    dt: float,
    likelihood: Mapping[str, float],
) -> dict[int, float]:
    """The belief ``dt`` seconds later, in the light of what was seen then (`Forward.step` says the same, faster).

    Args:
        model: its states and arcs.
        durations: of each movement.
        before: probabilities, numbered as those of a `Belief`; they add up to 1.
        dt: seconds.
        likelihood: of what was seen, for each movement; above 0.
    """
    phases, after = max(each.phases for each in durations.values()), dict[int, float]()
    for key, p in before.items():
        index, phase = divmod(key, phases)
        lasting = durations[model.states[index].movement].passed(dt)
        passed = lasting[: max(len(lasting) - phase, 0)]
        for at, chance in enumerate(passed, key):
            after[at] = after.get(at, 0.0) + p * chance
        moved = p * (1.0 - sum(passed))
        if moved > NEGLIGIBLE:
            for to, chance in model.arcs[index]:
                after[to * phases] = after.get(to * phases, 0.0) + moved * chance
    weighed = {key: p * likelihood[model.states[key // phases].movement] for key, p in after.items()}
    total = sum(weighed.values())
    return {key: p / total for key, p in weighed.items() if p > total * NEGLIGIBLE}


class Forward:
    """The steps of one model, and what a belief says of its actions.

    Args:
        model: its states and arcs.
        durations: of each movement.
    """

    def __init__(self, model: HmmModel, durations: Mapping[str, Duration]) -> None:
        self.phases = max(each.phases for each in durations.values())
        count, states = len(model.states), model.states
        self._movements = {name: number for number, name in enumerate(durations)}
        self._durations = list(durations.values())
        self._movement: NDArray[np.intp] = np.repeat([self._movements[s.movement] for s in states], self.phases)
        self._phase = np.tile(np.arange(self.phases), count)
        self._arcs = np.zeros((count, count))
        for index, arcs in enumerate(model.arcs):
            for to, chance in arcs:
                self._arcs[index, to] = chance
        self._actions = list(dict.fromkeys(s.action for s in states if s.action is not None))
        self._complete = self._by_action(model.complete)
        self._underway = self._by_action([s.action if s.progress >= 0 else None for s in states])
        self._tables: dict[float, tuple[list[Belief], Belief]] = {}

    def belief(self, given: Mapping[int, float]) -> Belief:
        """From probabilities by number; what is not there is 0."""
        made = np.zeros(len(self._movement))
        for key, p in given.items():
            made[key] = p
        return made

    def step(self, before: Belief, dt: float, likelihood: Mapping[str, float]) -> Belief:
        """See the function `step`."""
        return self.seen(self.expected(before, dt), likelihood)

    def expected(self, before: Belief, dt: float) -> Belief:
        """What is expected ``dt`` seconds later, before anything is seen."""
        passed, leaves = self._tables.get(dt) or self._table(dt)
        after: Belief = before * passed[0]
        for phase in range(1, self.phases):
            after[phase:] += (before * passed[phase])[:-phase]
        moved = before * leaves
        moved *= moved > NEGLIGIBLE
        by_state = moved if self.phases == 1 else np.add.reduce(moved.reshape(-1, self.phases), axis=1)
        after[:: self.phases] += np.add.reduce(self._arcs * by_state[:, None], axis=0)
        return after

    def seen(self, expected: Belief, likelihood: Mapping[str, float]) -> Belief:
        """What is believed once something was seen that is so likely for each movement."""
        weighed: Belief = expected * np.array([likelihood[name] for name in self._movements])[self._movement]
        weighed /= np.add.reduce(weighed)
        weighed *= weighed > NEGLIGIBLE
        return weighed

    def happened(self, belief: Belief) -> dict[str, float]:
        """By action, how likely it is to have happened."""
        return dict(zip(self._actions, self._shares(self._complete, belief)))

    def underway(self, belief: Belief) -> dict[str | None, float]:
        """By action, how likely it is to be going on or to have happened; None stands for no action."""
        *shares, nothing = self._shares(self._underway, belief)
        return {None: nothing, **dict(zip(self._actions, shares))}

    def _by_action(self, actions: Sequence[str | None]) -> NDArray[np.intp]:
        """The number of each state's action; behind the last one, none."""
        numbers: dict[str | None, int] = {action: number for number, action in enumerate(self._actions)}
        return np.repeat([numbers.get(action, len(numbers)) for action in actions], self.phases)

    def _shares(self, groups: NDArray[Any], belief: Belief) -> list[float]:
        shares: list[float] = np.bincount(groups, belief, len(self._actions) + 1).tolist()
        return shares

    def _table(self, dt: float) -> tuple[list[Belief], Belief]:
        """How likely it is to be 0, 1, … phases on in the same movement, and to leave it."""
        chances = np.zeros((self.phases, len(self._durations)))
        for number, each in enumerate(self._durations):
            chances[: each.phases, number] = each.passed(dt)
        left = np.array([each.phases for each in self._durations])[self._movement] - self._phase
        passed: list[Belief] = [(row[self._movement] * (left > phase)) for phase, row in enumerate(chances)]
        if len(self._tables) == KEPT:
            self._tables.clear()
        self._tables[dt] = passed, 1.0 - sum(passed[1:], start=passed[0])
        return self._tables[dt]
