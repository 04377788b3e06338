"""A plain recogniser in the manner of PHATT (Geib and Goldman): a list of explanations, each extended by every way to
attach the next observation to a plan under way or to a new one. Nothing is merged, nothing is counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from casper.engine.observation import Observation
from casper.plans.plan import Plan


@dataclass(frozen=True)
class Attached:
    """One explanation: for every plan under way, which of its leaves were observed."""

    plans: tuple[tuple[int, tuple[int, ...]], ...]


class Baseline:
    """Explanations of chains by names, for up to so many goals at once."""

    def __init__(self, plans: Sequence[Plan], goals: int = 1) -> None:
        self.plans, self.goals = plans, goals
        self.explanations = [Attached(())]
        self.observed = 0

    def observe(self, seen: Observation) -> None:
        """Extend every explanation in every way."""
        extended = []
        for explanation in self.explanations:
            for at, (plan, marks) in enumerate(explanation.plans):
                for leaf in range(marks[-1] + 1, len(self.plans[plan].leaves)):
                    if self.plans[plan].leaves[leaf].functor == seen.action:
                        grown = (plan, (*marks, leaf))
                        extended.append(Attached((*explanation.plans[:at], grown, *explanation.plans[at + 1 :])))
            if len(explanation.plans) < self.goals:
                begun = {plan for plan, _ in explanation.plans}
                for plan, candidate in enumerate(self.plans):
                    if plan not in begun:
                        for leaf, action in enumerate(candidate.leaves):
                            if action.functor == seen.action:
                                extended.append(Attached((*explanation.plans, (plan, (leaf,)))))
        self.explanations = extended
        self.observed += 1

    def posterior(self) -> dict[str, float]:
        """Each goal's probability of being among those pursued, by the paper's score."""
        totals, whole = {plan.label: 0.0 for plan in self.plans}, 0.0
        for explanation in self.explanations:
            leaves = sum(len(self.plans[plan].leaves) for plan, _ in explanation.plans)
            missed = sum(marks[-1] + 1 - len(marks) for _, marks in explanation.plans)
            score = self.observed * (leaves - missed) / leaves**2
            whole += score
            for plan, _ in explanation.plans:
                totals[self.plans[plan].label] += score
        return {label: total / whole if whole else 0.0 for label, total in totals.items()}
