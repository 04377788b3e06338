"""Levels of states, observation after observation: the lower half of `counting`.

What a level counts is exact until there are more than ``budget`` states. Then the most promising go on, counts and
sums are lower bounds, and the level says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from heapq import nlargest

from casper.engine.recognition.kernels.kernel import Listing
from casper.engine.recognition.kernels.states import (
    Counts,
    Edges,
    State,
    Weight,
    advance,
    is_certain,
    positions_of,
    start,
    weigh,
)
from casper.engine.recognition.scoring import Score, paper
from casper.engine.verification.matching import Binding, Matcher, Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.plans.trees.plan import Plan

MOST_STATES = 20_000  # kept of all plans, unless a reading is told another budget


@dataclass(slots=True)
class Level:
    """Per plan: counts, what was matched, weights (None: all certain), and why it was cut. ``before``: the last one."""

    k: int
    counts: dict[int, Counts]
    edges: dict[int, Edges]
    weights: dict[int, dict[State, Weight]] | None
    noted: dict[int, list[Mismatch]]
    exact: bool = True
    before: Level | None = None
    groups: list[tuple[float, int, State]] | None = None  # weight, plan and state, best first; made when asked for


class Levels(Listing[Level]):
    """Counts for some plans, whose shapes may be anything. ``budget`` is how many states are kept."""

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int = MOST_STATES,
    ) -> None:
        super().__init__(plans, matcher, noise, priors, measure)
        self.budget = budget
        self.charts = [plan.chart for plan in plans]
        self._positions = [positions_of(plan) for plan in plans]

    def begin(self) -> Level:
        """Every plan that may be pursued at all counts once."""
        level = Level(0, {}, {}, None, {})
        for plan, chart in enumerate(self.charts):
            binding = self.matcher.initial(plan)
            if isinstance(binding, Mismatch):
                level.noted[plan] = [binding]
            else:
                level.counts[plan] = {start(chart, binding): 1}
        return level

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """Every plan goes on by one observation."""
        options, noisy = options_of(seen), self.noise is not None
        after = Level(level.k + 1, {}, {}, None, {}, level.exact, level)
        for plan, before in level.counts.items():
            matched = self._matched(plan, before, options, matcher, after.noted)
            advanced = advance(self.charts[plan], before, matched, noisy) if matched or noisy else None
            if advanced:
                after.edges[plan], after.counts[plan] = matched, advanced
        if level.weights is not None or not is_certain(seen):
            after.weights = {
                plan: weigh(self.charts[plan], level.counts[plan], _of(level, plan), edges, noisy)
                for plan, edges in after.edges.items()
            }
        if sum(map(len, after.counts.values())) > self.budget:
            after.counts, after.exact = self._pruned(after), False
        return after

    def _matched(
        self,
        plan: int,
        counts: Counts,
        options: Iterable[tuple[Observation, float]],
        matcher: Matcher,
        noted: dict[int, list[Mismatch]],
    ) -> Edges:
        """What the observation can be, by what was known before."""
        positions, edges, opened = self._positions[plan], Edges(), dict[Binding, int]()
        for state in sorted(counts, key=lambda state: state[0]):
            opened[state[5]] = opened.get(state[5], 0) | ~state[0]
        for observation, likelihood in options:
            for leaf in positions.get(observation.action, ()):
                for binding, mask in opened.items():
                    if mask >> leaf & 1:
                        after = matcher.match(plan, leaf, observation, binding)
                        if isinstance(after, Mismatch):
                            noted.setdefault(plan, []).append(after)
                        else:
                            edges.setdefault(binding, []).append((leaf, after, likelihood))
        return edges

    def _pruned(self, level: Level) -> dict[int, Counts]:
        """As many states as the budget allows: those that miss least and have fewest needless, then score best."""

        def promise(plan: int, state: State) -> tuple[int, float]:
            score = self.score(state, level.k) if level.k > state[4] else 0.0
            return -state[3] - state[4], self.priors[plan] * score

        states = ((plan, state) for plan, counts in level.counts.items() for state in counts)
        kept: dict[int, Counts] = {}
        for plan, state in nlargest(self.budget, states, key=lambda pair: promise(*pair)):
            kept.setdefault(plan, {})[state] = level.counts[plan][state]
        return kept

    def score(self, state: State, k: int, priced: int = 0) -> float:
        """Of an explanation that ends here, when so many needless observations cost their price."""
        above, below = self.measure(state[2], k - state[4], state[3])
        return above / below if not priced else (self.noise or 1.0) ** priced * (above / below)

    def mismatches(self, level: Level) -> Mapping[int, Sequence[Mismatch]]:
        """By plan, why it could not go on."""
        return level.noted

    def is_exact(self, level: Level) -> bool:
        """Whether no state was dropped."""
        return level.exact


def _of(level: Level, plan: int) -> Mapping[State, Weight] | None:
    return None if level.weights is None else level.weights[plan]
