"""Counts by hypothesis, observation after observation: the lower half of `interleaving`.

A *hypothesis* is the plans pursued with the state of each. There are as many as combinations of states; of more than
the budget the most promising go on, counts and sums are lower bounds from then on, and `Stacks.is_exact` says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from heapq import nlargest
from math import prod
from typing import TypeAlias

from casper.engine.recognition.levels import is_certain, positions_of
from casper.engine.recognition.scoring import Score, paper
from casper.engine.recognition.stacks import Stacks
from casper.engine.recognition.states import NEEDLESS, State, Weight, start
from casper.engine.verification.matching import Binding, Matcher, Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.plans.trees.plan import Plan

Part: TypeAlias = tuple[int, State]  # plan, and where it stands
Hypothesis: TypeAlias = tuple[tuple[Part, ...], int]  # the goals pursued, in the order of the library; needless ones
Mark: TypeAlias = tuple[int, int]  # plan and leaf; (NEEDLESS, NEEDLESS)
Move: TypeAlias = tuple[int, State, float]  # leaf, state after, likelihood
Begun: TypeAlias = tuple[int, int, State, float]  # plan, and its first move
Counts: TypeAlias = dict[Hypothesis, int]
Trail: TypeAlias = dict[Hypothesis, list[tuple[Hypothesis, Mark, float]]]

EXACT_GOALS = 2  # at once: up to here all hypotheses are kept, as far as an observation stays within a second or so
MOST_KEPT = 50_000  # of up to two goals
MOST_SEARCHED = 3000  # of more goals


class Hypotheses(Stacks):
    """Counts for up to so many goals at once.

    Args:
        plans, matcher, noise, priors, measure: as for `counting.Counting`.
        goals: how many goals may be pursued at once.
        budget: how many hypotheses are kept; None for `MOST_KEPT` of up to two goals, else `MOST_SEARCHED`.
    """

    STACKS = (*Stacks.STACKS, "_levels", "_trails", "_weights")

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        goals: int = EXACT_GOALS,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int | None = None,
    ) -> None:
        super().__init__(matcher)
        self.plans, self.goals, self.noise = plans, goals, noise
        self.measure = measure
        self.budget = budget or (MOST_SEARCHED if goals > EXACT_GOALS else MOST_KEPT)
        self.priors = priors or (1.0,) * len(plans)
        self.labels = [plan.label for plan in plans]
        self.rank = {label: at for at, label in enumerate(dict.fromkeys(self.labels))}
        self.charts = [plan.chart for plan in plans]
        self._holders: dict[str, list[tuple[int, list[int]]]] = {}  # by action: plans and their leaves of that name
        self._starts: dict[int, State] = {}
        self._levels: list[Counts] = [{((), 0): 1}]
        self._trails: list[Trail] = []
        self._weights: list[dict[Hypothesis, Weight] | None] = [None]
        self._all_kept = True  # whether the observation that is taken in just now dropped nothing
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
        self._noted, self._all_kept = {}, True
        certain, k = is_certain(seen), len(self.observations) + 1
        trail = self._trail(options_of(seen))
        earlier = self._levels[-1]
        counts = {after: sum([earlier[before] for before, _, _ in steps]) for after, steps in trail.items()}
        weights = self._weighed(trail, certain)
        if len(counts) > self.budget:
            self._all_kept = False
            kept = nlargest(self.budget, counts, key=lambda h: self._promise(h, k, weights))
            counts = {hypothesis: counts[hypothesis] for hypothesis in kept}
            trail = {hypothesis: trail[hypothesis] for hypothesis in kept}
        self.mismatches.append(self._noted)  # from here on nothing can go wrong: an observation is taken in or not
        self._levels.append(counts)
        self._trails.append(trail)
        self._weights.append(weights)
        self.exact.append(self.is_exact and self._all_kept)
        self.observations.append(seen)
        self.matcher.observed(options_of(seen)[0][0] if certain else Observation(seen.action))

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

        begun = self._begun([(number, *move) for number in by_plan for move in onward((number, self._starts[number]))])
        for before in self._levels[-1]:
            parts, needless = before
            for at, part in enumerate(parts):
                for leaf, state, likelihood in onward(part):
                    after = ((*parts[:at], (part[0], state), *parts[at + 1 :]), needless)
                    trail.setdefault(after, []).append((before, (part[0], leaf), likelihood))
            if len(parts) < self.goals:
                taken = {self.labels[number] for number, _ in parts}
                for number, leaf, state, likelihood in begun:
                    if self.labels[number] not in taken:
                        after = (_with(parts, (number, state)), needless)
                        trail.setdefault(after, []).append((before, (number, leaf), likelihood))
            if self.noise is not None:
                trail.setdefault((parts, needless + 1), []).append((before, (NEEDLESS, NEEDLESS), 1.0))
        return trail

    def _begun(self, begun: list[Begun]) -> list[Begun]:
        """Goals that may be begun; those that miss least, where there are too many to try with every hypothesis."""
        beginning = sum(len(parts) < self.goals for parts, _ in self._levels[-1])  # hypotheses that may begin another
        room = max(1, 4 * self.budget // max(1, beginning))
        if len(begun) <= room:
            return begun
        self._all_kept = False
        return sorted(begun, key=lambda found: found[2][3])[:room]

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

    def _promise(self, hypothesis: Hypothesis, k: int, weights: dict[Hypothesis, Weight] | None) -> tuple[int, float]:
        """What is kept when not all can be: what needs fewest goals, misses and needless observations, then the score.

        The score alone prefers few goals while little was observed, and drops what turns out to be true.
        """
        parts, needless = hypothesis
        likelihood = weights[hypothesis][1] if weights is not None else 1.0
        price = len(parts) + needless + sum(state[3] for _, state in parts)
        return -price, self._score(hypothesis, k, needless) * self._prior(hypothesis) * likelihood

    def _score(self, hypothesis: Hypothesis, k: int, priced: int) -> float:
        """Of an explanation of k observations that ends here: its score; 0 where everything is needless.

        ``priced`` is how many of the needless observations cost their price.
        """
        parts, needless = hypothesis
        if not parts:
            return 0.0
        size, missed = sum(state[2] for _, state in parts), sum(state[3] for _, state in parts)
        above, below = self.measure(size, k - needless, missed)
        return above / below if not priced else (self.noise or 1.0) ** priced * (above / below)

    def _prior(self, hypothesis: Hypothesis) -> float:
        return prod(self.priors[plan] for plan, _ in hypothesis[0])


def _with(parts: tuple[Part, ...], part: Part) -> tuple[Part, ...]:
    """The parts with one more, in the order of the library."""
    if len(parts) == 1:  # the commonest case by far
        return (*parts, part) if parts[0][0] < part[0] else (part, *parts)
    at = sum([other[0] < part[0] for other in parts])
    return (*parts[:at], part, *parts[at:])
