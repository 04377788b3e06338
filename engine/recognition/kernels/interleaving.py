"""Several goals at once: every observation is a step of one of the goals pursued, or needless where noise is allowed.

For two goals all nodes are kept, and everything is exact; for more, and where even those of two are too many, it is a
best-first search that says so.
"""

from __future__ import annotations

from collections.abc import Sequence

from casper.engine.recognition.kernels.counting import Counting
from casper.engine.recognition.scoring import Score, paper
from casper.engine.verification.matching import Matcher
from casper.plans.trees.plan import Plan


class Interleaving(Counting):
    """Counts explanations of up to so many goals at once (other arguments: `levels.Levels`)."""

    several = True

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        goals: int = 2,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int | None = None,
    ) -> None:
        super().__init__(plans, matcher, noise, priors, measure, budget, goals)
