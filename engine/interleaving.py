"""Several goals at once: every observation is a step of one of the goals pursued, or needless where noise is allowed.

An explanation is a set of up to N different goals, a plan for each, and a leaf for every observation, such that each
goal has at least one and within each plan Algorithm 1 holds. Its score is the paper's over the leaves of all its
plans: observed and missed leaves add up. What is yet to come depends on the *hypothesis* only, the plans with the state
of each, so a level counts explanations by hypothesis.

There are as many hypotheses as combinations of states. For two goals all are kept, and everything is exact. For more
the ``budget`` most promising ones go on; once one was dropped, counts and sums are lower bounds, and `is_exact` says
so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from heapq import nlargest
from itertools import groupby, takewhile
from math import prod
from typing import TypeAlias

from casper.engine.counting import is_certain, positions_of
from casper.engine.explanation import Explanation, Interleaved
from casper.engine.matching import Binding, Matcher, Mismatch
from casper.engine.observation import Observation, Seen, options_of
from casper.engine.paths import best_first
from casper.engine.policy import Standing
from casper.engine.scoring import Score, least_tie, paper
from casper.engine.states import NEEDLESS, State, Weight, start
from casper.plans.plan import Plan

Part: TypeAlias = tuple[int, State]  # plan, and where it stands
Hypothesis: TypeAlias = tuple[tuple[Part, ...], int]  # the goals pursued, in the order of the library; needless ones
Mark: TypeAlias = tuple[int, int]  # plan and leaf; (NEEDLESS, NEEDLESS)
Move: TypeAlias = tuple[int, State, float]  # leaf, state after, likelihood
Counts: TypeAlias = dict[Hypothesis, int]
Trail: TypeAlias = dict[Hypothesis, list[tuple[Hypothesis, Mark, float]]]

EXACT_GOALS = 2


class Interleaving:
    """Counts for up to so many goals at once. Interface: `casper.engine.recognisers.Recogniser`.

    Args:
        plans, matcher, noise, priors, measure: as for `casper.engine.counting.Counting`.
        goals: how many goals may be pursued at once.
        budget: how many hypotheses are kept where there may be more than two.
    """

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        goals: int = EXACT_GOALS,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int = 3000,
    ) -> None:
        self.plans, self.matcher, self.goals, self.noise = plans, matcher, goals, noise
        self.measure, self.budget = measure, budget
        self.priors = priors or (1.0,) * len(plans)
        self.labels = [plan.label for plan in plans]
        self.charts = [plan.chart for plan in plans]
        self._holders: dict[str, list[tuple[int, list[int]]]] = {}  # by action: plans and their leaves of that name
        self._starts: dict[int, State] = {}
        self.observations: list[Seen] = []
        self.mismatches: list[dict[int, dict[str, None]]] = [{}]
        self._levels: list[Counts] = [{((), 0): 1}]
        self._trails: list[Trail] = []
        self._weights: list[dict[Hypothesis, Weight] | None] = [None]
        self._exact = [True]
        self._scored: list[tuple[float, Hypothesis]] | None = None
        for number, plan in enumerate(plans):
            binding = matcher.initial(number)
            if isinstance(binding, Mismatch):
                self._note(number, binding)
                continue
            self._starts[number] = start(self.charts[number], binding)
            for action, leaves in positions_of(plan).items():
                self._holders.setdefault(action, []).append((number, leaves))

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every hypothesis by one observation."""
        self.mismatches.append({})
        certain = is_certain(seen)
        trail = self._trail(options_of(seen))
        counts = {after: sum(self._levels[-1][before] for before, _, _ in steps) for after, steps in trail.items()}
        self.observations.append(seen)
        self.matcher.observed(options_of(seen)[0][0] if certain else Observation(seen.action))
        weights = self._weighed(trail, certain)
        exact = self._exact[-1]
        if self.goals > EXACT_GOALS and len(counts) > self.budget:
            kept = nlargest(self.budget, counts, key=lambda h: self._promise(h, weights))
            counts = {hypothesis: counts[hypothesis] for hypothesis in kept}
            exact = False
        self._levels.append(counts)
        self._trails.append(trail)
        self._weights.append(weights)
        self._exact.append(exact)
        self._scored = None

    def _trail(self, options: Iterable[tuple[Observation, float]]) -> Trail:
        """The hypotheses that follow, each with what leads there."""
        trail: Trail = {}
        moves: dict[Part, list[Move]] = {}
        matched: dict[tuple[int, int, Observation, Binding], Binding | None] = {}
        holders = [(number, option, weight, leaves) for option, weight in options
                   for number, leaves in self._holders.get(option.action, ())]  # fmt: skip
        by_plan: dict[int, list[tuple[Observation, float, list[int]]]] = {}
        for number, option, weight, leaves in holders:
            by_plan.setdefault(number, []).append((option, weight, leaves))

        def onward(part: Part) -> list[Move]:
            if part not in moves:
                moves[part] = list(self._moves(part, by_plan.get(part[0], ()), matched))
            return moves[part]

        for before in self._levels[-1]:
            parts, needless = before
            for at, part in enumerate(parts):
                for leaf, state, likelihood in onward(part):
                    after = ((*parts[:at], (part[0], state), *parts[at + 1 :]), needless)
                    trail.setdefault(after, []).append((before, (part[0], leaf), likelihood))
            if len(parts) < self.goals:
                taken = {self.labels[number] for number, _ in parts}
                for number in by_plan:
                    if self.labels[number] not in taken:
                        for leaf, state, likelihood in onward((number, self._starts[number])):
                            after = (_with(parts, (number, state)), needless)
                            trail.setdefault(after, []).append((before, (number, leaf), likelihood))
            if self.noise is not None:
                trail.setdefault((parts, needless + 1), []).append((before, (NEEDLESS, NEEDLESS), 1.0))
        return trail

    def _moves(
        self,
        part: Part,
        holders: Iterable[tuple[Observation, float, list[int]]],
        matched: dict[tuple[int, int, Observation, Binding], Binding | None],
    ) -> Iterator[Move]:
        plan, (closed, entered, size, missed, _, binding) = part
        for option, likelihood, leaves in holders:
            for leaf in leaves:
                if closed >> leaf & 1:
                    continue
                key = (plan, leaf, option, binding)
                if key not in matched:
                    result = self.matcher.match(plan, leaf, option, binding)
                    matched[key] = None if isinstance(result, Mismatch) else result
                    if isinstance(result, Mismatch):
                        self._note(plan, result)
                after = matched[key]
                if after is not None:
                    progress = self.charts[plan].close((closed, entered, size, missed), leaf)
                    yield leaf, (*progress, 0, after), likelihood

    def _weighed(self, trail: Trail, certain: bool) -> dict[Hypothesis, Weight] | None:
        before, counts = self._weights[-1], self._levels[-1]
        if before is None and certain:
            return None
        weighed: dict[Hypothesis, Weight] = {}
        for after, steps in trail.items():
            total, best, equal = 0.0, 0.0, 0
            for earlier, _, likelihood in steps:
                mass, largest, ties = before[earlier] if before is not None else (counts[earlier], 1.0, counts[earlier])
                reached = largest * likelihood
                total += mass * likelihood
                equal = ties if reached > best else equal + ties if reached == best else equal
                best = max(best, reached)
            weighed[after] = (total, best, equal)
        return weighed

    def _promise(self, hypothesis: Hypothesis, weights: dict[Hypothesis, Weight] | None) -> tuple[int, float]:
        """What is kept when not all can be: what needs fewest goals, misses and needless observations, then the score.

        The score alone prefers few goals while little was observed, and drops what turns out to be true.
        """
        parts, needless = hypothesis
        likelihood = weights[hypothesis][1] if weights is not None else 1.0
        price = len(parts) + needless + sum(state[3] for _, state in parts)
        return -price, self._score(hypothesis) * self._prior(hypothesis) * likelihood

    def undo(self) -> None:
        """Take back the last observation."""
        for stack in (self.observations, self.mismatches, self._levels, self._trails, self._weights, self._exact):
            stack.pop()
        self.matcher.forget()
        self._scored = None

    def fork(self) -> Interleaving:
        """A copy that goes its own way; what was counted so far is shared."""
        other = object.__new__(Interleaving)
        other.__dict__.update(self.__dict__)
        other.matcher = self.matcher.fork()
        for name in ("observations", "mismatches", "_levels", "_trails", "_weights", "_exact"):
            setattr(other, name, list(getattr(self, name)))
        return other

    def _note(self, plan: int, mismatch: Mismatch) -> None:
        self.mismatches[-1].setdefault(plan, {}).update(dict.fromkeys(mismatch.reasons))

    # --- what the counts say ---------------------------------------------------------------------------------------

    @property
    def is_exact(self) -> bool:
        """Whether no hypothesis was dropped so far."""
        return self._exact[-1]

    @property
    def count(self) -> int:
        """The number of explanations; before the first observation, of plans."""
        return sum(self._levels[-1][h] for _, h in self._hypotheses()) if self.observations else len(self._starts)

    def alive(self, level: int) -> set[int]:
        """The plans that take part in explaining the first so many observations."""
        if level == 0:
            return set(self._starts)
        return {plan for parts, _ in self._levels[level] for plan, _ in parts}

    def _score(self, hypothesis: Hypothesis) -> float:
        """Of an explanation that ends here: its score; 0 where everything is needless."""
        parts, needless = hypothesis
        if not parts:
            return 0.0
        size, missed = sum(state[2] for _, state in parts), sum(state[3] for _, state in parts)
        above, below = self.measure(size, len(self.observations) - needless, missed)
        return above / below if not needless else (self.noise or 1.0) ** needless * (above / below)

    def _prior(self, hypothesis: Hypothesis) -> float:
        return prod(self.priors[plan] for plan, _ in hypothesis[0])

    def _hypotheses(self) -> list[tuple[float, Hypothesis]]:
        """Weight (score and priors, of certain observations) and hypothesis, the best first."""
        if self._scored is None:
            found = [(self._score(h) * self._prior(h), h) for h in self._levels[-1] if h[0]]
            if self._weights[-1] is not None:
                found = [(weight * self._weights[-1][h][1], h) for weight, h in found]
            self._scored = sorted(found, key=lambda pair: (-pair[0], [plan for plan, _ in pair[1][0]]))
        return self._scored

    def _masses(self) -> Iterator[tuple[Hypothesis, float]]:
        weights = self._weights[-1]
        for weight, h in self._hypotheses():
            if weights is None:
                yield h, weight * self._levels[-1][h]
            else:
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
        weight, (parts, _) = found[0]
        goals, least = self._goals(parts), least_tie(weight)
        weights, rivals, ties = self._weights[-1], 0, 0
        for _, h in takewhile(lambda pair: pair[0] >= least, found):
            number = self._levels[-1][h] if weights is None else weights[h][2]
            ties += number
            rivals += number if self._goals(h[0]) != goals else 0
        missed = sum(state[3] for _, state in parts)
        return Standing(self.count, " + ".join(goals), missed, rivals, ties)

    def _goals(self, parts: tuple[Part, ...]) -> tuple[str, ...]:
        return tuple(self.labels[plan] for plan, _ in parts)

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: per goal pursued (plan, mask of closed leaves, binding), and their share."""
        masses = list(self._masses())
        whole = sum(mass for _, mass in masses)
        for (parts, _), mass in masses:
            yield tuple((plan, state[0], state[5]) for plan, state in parts), mass / whole if whole else 0.0

    def first(self) -> Interleaved | None:
        """The best explanation; None when there is none."""
        return next(self.explanations(), None)

    def explanations(self) -> Iterator[Interleaved]:
        """Every explanation, best first, lazily."""
        whole = sum(mass for _, mass in self._masses())
        steps = len(self.observations)

        def back(level: int, hypothesis: Hypothesis) -> list[tuple[Hypothesis, Mark, float]]:
            kept = self._levels[level - 1]
            return [step for step in self._trails[level - 1][hypothesis] if step[0] in kept]

        for finals in self._batches():
            for weight, marks, (parts, _) in best_first(finals, back, steps):
                share = weight / whole if whole else 0.0
                yield self._told(parts, marks, weight, share)

    def _batches(self) -> Iterator[dict[Hypothesis, float]]:
        """Final hypotheses with their weights: one weight after the other, or all where paths weigh differently."""
        if self._weights[-1] is not None:
            yield {h: self._score(h) * self._prior(h) for _, h in self._hypotheses()}
            return
        for weight, group in groupby(self._hypotheses(), key=lambda pair: pair[0]):
            yield {h: weight for _, h in group}

    def _told(self, parts: tuple[Part, ...], marks: Sequence[Mark], weight: float, share: float) -> Interleaved:
        score = weight / self._prior((parts, 0))
        told = tuple(
            Explanation(self.plans[plan], tuple(leaf for p, leaf in marks if p == plan), state[5], score, share)
            for plan, state in parts
        )
        needless = tuple(at for at, (plan, _) in enumerate(marks) if plan == NEEDLESS)
        return Interleaved(told, score, share, needless)


def _with(parts: tuple[Part, ...], part: Part) -> tuple[Part, ...]:
    """The parts with one more, in the order of the library."""
    at = sum(other[0] < part[0] for other in parts)
    return (*parts[:at], part, *parts[at:])
