"""Several goals at once: every observation is a step of one of the goals pursued, or needless where noise is allowed.

An explanation is a set of up to N different goals, a plan for each, and a leaf for every observation, such that each
goal has at least one and within each plan Algorithm 1 holds. Its score is the paper's over the leaves of all its
plans: observed and missed leaves add up. What is yet to come depends on the *hypothesis* only, the plans with the state
of each, so a level counts explanations by hypothesis.

There are as many hypotheses as combinations of states (`hypotheses`). For two goals all are kept, and
everything is exact; for more, and where even those of two are too many, it is a best-first search that says so.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.recognition.hypotheses import Counts, Hypotheses, Hypothesis, Mark, Part
from casper.engine.recognition.paths import best_first
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.recognition.states import NEEDLESS
from casper.engine.verification.matching import Binding


class Interleaving(Hypotheses):
    """What the counts say. Interface: `recognisers.Recogniser`; arguments: `Hypotheses`."""

    _found: tuple[Counts, list[tuple[float, Hypothesis]]] | None = None  # the hypotheses of a level

    @property
    def count(self) -> int:
        """The number of explanations; before the first observation, of plans."""
        return sum([self._levels[-1][h] for _, h in self._hypotheses()]) if self.observations else len(self._starts)

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations."""
        if level == 0:
            return set(self._starts)
        return {plan for parts, _ in self._levels[level] for plan, _ in parts}

    def _hypotheses(self) -> list[tuple[float, Hypothesis]]:
        """Weight and hypothesis, in no order: of thousands mostly the best are wanted, or all together.

        A price that all pay is left out of the weights (`_least`).
        """
        level, weights = self._levels[-1], self._weights[-1]
        if self._found is None or self._found[0] is not level:
            found = list(self._weighed_level())
            if weights is not None:
                found = [(weight * weights[h][1], h) for weight, h in found]
            self._found = level, found
        return self._found[1]

    def _weighed_level(self) -> Iterator[tuple[float, Hypothesis]]:
        """`_score` and `_prior` of every hypothesis of the level, in one go: there may be thousands."""
        k, least, measure, priors, price = len(self.observations), self._least(), self.measure, self.priors, self.noise
        for hypothesis in self._levels[-1]:
            parts, needless = hypothesis
            if parts:
                size, missed, prior = 0, 0, 1.0
                for plan, state in parts:
                    size += state[2]
                    missed += state[3]
                    prior *= priors[plan]
                above, below = measure(size, k - needless, missed)
                weight = above / below if needless == least else (price or 1.0) ** (needless - least) * (above / below)
                yield weight * prior, hypothesis

    def _least(self) -> int:
        """The fewest needless observations of an explanation: all others have at least as many."""
        if self.noise is None:
            return 0
        return min((needless for parts, needless in self._levels[-1] if parts), default=0)

    def _masses(self) -> Iterator[tuple[Hypothesis, float]]:
        weights = self._weights[-1]
        for weight, h in self._hypotheses():
            if weights is None:
                yield h, weight * self._levels[-1][h]
            elif weights[h][1]:
                yield h, weight / weights[h][1] * weights[h][0]

    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability of being among those pursued."""
        totals = dict.fromkeys(self.labels, 0.0)
        whole = 0.0
        for (parts, _), mass in self._masses():
            whole += mass
            for plan, _ in parts:
                totals[self.labels[plan]] += mass
        return {label: total / whole if whole else 0.0 for label, total in totals.items()}

    def standing(self) -> Standing | None:
        """The best explanation, and its rivals: those of other sets of goals."""
        found = self._hypotheses()
        if not found:
            return None
        top = max(found, key=_weight)[0]
        least, counts, weights = least_tie(top), self._levels[-1], self._weights[-1]
        equal = [(weight, h) for weight, h in found if weight >= least]
        goals = self._goals(min([h[0] for weight, h in equal if weight == top], key=_plans))
        numbers = [(counts[h] if weights is None else weights[h][2], self._goals(h[0]) == goals) for _, h in equal]
        missed = min([sum(state[3] for _, state in h[0]) for _, h in equal if self._goals(h[0]) == goals])
        ties, rivals = sum([n for n, _ in numbers]), sum([n for n, is_same in numbers if not is_same])
        return Standing(self.count, " + ".join(goals), missed, rivals, ties)

    def _goals(self, parts: tuple[Part, ...]) -> tuple[str, ...]:
        return tuple(sorted((self.labels[plan] for plan, _ in parts), key=self.rank.__getitem__))

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""
        masses = list(self._masses())
        whole = sum(mass for _, mass in masses)
        for (parts, _), mass in masses:
            yield tuple((plan, state[0], state[5]) for plan, state in parts), mass / whole if whole else 0.0

    def first(self, goal: str | None = None) -> Interleaved | None:
        """The best explanation, of all or of a goal (goals pursued together are joined by " + "); None for none."""
        return next(self._told_of(goal), None)

    def explanations(self) -> Iterator[Interleaved]:
        """Every explanation, best first, lazily."""
        return self._told_of(None)

    def _told_of(self, goal: str | None) -> Iterator[Interleaved]:
        whole = sum(mass for _, mass in self._masses())
        steps, certain = len(self.observations), self._weights[-1] is None

        def back(level: int, hypothesis: Hypothesis) -> list[tuple[Hypothesis, Mark, float]]:
            kept = self._levels[level - 1]
            return [step for step in self._trails[level - 1][hypothesis] if step[0] in kept]

        for finals in self._batches(goal):
            for weight, marks, hypothesis in best_first(finals, back, steps):
                likelihood = 1.0 if certain else weight / (finals[hypothesis] or 1.0)
                yield self._told(hypothesis, marks, likelihood, weight / whole if whole else 0.0)

    def _batches(self, goal: str | None) -> Iterator[dict[Hypothesis, float]]:
        """Final hypotheses with their weights: one weight after the other, or all where paths weigh differently."""
        found = [(w, h) for w, h in self._hypotheses() if goal is None or " + ".join(self._goals(h[0])) == goal]
        if self._weights[-1] is not None:
            k, least = len(self.observations), self._least()
            yield {h: self._score(h, k, h[1] - least) * self._prior(h) for _, h in found}
            return
        if not found:
            return
        top = max(found, key=_weight)[0]
        yield {h: weight for weight, h in found if weight == top}
        rest = sorted([pair for pair in found if pair[0] < top], key=_weight, reverse=True)
        for weight, group in groupby(rest, key=_weight):
            yield {h: weight for _, h in group}

    def _told(self, hypothesis: Hypothesis, marks: Sequence[Mark], likelihood: float, share: float) -> Interleaved:
        parts, needless = hypothesis
        score = self._score(hypothesis, len(self.observations), needless) * likelihood
        told = tuple(
            Explanation(self.plans[plan], tuple(leaf for p, leaf in marks if p == plan), state[5], score, share)
            for plan, state in sorted(parts, key=lambda part: self.rank[self.labels[part[0]]])
        )
        unused = tuple(at for at, (plan, _) in enumerate(marks) if plan == NEEDLESS)
        return Interleaved(told, score, share, unused)


def _weight(found: tuple[float, Hypothesis]) -> float:
    return found[0]


def _plans(parts: tuple[Part, ...]) -> list[int]:
    return [plan for plan, _ in parts]
