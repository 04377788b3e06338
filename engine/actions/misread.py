"""Which movements were probably misread: the likeliest path through the hidden states (Viterbi) behind an action."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

from casper.engine.actions.durations import Duration
from casper.engine.actions.hmm_model import HmmModel
from casper.engine.actions.prediction import Misread

MOST_RUNS = 60  # of equal movements that are looked back on
LEAST = 1e-12
NEVER = -math.inf
KEPT = 16  # times between two runs whose ways are kept


@dataclass(slots=True)
class _Run:
    """Equal movements one after the other: from when to when, and how likely they are by what was really done."""

    seen: str
    begins: float
    ends: float
    weights: dict[str, float]  # logarithms


def logarithms(likelihood: Mapping[str, float]) -> dict[str, float]:
    """How likely what was seen is for each movement, as weights that add up over steps."""
    return {name: math.log(max(p, LEAST)) for name, p in likelihood.items()}


class Trail:
    """What was seen since the last action, as runs of equal movements."""

    def __init__(self, model: HmmModel, durations: Mapping[str, Duration]) -> None:
        self._model, self._durations = model, durations
        self._runs: deque[_Run] = deque(maxlen=MOST_RUNS)
        self._start: Mapping[int, float] = model.initial
        self._kept: dict[float, list[list[tuple[int, float]]]] = {}

    def begin(self, start: Mapping[int, float]) -> None:
        """Behind an action, from what is believed there (probabilities by state)."""
        self._runs.clear()
        self._start = start

    def add(self, t: float, seen: str, weights: Mapping[str, float]) -> None:
        """One step: what was seen, and how likely that is for each movement (`logarithms`)."""
        if not self._runs or self._runs[-1].seen != seen:
            self._runs.append(_Run(seen, t, t, dict.fromkeys(weights, 0.0)))
        run = self._runs[-1]
        run.ends, so_far = t, run.weights
        for name, weight in weights.items():
            so_far[name] += weight

    def misread(self, action: str) -> tuple[Misread, ...]:
        """Of the likeliest way to this action, those runs that were something else than was seen, in order of time."""
        path = self._path(action)
        named = (self._model.states[index].movement for index in path)
        return tuple(Misread(run.begins, run.seen, name) for run, name in zip(self._runs, named) if run.seen != name)

    def _path(self, action: str) -> list[int]:
        """The likeliest state of each run, if in the end the action has happened."""
        named = [state.movement for state in self._model.states]
        back = list[list[int]]()
        best: list[float] = []  # of each state, the logarithm of the likeliest way there
        before: _Run | None = None
        for run in self._runs:
            if before is None:
                reached, came = self._begun(), list[int]()
            else:
                reached, came = self._onward(best, run.begins - before.ends)
            weights, stays = run.weights, self._stay(run.ends - run.begins)
            best = [p + weights.get(name, NEVER) + stays[name] for p, name in zip(reached, named)]
            back.append(came)
            before = run
        ends = [i for i, p in enumerate(best) if p > NEVER and self._model.complete[i] == action]
        if not ends:
            return []
        path = [max(ends, key=best.__getitem__)]
        for came in reversed(back[1:]):
            path.append(came[path[-1]])
        return path[::-1]

    def _begun(self) -> list[float]:
        """Where it began; of a long time without an action the beginning is forgotten."""
        if len(self._runs) == MOST_RUNS:
            return [0.0] * len(self._model.states)
        reached = [NEVER] * len(self._model.states)
        for index, p in self._start.items():
            for to, chance in ((index, 1.0), *self._model.arcs[index]):
                reached[to] = max(reached[to], math.log(max(p * chance, LEAST)))
        return reached

    def _onward(self, best: list[float], dt: float) -> tuple[list[float], list[int]]:
        """How well each state is reached so much later, and from which."""
        reached, came = [NEVER] * len(best), [-1] * len(best)
        for index, (p, ways) in enumerate(zip(best, self._ways(dt))):
            if p > NEVER:
                for to, weight in ways:
                    total = p + weight
                    if total > reached[to]:
                        reached[to] = total
                        came[to] = index
        return reached, came

    def _ways(self, dt: float) -> list[list[tuple[int, float]]]:
        """By state, where one is so much later, and the logarithm of the chance; kept, as most steps are equal."""
        if dt not in self._kept:
            if len(self._kept) == KEPT:
                self._kept.clear()
            stays = self._stay(dt)
            self._kept[dt] = [self._ways_from(index, stays) for index in range(len(self._model.states))]
        return self._kept[dt]

    def _ways_from(self, index: int, stay: Mapping[str, float]) -> list[tuple[int, float]]:
        stays = math.exp(stay[self._model.states[index].movement])
        change = max(1.0 - stays, LEAST)
        ways = ((index, stays), *((to, change * chance) for to, chance in self._model.arcs[index]))
        return [(to, math.log(max(chance, LEAST))) for to, chance in ways]

    def _stay(self, dt: float) -> dict[str, float]:
        """By movement, the logarithm of the chance that it goes on for so long."""
        return {name: -max(dt, 0.0) / each.mean for name, each in self._durations.items()}
