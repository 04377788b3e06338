"""Levels of nodes, observation after observation: the lower half of `counting`.

A *node* is how many observations are needless, and the state of each plan pursued. There are as many as combinations of
states; of more than the budget the most promising go on, counts and sums are lower bounds from then on, and the level
says so.
"""

from __future__ import annotations

from bisect import bisect
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import nlargest
from typing import Any, TypeAlias

from casper.engine.recognition.kernels.kernel import Kernel, Plans
from casper.engine.recognition.kernels.moves import Move, Moves, is_certain, positions_of
from casper.engine.recognition.scoring import Score, paper
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Seen, options_of
from casper.plans.trees.plan import Plan

Node: TypeAlias = tuple[Any, ...]  # needless observations, then the `State` of each plan pursued
Ended: TypeAlias = tuple[float, Plans, int, int, Node]  # as `Top`, for those that end in the node; the node
Begun: TypeAlias = tuple[Plans, int, list[Move]]  # plans with one more, its place in a node, its first moves
Weight: TypeAlias = tuple[float, float, int]
"""Of what leads to a node: the sum and the largest of the likelihoods, and how many are as large."""

MOST_STATES, MOST_PAIRS, MOST_SEARCHED = 20_000, 50_000, 3000  # nodes kept of one goal, of two at once, of more


@dataclass(slots=True)
class Level:
    """Counts by plans and node, and weights (None: all certain). By plan, ``moves`` are what the last observation can
    be, ``begun`` with what a goal may have begun, ``noted`` why it cannot be more; ``before`` is the last level."""

    k: int
    counts: dict[Plans, dict[Node, int]]
    weights: dict[Plans, dict[Node, Weight]] | None = None
    noted: dict[int, list[Mismatch]] = field(default_factory=dict)
    exact: bool = True
    before: Level | None = None
    moves: dict[int, Moves] = field(default_factory=dict)
    begun: Mapping[int, list[Move]] = field(default_factory=dict)
    ends: list[Ended] | None = None  # made when asked for
    sums: dict[Plans, float] = field(default_factory=dict)  # of all weights; made with these


class Levels(Kernel[Level]):
    """Counts for up to so many goals at once, whose plans may have any shape. ``budget`` is how many nodes are kept."""

    asks = True

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
        budget: int | None = None,
        goals: int = 1,
    ) -> None:
        super().__init__(plans, matcher, noise, priors, measure)
        self.goals = goals
        self.budget = budget or {1: MOST_STATES, 2: MOST_PAIRS}.get(goals, MOST_SEARCHED)
        self._charts = [plan.chart for plan in plans]
        self._holders: dict[str, list[tuple[int, list[int]]]] = {}  # by action: plans and their leaves of that name
        self._begin = Level(0, {(): {(0,): 1}})
        self.starts: dict[int, Any] = {}  # by plan that may be pursued at all: its state before anything was seen
        for number, plan in enumerate(plans):
            binding = matcher.initial(number)
            if isinstance(binding, Mismatch):
                self._begin.noted[number] = [binding]
                continue
            self.starts[number] = (*plan.chart.start, binding)
            for action, leaves in positions_of(plan).items():
                self._holders.setdefault(action, []).append((number, leaves))

    def begin(self) -> Level:
        """Nothing is pursued yet."""
        return self._begin

    def advance(self, level: Level, seen: Seen, matcher: Matcher) -> Level:
        """Every node goes on by one observation."""
        after = Level(level.k + 1, defaultdict(dict), exact=level.exact, before=level)
        weights = None if level.weights is None and is_certain(seen) else defaultdict[Plans, dict[Node, Weight]](dict)
        self._ask(level, after, seen, matcher)
        for plans, nodes in level.counts.items():
            begun = list(self._begun(after, plans))
            for node, number in nodes.items():
                for to, following, likelihood in self._steps(after, plans, node, begun):
                    counts = after.counts[to]
                    counts[following] = counts.get(following, 0) + number
                    if weights is not None:
                        before = (number, 1.0, number) if level.weights is None else level.weights[plans][node]
                        weights[to][following] = _joined(weights[to].get(following, (0.0, 0.0, 0)), before, likelihood)
        after.weights = weights
        if sum(map(len, after.counts.values())) > self.budget:
            self._prune(after)
        return after

    def _ask(self, level: Level, after: Level, seen: Seen, matcher: Matcher) -> None:
        """What the observation can be, and with what a goal may have begun."""
        for option, likelihood in options_of(seen):
            for plan, leaves in self._holders.get(option.action, ()):
                if plan not in after.moves:
                    after.moves[plan] = Moves(plan, self._charts[plan], matcher, after.noted)
                after.moves[plan].add(option, likelihood, leaves)
        beginning = sum([len(nodes) for plans, nodes in level.counts.items() if len(plans) < self.goals])
        if beginning or self.several:
            after.begun = {plan: moves[self.starts[plan]] for plan, moves in after.moves.items()}
        room = max(1, 4 * self.budget // max(1, beginning))
        if beginning > 1 and sum(map(len, after.begun.values())) > room:
            after.begun, after.exact = self._likeliest(after.begun, room), False

    def _likeliest(self, begun: Mapping[int, list[Move]], room: int) -> dict[int, list[Move]]:
        """Those that miss least, where there are too many to try with every node."""
        moves = [(plan, move) for plan, found in begun.items() for move in found]
        kept: dict[int, list[Move]] = {}
        for plan, move in sorted(moves, key=lambda found: found[1][1][3])[:room]:
            kept.setdefault(plan, []).append(move)
        return kept

    def _begun(self, after: Level, plans: Plans) -> Iterator[Begun]:
        """What another goal may have begun with."""
        if len(plans) < self.goals:
            taken = {self.labels[plan] for plan in plans}
            for plan, moves in after.begun.items():
                if self.labels[plan] not in taken:
                    at = bisect(plans, plan)
                    yield (*plans[:at], plan, *plans[at:]), at + 1, moves

    def _steps(
        self, after: Level, plans: Plans, node: Node, begun: Iterable[Begun]
    ) -> Iterator[tuple[Plans, Node, float]]:
        """What follows on a node: plans, node, likelihood."""
        if self.noise is not None:
            yield plans, (node[0] + 1, *node[1:]), 1.0
        for at, plan in enumerate(plans, 1):
            if plan in after.moves:
                left, right = node[:at], node[at + 1 :]
                for _, state, likelihood in after.moves[plan][node[at]]:
                    yield plans, (*left, state, *right), likelihood
        for to, at, moves in begun:
            left, right = node[:at], node[at:]
            for _, state, likelihood in moves:
                yield to, (*left, state, *right), likelihood

    def _prune(self, level: Level) -> None:
        """Keep what needs fewest goals, misses and needless observations, then what weighs most.

        The score alone prefers few goals while little was observed, and drops what turns out to be true.
        """

        def promise(end: tuple[Plans, Node]) -> tuple[int, float]:
            plans, node = end
            likelihood = 1.0 if level.weights is None else level.weights[plans][node][1]
            price = len(plans) + node[0] + sum([state[3] for state in node[1:]])
            return -price, self.weight(level.k, plans, node, 0) * likelihood

        kept: dict[Plans, dict[Node, int]] = {}
        nodes = ((plans, node) for plans, found in level.counts.items() for node in found)
        for plans, node in nlargest(self.budget, nodes, key=promise):
            kept.setdefault(plans, {})[node] = level.counts[plans][node]
        level.counts, level.exact = kept, False

    def weight(self, k: int, plans: Plans, node: Node, least: int) -> float:
        """Of an explanation of k observations, all certain, that ends here; 0 where everything is needless.

        ``least`` is how many of the needless observations cost nothing.
        """
        if not plans:
            return 0.0
        size, missed = sum([state[2] for state in node[1:]]), sum([state[3] for state in node[1:]])
        above, below = self.measure(size, k - node[0], missed)
        weight: float = (self.noise or 1.0) ** (node[0] - least) * (above / below)
        for plan in plans:
            weight *= self.priors[plan]
        return weight


def _joined(there: Weight, before: Weight, likelihood: float) -> Weight:
    """The weight of a node that is reached from one more node."""
    total, largest, ties = before
    reached = largest * likelihood
    if reached > there[1]:
        return there[0] + total * likelihood, reached, ties
    return there[0] + total * likelihood, there[1], there[2] + (ties if reached == there[1] else 0)
