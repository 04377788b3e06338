"""Counts by state, observation after observation: the counting engine's lower half (`counting`).

What a level counts is exact until there are more than ``budget`` states. Then the most promising go on, counts and
sums are lower bounds, and `Stacks.is_exact` says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from heapq import nlargest

from casper.engine.recognition.scoring import Score, paper
from casper.engine.recognition.stacks import Stacks
from casper.engine.recognition.states import MOST_STATES, Edges, Level, State, Weight, advance, start, weigh
from casper.engine.verification.matching import Binding, Matcher, Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.plans.trees.plan import Plan


class Levels(Stacks):
    """Counts for some plans, observation by observation; ``undo`` takes the last one back.

    Args:
        plans: the plans; their shapes may be anything.
        matcher: what can be taken for what.
        noise: the factor on a score for each observation that is needless or misread; None allows none.
        priors: per plan the prior of its goal.
        measure: the score.
        budget: how many states are kept.
    """

    STACKS = (*Stacks.STACKS, "levels", "_edges", "_weights")

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int = MOST_STATES,
    ) -> None:
        super().__init__(matcher)
        self.plans, self.noise, self.measure = plans, noise, measure
        self.budget = budget
        self.priors = priors or (1.0,) * len(plans)
        self.charts = [plan.chart for plan in plans]
        self._positions = [positions_of(plan) for plan in plans]
        self.levels: list[dict[int, Level]] = [{}]
        self._edges: list[dict[int, Edges]] = []
        self._weights: list[dict[int, dict[State, Weight]] | None] = [None]
        self.labels = [plan.label for plan in plans]
        for plan, chart in enumerate(self.charts):
            binding = matcher.initial(plan)
            if isinstance(binding, Mismatch):
                self._note(plan, binding)
            else:
                self.levels[0][plan] = {start(chart, binding): 1}

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every plan by one observation."""
        options, noisy = options_of(seen), self.noise is not None
        level: dict[int, Level] = {}
        edges: dict[int, Edges] = {}
        self._noted = {}
        for plan, before in self.levels[-1].items():
            matched = self._matched(plan, before, options)
            advanced = advance(self.charts[plan], before, matched, noisy) if matched or noisy else None
            if advanced:
                edges[plan], level[plan] = matched, advanced
        exact = sum(map(len, level.values())) <= self.budget
        weighed, level = self._weighed(edges, is_certain(seen)), level if exact else self._pruned(level)
        self.mismatches.append(self._noted)  # from here on nothing can go wrong: an observation is taken in or not
        self.exact.append(exact and self.is_exact)
        self._weights.append(weighed)
        self.levels.append(level)
        self._edges.append(edges)
        self.observations.append(seen)
        self.matcher.observed(options[0][0] if is_certain(seen) else Observation(seen.action))

    def _pruned(self, level: dict[int, Level]) -> dict[int, Level]:
        """As many states as the budget allows: those that miss least and have fewest needless, then score best."""
        k = len(self.observations) + 1

        def promise(plan: int, state: State) -> tuple[int, float]:
            _, _, size, missed, needless, _ = state
            above, below = self.measure(size, k - needless, missed)
            return -missed - needless, self.priors[plan] * (above / below if k > needless else 0.0)

        states = ((plan, state) for plan, counts in level.items() for state in counts)
        kept: dict[int, Level] = {}
        for plan, state in nlargest(self.budget, states, key=lambda pair: promise(*pair)):
            kept.setdefault(plan, {})[state] = level[plan][state]
        return kept

    def _matched(self, plan: int, level: Level, options: Iterable[tuple[Observation, float]]) -> Edges:
        """What the observation can be, by what was known before."""
        positions, edges, opened = self._positions[plan], Edges(), dict[Binding, int]()
        for state in sorted(level, key=lambda state: state[0]):
            opened[state[5]] = opened.get(state[5], 0) | ~state[0]
        for observation, likelihood in options:
            for leaf in positions.get(observation.action, ()):
                for binding, mask in opened.items():
                    if mask >> leaf & 1:
                        after = self.matcher.match(plan, leaf, observation, binding)
                        if isinstance(after, Mismatch):
                            self._note(plan, after)
                        else:
                            edges.setdefault(binding, []).append((leaf, after, likelihood))
        return edges

    def _weighed(self, edges: dict[int, Edges], certain: bool) -> dict[int, dict[State, Weight]] | None:
        before, noisy = self._weights[-1], self.noise is not None
        if before is None and certain:
            return None
        weighed = {}
        for plan, found in edges.items():
            weights = before[plan] if before is not None else None
            weighed[plan] = weigh(self.charts[plan], self.levels[-1][plan], weights, found, noisy)
        return weighed



def is_certain(seen: Seen) -> bool:
    """Whether it was made out what was done."""
    options = options_of(seen)
    return len(options) == 1 and options[0][1] == 1.0


def positions_of(plan: Plan) -> dict[str, list[int]]:
    """The leaves of each action name, from left to right."""
    positions: dict[str, list[int]] = {}
    for at, leaf in enumerate(plan.leaves):
        positions.setdefault(leaf.functor, []).append(at)
    return positions
