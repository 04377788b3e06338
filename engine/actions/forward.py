"""One step of the forward algorithm: movements last, or change along the arcs; then what was seen counts.

`step` is the rule, arc by arc. `Forward` works the same out on flat lists: tables for each time between two steps are
kept, and what many states have in common (something new begins) is spread once for all of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import fsum
from operator import mul
from typing import TypeAlias

from casper.engine.actions.durations import Duration
from casper.engine.actions.hmm_model import HmmModel

Belief: TypeAlias = list[float]
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
    phases, after = phases_of(durations), dict[int, float]()
    for key, p in before.items():
        index, phase = divmod(key, phases)
        lasting = durations[model.states[index].movement].passed(dt)
        passed = lasting[: max(len(lasting) - phase, 0)]
        for at, chance in enumerate(passed, key):
            after[at] = after.get(at, 0.0) + p * chance
        moved = p * (1.0 - fsum(passed))
        if moved > NEGLIGIBLE:
            for to, chance in model.arcs[index]:
                after[to * phases] = after.get(to * phases, 0.0) + moved * chance
    weighed = {key: p * likelihood[model.states[key // phases].movement] for key, p in after.items()}
    total = fsum(weighed.values())
    return {key: p / total for key, p in weighed.items() if p > total * NEGLIGIBLE}


def phases_of(durations: Mapping[str, Duration]) -> int:
    """How many phases a state has: as many as the movement of most."""
    return max(each.phases for each in durations.values())


class Forward:
    """The steps of one model, and what a belief says of its actions.

    Args:
        model: its states and arcs.
        durations: of each movement.
    """

    def __init__(self, model: HmmModel, durations: Mapping[str, Duration]) -> None:
        self.phases = phases = phases_of(durations)
        self._durations = durations
        self._movements = [state.movement for state in model.states for _ in range(phases)]
        groups = {afresh: number for number, afresh in enumerate(model.afresh)}
        self._afresh = [[(to * phases, p) for to, p in arcs] for arcs in model.afresh.values()]
        ways = [([(to * phases, p) for to, p in own], new, groups.get(of, 0)) for own, new, of in model.changes]
        self._ways = [way for way in ways for _ in range(phases)]
        complete = _keys(model.complete, phases)
        self._complete = [(action, keys) for action, keys in complete.items() if action is not None]
        self._underway = _keys([s.action if s.progress >= 0 else None for s in model.states], phases)
        self._tables: dict[float, tuple[Belief, list[Belief], Belief]] = {}

    def belief(self, given: Mapping[int, float]) -> Belief:
        """From probabilities by number; what is not there is 0."""
        return [given.get(key, 0.0) for key in range(len(self._movements))]

    def weights(self, likelihood: Mapping[str, float]) -> Belief:
        """By number, how likely what was seen is (for `step` and `seen`); ``likelihood`` is that for each movement."""
        return [likelihood[name] for name in self._movements]

    def step(self, before: Belief, dt: float, weights: Belief) -> Belief:
        """See the function `step`."""
        return self.seen(self.expected(before, dt), weights)

    def expected(self, before: Belief, dt: float) -> Belief:
        """What is expected ``dt`` seconds later, before anything is seen."""
        stays, passed, leaves = self._tables.get(dt) or self._table(dt)
        after, ways, groups = list(map(mul, before, stays)), self._ways, [0.0] * len(self._afresh)
        for phase, chances in enumerate(passed, 1):
            for key, p in enumerate(map(mul, before, chances), phase):
                if p:
                    after[key] += p
        for key, moved in enumerate(map(mul, before, leaves)):
            if moved > NEGLIGIBLE:
                own, new, group = ways[key]
                groups[group] += moved * new
                for to, chance in own:
                    after[to] += moved * chance
        for moved, arcs in zip(groups, self._afresh):
            if moved:
                for to, chance in arcs:
                    after[to] += moved * chance
        return after

    def seen(self, expected: Belief, weights: Belief) -> Belief:
        """What is believed once something was seen that is so likely for each."""
        weighed = list(map(mul, expected, weights))
        total = fsum(weighed)
        least = total * NEGLIGIBLE
        return [p / total if p > least else 0.0 for p in weighed]

    def happened(self, belief: Belief) -> dict[str, float]:
        """By action, how likely it is to have happened."""
        return {action: fsum([belief[key] for key in keys]) for action, keys in self._complete}

    def underway(self, belief: Belief) -> dict[str | None, float]:
        """By action, how likely it is to be going on or to have happened; None stands for no action."""
        return {action: fsum([belief[key] for key in keys]) for action, keys in self._underway.items()}

    def _table(self, dt: float) -> tuple[Belief, list[Belief], Belief]:
        """How likely it is to stay in the same phase, to be 1, 2, … on in the same movement, and to leave it."""
        chances = {name: each.passed(dt) for name, each in self._durations.items()}
        rows = [self._passed(chances[name], key % self.phases) for key, name in enumerate(self._movements)]
        stays, *passed = map(list, zip(*rows))
        if len(self._tables) == KEPT:
            self._tables.clear()
        self._tables[dt] = stays, passed, [1.0 - fsum(row) for row in rows]
        return self._tables[dt]

    def _passed(self, chances: Sequence[float], phase: int) -> list[float]:
        """The chances from a phase on, as many as there are phases; there is none beyond the last."""
        left = chances[: max(len(chances) - phase, 0)]
        return [*left, *[0.0] * (self.phases - len(left))]


def _keys(actions: Iterable[str | None], phases: int) -> dict[str | None, list[int]]:
    """By action, the numbers of its states and phases."""
    found: dict[str | None, list[int]] = {}
    for index, action in enumerate(actions):
        found.setdefault(action, []).extend(range(index * phases, (index + 1) * phases))
    return found
