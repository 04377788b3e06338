"""Levels of hypotheses, observation after observation: the lower half of `interleaving`.

A *hypothesis* is the plans pursued with the state of each. There are as many as combinations of states; of more than
the budget the most promising go on, counts and sums are lower bounds from then on, and the level says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import nlargest
from math import prod
from typing import TypeAlias

from casper.engine.recognition.kernels.kernel import NEEDLESS, Listing
from casper.engine.recognition.kernels.states import State, Weight, is_certain, joined, positions_of, start
from casper.engine.recognition.scoring import Score, paper
from casper.engine.verification.matching import Binding, Matcher, Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.plans.trees.plan import Plan

Part: TypeAlias = tuple[int, State]  # plan, and where it stands
Hypothesis: TypeAlias = tuple[tuple[Part, ...], int]  # the goals pursued, in the order of the library; needless ones
Mark: TypeAlias = tuple[int, int]  # plan and leaf; (NEEDLESS, NEEDLESS)
Step: TypeAlias = tuple[Hypothesis, Mark, float]  # hypothesis before, mark, likelihood
Begun: TypeAlias = tuple[int, int, State, float]  # plan, and its first move: leaf, state after, likelihood
Options: TypeAlias = dict[int, list[tuple[Observation, float, list[int]]]]  # by plan: what was seen, leaves of the name

EXACT_GOALS = 2  # at once: up to here all hypotheses are kept, as far as an observation stays within a second or so
MOST_KEPT = 50_000  # of up to two goals
MOST_SEARCHED = 3000  # of more goals


@dataclass(slots=True)
class Level:
    """Counts by hypothesis, what led to each, and weights (None: all certain); ``before``: the last level."""

    k: int
    counts: dict[Hypothesis, int]
    trail: dict[Hypothesis, list[Step]]
    weights: dict[Hypothesis, Weight] | None
    noted: dict[int, list[Mismatch]]
    exact: bool = True
    before: Level | None = None
    weighed: list[tuple[float, Hypothesis]] | None = None  # what the best of each weighs, in no order; when asked for


class Hypotheses(Listing[Level]):
    """Counts for up to so many goals at once.

    ``budget`` is how many hypotheses are kept; None for `MOST_KEPT` of up to two goals, else `MOST_SEARCHED`.
    """

    several = True

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
        super().__init__(plans, matcher, noise, priors, measure)
        self.goals = goals
        self.budget = budget or (MOST_SEARCHED if goals > EXACT_GOALS else MOST_KEPT)
        self.charts = [plan.chart for plan in plans]
        self._holders: dict[str, list[tuple[int, list[int]]]] = {}  # by action: plans and their leaves of that name
        self.starts: dict[int, State] = {}
        self._begin = Level(0, {((), 0): 1}, {}, None, {})
        for number, plan in enumerate(plans):
            binding = matcher.initial(number)
            if isinstance(binding, Mismatch):
                self._begin.noted[number] = [binding]
                continue
            self.starts[number] = start(self.charts[number], binding)
            for action, leaves in positions_of(plan).items():
                self._holders.setdefault(action, []).append((number, leaves))

    def begin(self) -> Level:
        """Nothing is pursued yet."""
        return self._begin

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """Every hypothesis goes on by one observation."""
        after = Level(level.k + 1, {}, {}, None, {}, level.exact, level)
        trail = after.trail = self._trail(after, options_of(seen), matcher)
        after.counts = {hypothesis: sum([level.counts[b] for b, _, _ in steps]) for hypothesis, steps in trail.items()}
        if level.weights is not None or not is_certain(seen):
            after.weights = {hypothesis: _weight(level, steps) for hypothesis, steps in trail.items()}
        if len(after.counts) > self.budget:
            kept = nlargest(self.budget, after.counts, key=lambda h: self._promise(after, h))
            after.counts, after.exact = {hypothesis: after.counts[hypothesis] for hypothesis in kept}, False
            after.trail = {hypothesis: trail[hypothesis] for hypothesis in kept}
        return after

    def _trail(
        self, after: Level, options: Iterable[tuple[Observation, float]], matcher: Matcher
    ) -> dict[Hypothesis, list[Step]]:
        """The hypotheses that follow, each with what leads there."""
        assert after.before is not None
        trail: dict[Hypothesis, list[Step]] = {}
        onward = _Moves(self, after.noted, options, matcher)
        moves = [(number, *move) for number in onward.by_plan for move in onward((number, self.starts[number]))]
        begun = self._begun(after, moves)
        for before in after.before.counts:
            parts, needless = before
            for at, part in enumerate(parts):
                for leaf, state, likelihood in onward(part):
                    moved = ((*parts[:at], (part[0], state), *parts[at + 1 :]), needless)
                    trail.setdefault(moved, []).append((before, (part[0], leaf), likelihood))
            if len(parts) < self.goals:
                taken = {self.labels[number] for number, _ in parts}
                for number, leaf, state, likelihood in begun:
                    if self.labels[number] not in taken:
                        moved = (_with(parts, (number, state)), needless)
                        trail.setdefault(moved, []).append((before, (number, leaf), likelihood))
            if self.noise is not None:
                trail.setdefault((parts, needless + 1), []).append((before, (NEEDLESS, NEEDLESS), 1.0))
        return trail

    def _begun(self, after: Level, begun: list[Begun]) -> list[Begun]:
        """Goals that may be begun; those that miss least, where there are too many to try with every hypothesis."""
        assert after.before is not None
        beginning = sum(len(parts) < self.goals for parts, _ in after.before.counts)  # that may begin another
        room = max(1, 4 * self.budget // max(1, beginning))
        if len(begun) <= room:
            return begun
        after.exact = False
        return sorted(begun, key=lambda found: found[2][3])[:room]

    def holders(self, action: str) -> Iterable[tuple[int, list[int]]]:
        """The plans that have an action, each with its leaves of that name."""
        return self._holders.get(action, ())

    def _promise(self, level: Level, hypothesis: Hypothesis) -> tuple[int, float]:
        """What is kept when not all can be: what needs fewest goals, misses and needless observations, then the score.

        The score alone prefers few goals while little was observed, and drops what turns out to be true.
        """
        parts, needless = hypothesis
        likelihood = level.weights[hypothesis][1] if level.weights is not None else 1.0
        price = len(parts) + needless + sum(state[3] for _, state in parts)
        return -price, self.weight(hypothesis, level.k, needless) * likelihood

    def weight(self, hypothesis: Hypothesis, k: int, priced: int) -> float:
        """Of an explanation of k observations that ends here; 0 where everything is needless.

        ``priced`` is how many of the needless observations cost their price.
        """
        parts, needless = hypothesis
        if not parts:
            return 0.0
        size, missed = sum([state[2] for _, state in parts]), sum([state[3] for _, state in parts])
        above, below = self.measure(size, k - needless, missed)
        score = above / below if not priced else (self.noise or 1.0) ** priced * (above / below)
        return score * prod([self.priors[plan] for plan, _ in parts])

    def mismatches(self, level: Level) -> Mapping[int, Sequence[Mismatch]]:
        """By plan, why it could not go on."""
        return level.noted

    def is_exact(self, level: Level) -> bool:
        """Whether no hypothesis was dropped."""
        return level.exact


class _Moves:
    """Where one observation leads from each part of a hypothesis; each is worked out once, and each match."""

    def __init__(
        self,
        kernel: Hypotheses,
        noted: dict[int, list[Mismatch]],
        options: Iterable[tuple[Observation, float]],
        matcher: Matcher,
    ) -> None:
        self._kernel, self._noted, self._matcher = kernel, noted, matcher
        self._known: dict[Part, list[tuple[int, State, float]]] = {}
        self._matched: dict[tuple[int, int, Observation, Binding], Binding | None] = {}
        self.by_plan: Options = {}
        for option, likelihood in options:
            for number, leaves in kernel.holders(option.action):
                self.by_plan.setdefault(number, []).append((option, likelihood, leaves))

    def __call__(self, part: Part) -> list[tuple[int, State, float]]:
        """Leaf, state after, likelihood."""
        found = self._known.get(part)
        if found is None:
            found = self._known[part] = list(self._made(part))
        return found

    def _made(self, part: Part) -> Iterator[tuple[int, State, float]]:
        plan, (closed, entered, size, missed, _, binding) = part
        for option, likelihood, leaves in self.by_plan.get(plan, ()):
            for leaf in leaves:
                after = None if closed >> leaf & 1 else self._match(plan, leaf, option, binding)
                if after is not None:
                    progress = self._kernel.charts[plan].close((closed, entered, size, missed), leaf)
                    yield leaf, (*progress, 0, after), likelihood

    def _match(self, plan: int, leaf: int, option: Observation, binding: Binding) -> Binding | None:
        key = (plan, leaf, option, binding)
        if key not in self._matched:
            result = self._matcher.match(plan, leaf, option, binding)
            self._matched[key] = None if isinstance(result, Mismatch) else result
            if isinstance(result, Mismatch):
                self._noted.setdefault(plan, []).append(result)
        return self._matched[key]


def _weight(level: Level, steps: Iterable[Step]) -> Weight:
    """The weight of a hypothesis that these steps lead to."""
    weight: Weight = (0.0, 0.0, 0)
    for earlier, _, likelihood in steps:
        number = level.counts[earlier]
        before = level.weights[earlier] if level.weights is not None else (float(number), 1.0, number)
        weight = joined(weight, before, likelihood)
    return weight


def _with(parts: tuple[Part, ...], part: Part) -> tuple[Part, ...]:
    """The parts with one more, in the order of the library."""
    if len(parts) == 1:  # the commonest case by far
        return (*parts, part) if parts[0][0] < part[0] else (part, *parts)
    at = sum([other[0] < part[0] for other in parts])
    return (*parts[:at], part, *parts[at:])
