"""The counting kernel: Algorithm 1 without copying a tree, with all its extensions.

Marking a leaf closes every leaf that the plan puts before it; those unobserved are missed for good. So the
explanations of a plan are the ways to give the observations leaves that are open then, and all that the rest depends
on is its *state*: what is closed, which open parts were entered, how many leaves the plan has by now, how many it
missed, and what is known of the parameters. Where several goals may be pursued at once, an explanation is a set of up
to N different goals, a plan for each, and a leaf of one of them for every observation; each has at least one, and
observed and missed leaves of all of them add up. So what is to come depends on the *node* only, the plans pursued with
the state of each, and how many observations were needless. A level counts the explanations that end in each:

    C_k[s'] = sum of C_{k-1}[s] over the nodes s from which observation k leads to s'

The score depends on the node only, so exact counts, posteriors, the best explanation, ties and a best-first stream
follow without enumerating any. ``docs/recognition.md`` says what every extension means; `tree_copying` is the
specification of the plain case, brute force that of the others (tests).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from math import prod
from typing import TypeAlias

from casper.engine.recognition.kernels.kernel import NEEDLESS, Leading, Parts, Path, Plans, best_of
from casper.engine.recognition.kernels.levels import Ended, Level, Levels, Node
from casper.engine.recognition.kernels.paths import best_first
from casper.engine.recognition.scoring import Score, paper
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.plans.trees.plan import Plan

End: TypeAlias = tuple[Plans, Node]
Mark: TypeAlias = tuple[int, int]  # plan and leaf; (NEEDLESS, NEEDLESS)


class Counting(Levels):
    """What the counts of some plans say, whose shapes may be anything (arguments: `levels.Levels`)."""

    def count(self, level: Level) -> int:
        if not level.k:
            return len(self.starts)
        return sum([sum(nodes.values()) for plans, nodes in level.counts.items() if plans])

    def alive(self, level: Level) -> set[int]:
        return {plan for plans in level.counts for plan in plans} if level.k else set(self.starts)

    def least(self, level: Level) -> int:
        if self.noise is None:
            return 0
        return min((node[0] for plans, nodes in level.counts.items() if plans for node in nodes), default=0)

    def weighed(self, level: Level) -> list[Ended]:
        """What ends in each node; and the sums of all weights, on the way."""
        if level.ends is None:
            least, ends = self.least(level), list[Ended]()
            level.sums = {plans: self._summed(level, plans, least, ends) for plans in level.counts if plans}
            level.ends = ends
        return level.ends

    def _summed(self, level: Level, plans: Plans, least: int, ends: list[Ended]) -> float:
        """The sum of the weights of what these plans explain, each end written down.

        The scores of equal denominators are summed as integers: so sums are exact unless weighed.
        """
        k, measure, price, prior = level.k, self.measure, self.noise or 1.0, prod([self.priors[p] for p in plans])
        exact: dict[tuple[int, int], float] = {}  # by denominator and needless observations
        for node, number in level.counts[plans].items():
            needless, size, missed = node[0], 0, 0
            for state in node[1:]:
                size += state[2]
                missed += state[3]
            above, below = measure(size, k - needless, missed)
            score = above / below if needless == least else price ** (needless - least) * (above / below)
            mass, largest, ties = (number, 1.0, number) if level.weights is None else level.weights[plans][node]
            ends.append((prior * score * largest, plans, missed, ties, node))
            exact[below, needless] = exact.get((below, needless), 0) + mass * above
        return prior * sum([total / below * price ** (needless - least) for (below, needless), total in exact.items()])

    def masses(self, level: Level) -> list[float]:
        self.weighed(level)
        found = [0.0] * len(self.plans)
        for plans, mass in level.sums.items():
            for plan in plans:
                found[plan] += mass
        return found

    def total(self, level: Level) -> float:
        self.weighed(level)
        return sum(level.sums.values())

    def leading(self, level: Level) -> Leading | None:
        return self.leading_of([end[:4] for end in best_of(self.weighed(level))])

    def tops(self, level: Level) -> list[tuple[float, Plans]]:
        return [end[:2] for end in self.weighed(level)]

    def ends(self, level: Level) -> Iterator[tuple[Parts, float]]:
        for weight, plans, _, number, node in sorted(self.weighed(level), key=_rank):
            mass, largest, _ = (number, 1.0, number) if level.weights is None else level.weights[plans][node]
            parts = tuple([(plan, state[0], state[4]) for plan, state in zip(plans, node[1:])])
            yield parts, weight / largest * mass if largest else 0.0

    def mismatches(self, level: Level) -> Mapping[int, Sequence[Mismatch]]:
        return level.noted

    def is_exact(self, level: Level) -> bool:
        return level.exact

    def paths(self, level: Level, plans: Plans) -> Iterator[Path]:
        """The explanations of exactly these plans, best first, lazily; equal ones in the order of their marks."""
        levels, least = [level], self.least(level)
        while levels[-1].before is not None:
            levels.append(levels[-1].before)
        levels.reverse()
        finals = {(plans, node): self.weight(level.k, plans, node, least) for node in level.counts.get(plans, ())}
        certain = level.weights is None  # then all that ends in a node weighs alike: the best nodes come first, alone
        for _, ends in groupby(sorted(finals, key=lambda end: -finals[end]), lambda end: certain and finals[end]):
            some = {end: finals[end] for end in ends}
            steps = best_first(some, lambda at, end: self._back(levels[at - 1], levels[at], *end), level.k)
            for weight, marks, end in steps:
                yield _path(*end, marks, 1.0 if certain else weight / (finals[end] or 1.0))

    def _back(self, before: Level, level: Level, plans: Plans, node: Node) -> Iterator[tuple[End, Mark, float]]:
        """What led to a node: the node before, the mark and its likelihood."""
        same = before.counts.get(plans, {})
        if self.noise is not None and (earlier := (node[0] - 1, *node[1:])) in same:
            yield (plans, earlier), (NEEDLESS, NEEDLESS), 1.0
        for at, plan in enumerate(plans, 1):
            steps = level.moves[plan].back().get(node[at], ()) if plan in level.moves else ()
            for state, leaf, likelihood in steps:
                if state[0]:
                    if (earlier := (*node[:at], state, *node[at + 1 :])) in same:
                        yield (plans, earlier), (plan, leaf), likelihood
                elif (leaf, node[at], likelihood) in level.begun.get(plan, ()):  # nothing was closed before
                    others, earlier = plans[: at - 1] + plans[at:], node[:at] + node[at + 1 :]
                    if earlier in before.counts.get(others, {}):
                        yield (others, earlier), (plan, leaf), likelihood


class Interleaving(Counting):
    """Counts explanations of up to so many goals at once: every observation is a step of one of those pursued.

    For two goals all nodes are kept, and everything is exact; for more, and where even those of two are too many, it is
    a best-first search that says so.
    """

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


def _rank(end: Ended) -> tuple[float, Plans, list[int]]:
    """Best first, then in the order of the library, and of the leaves."""
    weight, plans, _, _, node = end
    return -weight, plans, [state[0] for state in node[1:]]


def _path(plans: Plans, node: Node, marks: tuple[Mark, ...], likelihood: float) -> Path:
    states = node[1:]
    told = tuple([(plan, tuple([leaf for p, leaf in marks if p == plan]), s[4]) for plan, s in zip(plans, states)])
    needless = tuple([at for at, (plan, _) in enumerate(marks) if plan == NEEDLESS])
    return Path(told, needless, sum(s[2] for s in states), sum(s[3] for s in states), likelihood)
