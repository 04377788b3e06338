"""Several goals at once: every observation is a step of one of the goals pursued, or needless where noise is allowed.

An explanation is a set of up to N different goals, a plan for each, and a leaf for every observation, such that each
goal has at least one and within each plan Algorithm 1 holds. Its score is the paper's over the leaves of all its
plans: observed and missed leaves add up. What is yet to come depends on the *hypothesis* only, the plans with the state
of each, so a level counts explanations by hypothesis.

There are as many hypotheses as combinations of states (`hypotheses`). For two goals all are kept, and
everything is exact; for more, and where even those of two are too many, it is a best-first search that says so.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.engine.recognition.kernels.hypotheses import Hypotheses, Hypothesis, Level, Mark, Part, Step
from casper.engine.recognition.kernels.kernel import NEEDLESS, Leading, Parts, Path, Plans
from casper.engine.recognition.kernels.paths import best_first
from casper.engine.recognition.scoring import least_tie


class Interleaving(Hypotheses):
    """What the counts of up to so many goals at once say (arguments: `hypotheses.Hypotheses`)."""

    def count(self, level: Level) -> int:
        """The number of explanations; before the first observation, of plans."""
        return sum([level.counts[h] for _, h in self._weighed(level)]) if level.k else len(self.starts)

    def alive(self, level: Level) -> set[int]:
        """The plans that are part of a hypothesis."""
        return {plan for parts, _ in level.counts for plan, _ in parts} if level.k else set(self.starts)

    def least(self, level: Level) -> int:
        """The fewest needless observations of an explanation."""
        if self.noise is None:
            return 0
        return min((needless for parts, needless in level.counts if parts), default=0)

    def _weighed(self, level: Level) -> list[tuple[float, Hypothesis]]:
        """Weight and hypothesis, in no order: of thousands mostly the best are wanted, or all together."""
        if level.weighed is None:
            found = list(self._in_one_go(level))
            if level.weights is not None:
                found = [(weight * level.weights[h][1], h) for weight, h in found]
            level.weighed = found
        return level.weighed

    def _in_one_go(self, level: Level) -> Iterator[tuple[float, Hypothesis]]:
        """`weight` of every hypothesis of the level, without its likelihood: there may be thousands."""
        k, least, measure, priors, price = level.k, self.least(level), self.measure, self.priors, self.noise
        for hypothesis in level.counts:
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

    def _summed(self, level: Level) -> Iterator[tuple[Hypothesis, float]]:
        """The sum of the weights of the explanations that end in each hypothesis."""
        weights = level.weights
        for weight, h in self._weighed(level):
            if weights is None:
                yield h, weight * level.counts[h]
            elif weights[h][1]:
                yield h, weight / weights[h][1] * weights[h][0]

    def masses(self, level: Level) -> list[float]:
        """Per plan the sum of the weights of the explanations that it takes part in."""
        found = [0.0] * len(self.plans)
        for (parts, _), mass in self._summed(level):
            for plan, _ in parts:
                found[plan] += mass
        return found

    def total(self, level: Level) -> float:
        """The sum of all weights, each explanation once."""
        return sum([mass for _, mass in self._summed(level)])

    def posterior(self, level: Level) -> dict[str, float]:
        """Each goal's probability of being among those pursued."""
        totals, whole = dict.fromkeys(self.labels, 0.0), self.total(level)
        for label, mass in zip(self.labels, self.masses(level)):
            totals[label] += mass
        return {label: total / whole if whole else 0.0 for label, total in totals.items()}

    def leading(self, level: Level) -> Leading | None:
        """The best explanation, and its rivals: those of other sets of goals."""
        found, weights = self._weighed(level), level.weights
        if not found:
            return None
        least = least_tie(max(found, key=_first)[0])
        numbers = level.counts if weights is None else {h: weight[2] for h, weight in weights.items()}
        return self.leading_of([
            (weight, plans_of(h[0]), sum([state[3] for _, state in h[0]]), numbers[h])
            for weight, h in found if weight >= least
        ])  # fmt: skip

    def tops(self, level: Level) -> Iterator[tuple[float, Plans]]:
        """What the best explanation weighs that ends in each hypothesis."""
        return ((weight, plans_of(parts)) for weight, (parts, _) in self._weighed(level))

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        """By hypothesis."""
        for (parts, _), mass in self._summed(level):
            yield tuple((plan, state[0], state[5]) for plan, state in parts), mass

    def paths(self, level: Level, plans: Plans) -> Iterator[Path]:
        """The explanations of exactly these plans, best first."""
        levels, least = [level], self.least(level)
        while levels[-1].before is not None:
            levels.append(levels[-1].before)
        levels.reverse()
        chosen = [h for h in level.counts if h[0] and plans_of(h[0]) == plans]
        finals = {h: self.weight(h, level.k, h[1] - least) for h in chosen}

        def back(at: int, hypothesis: Hypothesis) -> list[Step]:
            kept = levels[at - 1].counts
            return [step for step in levels[at].trail[hypothesis] if step[0] in kept]

        for weight, marks, hypothesis in best_first(finals, back, level.k):
            likelihood = 1.0 if level.weights is None else weight / (finals[hypothesis] or 1.0)
            yield _path(hypothesis[0], marks, likelihood)


def plans_of(parts: tuple[Part, ...]) -> Plans:
    """The plans pursued."""
    return tuple([plan for plan, _ in parts])


def _path(parts: tuple[Part, ...], marks: tuple[Mark, ...], likelihood: float) -> Path:
    told = tuple((plan, tuple(leaf for p, leaf in marks if p == plan), state[5]) for plan, state in parts)
    needless = tuple(at for at, (plan, _) in enumerate(marks) if plan == NEEDLESS)
    return Path(told, needless, sum(s[2] for _, s in parts), sum(s[3] for _, s in parts), likelihood)


def _first(found: tuple[float, Hypothesis]) -> float:
    return found[0]
