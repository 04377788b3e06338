"""What a day is measured against: a recursive Bayesian filter, and the PHATT-style recogniser that is there already."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

RECOGNITION = str(Path(__file__).resolve().parent.parent / "recognition")
if RECOGNITION not in sys.path:
    sys.path.append(RECOGNITION)

from baseline import Baseline, TooMany  # noqa: E402

BUDGET = 20_000  # explanations that the plain recogniser may list


class BayesianFilter:
    """A belief over single goals, updated by each action: P(goal | actions) ~ P(goal) * product of P(action | goal).

    An action of the goal that was not done yet, with arguments that fit, has an even share of ``right``; any other one
    has ``1 - right``. Order counts for nothing, and a goal once pursued is pursued for good.
    """

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, right: float = 0.9) -> None:
        self.plans, self.matcher, self.right = plans, matcher, right
        self.weights = [1 / len(plans)] * len(plans)
        self._done = [0] * len(plans)
        self._bound = [matcher.initial(number) for number in range(len(plans))]

    def observe(self, seen: Observation) -> None:
        """Update the belief."""
        for number, plan in enumerate(self.plans):
            self.weights[number] *= self._likelihood(number, plan, seen)
        whole = sum(self.weights)
        self.weights = [max(weight / whole, 1e-300) for weight in self.weights]

    def _likelihood(self, number: int, plan: Plan, seen: Observation) -> float:
        binding, done = self._bound[number], self._done[number]
        left = len(plan.leaves) - done.bit_count()
        for leaf, action in enumerate(plan.leaves):
            if action.functor == seen.action and not done >> leaf & 1 and not isinstance(binding, Mismatch):
                bound = self.matcher.match(number, leaf, seen, binding)
                if not isinstance(bound, Mismatch):
                    self._bound[number] = bound
                    self._done[number] |= 1 << leaf
                    return self.right / left
        return (1 - self.right) / len(self.plans)

    def likeliest(self, count: int) -> tuple[str, ...]:
        """The labels of the likeliest goals, sorted."""
        first = sorted(range(len(self.plans)), key=lambda number: -self.weights[number])[:count]
        return tuple(sorted(self.plans[number].label for number in first))

    @property
    def leading(self) -> str | None:
        """The likeliest goal; None where several are."""
        best = max(self.weights)
        first = [number for number, weight in enumerate(self.weights) if weight >= best * (1 - 1e-9)]
        return self.plans[first[0]].label if len(first) == 1 else None


class Listed:
    """The plain recogniser as one that says what leads: the goal that was begun last, by the explanations' scores.

    ``gave_up`` is the number of the observation, from 1, that led to too many explanations; from then on nothing leads.
    """

    def __init__(self, plans: Sequence[Plan], matcher: Matcher, together: int = 2, noise: float = 0.1) -> None:
        self._recogniser = Baseline(plans, matcher, together, noise, budget=BUDGET)
        self._plans, self.gave_up, self._count = plans, 0, 0

    def observe(self, seen: Observation) -> None:
        """List every explanation."""
        self._count += 1
        if not self.gave_up:
            try:
                self._recogniser.observe(seen)
            except TooMany:
                self.gave_up = self._count

    @property
    def leading(self) -> str | None:
        """The likeliest goal; None where several are, or it gave up."""
        shares: dict[str, float] = {}
        for explained in () if self.gave_up else self._recogniser.explanations:
            if explained.parts:
                label = self._plans[explained.parts[-1].plan].label
                shares[label] = shares.get(label, 0.0) + self._recogniser.score(explained)
        best = max(shares.values(), default=0.0)
        first = [label for label, share in shares.items() if share >= best * (1 - 1e-9)]
        return first[0] if len(first) == 1 else None


def phatt_goals(
    plans: Sequence[Plan], matcher: Matcher, seen: Sequence[Observation], together: int, noise: float | None
) -> tuple[str, ...] | None:
    """The goals of the best explanation of the plain recogniser, sorted; None where it has none, or too many."""
    recogniser = Baseline(plans, matcher, together, noise, budget=BUDGET)
    try:
        for observation in seen:
            recogniser.observe(observation)
    except TooMany:
        return None
    explained = [explanation for explanation in recogniser.explanations if explanation.parts]
    if not explained:
        return None
    best = max(explained, key=recogniser.score)
    return tuple(sorted({plans[part.plan].label for part in best.parts}))
