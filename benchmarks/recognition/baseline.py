"""A plain recogniser in the manner of PHATT (Geib and Goldman): a list of explanations, each extended by every way to
attach the next observation to a plan under way, to a new plan, or (at a price) to none. Nothing is merged or counted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from typing import NamedTuple

from meaning import Leaves, Meaning

from casper.engine.verification.binding import Binding
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

BUDGET = 300_000  # explanations


class TooMany(Exception):
    """There are more explanations than the budget allows."""


class Pursued(NamedTuple):
    """A plan under way: the leaves that were observed, in order and as a set, and those that still can be.

    ``size`` and ``missed`` count the leaves that belong to the plan, and those of them that were passed over.
    """

    plan: int
    marks: tuple[int, ...]
    marked: Leaves
    open: Leaves
    binding: Binding
    size: int
    missed: int


class Explained(NamedTuple):
    """One explanation: the plans under way, in the order in which they began; how many observations are needless."""

    parts: tuple[Pursued, ...]
    needless: int


class Baseline:
    """Explanations of any plans, for up to so many goals at once; ``noise`` is the price of a needless observation.

    Raises:
        TooMany: when an observation leads to more explanations than the budget.
    """

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        goals: int = 1,
        noise: float | None = None,
        budget: int = BUDGET,
    ) -> None:
        self.plans, self.matcher, self.goals, self.noise, self.budget = plans, matcher, goals, noise, budget
        self.meanings = [Meaning(plan) for plan in plans]
        self.explanations = [Explained((), 0)]
        self.observed = 0
        self._matched: dict[tuple[int, int, Binding], Binding | Mismatch] = {}  # of one observation
        self._new: dict[str, list[Pursued]] = {}  # by action: plans that have it, nothing of them observed
        for number, meaning in enumerate(self.meanings):
            binding = matcher.initial(number)
            if not isinstance(binding, Mismatch):
                new = Pursued(number, (), 0, meaning.everything, binding, meaning.root.default.bit_count(), 0)
                for action in meaning.named:
                    self._new.setdefault(action, []).append(new)

    def fork(self) -> Baseline:
        """A copy that goes its own way: lists are never changed."""
        other = copy(self)
        other.matcher, other._matched = self.matcher.fork(), {}
        return other

    def observe(self, seen: Observation) -> None:
        """Extend every explanation in every way."""
        extended: list[Explained] = []
        self._matched.clear()
        for explanation in self.explanations:
            extended.extend(self._extended(explanation, seen))
            if len(extended) > self.budget:
                raise TooMany(f"more than {self.budget:,} explanations")
        self.explanations = extended
        self.observed += 1
        self.matcher.observed(seen)

    def _extended(self, explanation: Explained, seen: Observation) -> Iterator[Explained]:
        parts, needless = explanation
        for at, part in enumerate(parts):
            for grown in self._grown(part, seen):
                yield Explained((*parts[:at], grown, *parts[at + 1 :]), needless)
        if len(parts) < self.goals:
            pursued = {self.plans[part.plan].label for part in parts}
            for new in self._new.get(seen.action, ()):
                if self.plans[new.plan].label not in pursued:
                    for grown in self._grown(new, seen):
                        yield Explained((*parts, grown), needless)
        if self.noise is not None:
            yield Explained(parts, needless + 1)

    def _grown(self, part: Pursued, seen: Observation) -> Iterator[Pursued]:
        """The plan under way with one more leaf observed, for each that the observation can be."""
        plan, meaning = part.plan, self.meanings[part.plan]
        for leaf in meaning.named.get(seen.action, ()):
            if part.open >> leaf & 1:
                binding = self._match(plan, leaf, seen, part.binding)
                if not isinstance(binding, Mismatch):
                    marked, still_open = part.marked | 1 << leaf, part.open & ~meaning.ruled_out[leaf]
                    belonging = meaning.root.belonging(marked)
                    missed = belonging & ~marked & ~still_open
                    marks, size = (*part.marks, leaf), belonging.bit_count()
                    yield Pursued(plan, marks, marked, still_open, binding, size, missed.bit_count())

    def _match(self, plan: int, leaf: int, seen: Observation, binding: Binding) -> Binding | Mismatch:
        """What the matcher says; it is asked once for each leaf and binding."""
        key = (plan, leaf, binding)
        if key not in self._matched:
            self._matched[key] = self.matcher.match(plan, leaf, seen, binding)
        return self._matched[key]

    @property
    def count(self) -> int:
        """How many explanations there are; what takes every observation for needless is none."""
        return sum(bool(explanation.parts) for explanation in self.explanations)

    def score(self, explanation: Explained) -> float:
        """The paper's, over the leaves of all plans, and the price of what is needless; 0 when everything is."""
        size = sum(part.size for part in explanation.parts)
        missed = sum(part.missed for part in explanation.parts)
        observed = self.observed - explanation.needless
        price = 1.0 if self.noise is None else self.noise**explanation.needless
        return price * observed * (size - missed) / size**2 if size else 0.0

    def posterior(self) -> dict[str, float]:
        """Each goal's probability of being among those pursued."""
        totals, whole = {plan.label: 0.0 for plan in self.plans}, 0.0
        for explanation in self.explanations:
            score = self.score(explanation)
            whole += score
            for part in explanation.parts:
                totals[self.plans[part.plan].label] += score
        return {label: total / whole if whole else 0.0 for label, total in totals.items()}

    def best(self) -> float:
        """The score of the best explanation; 0 when there is none."""
        return max(map(self.score, self.explanations), default=0.0)
