"""The counting engine: Algorithm 1 without copying a tree, with all its extensions.

Marking a leaf closes every leaf that the plan puts before it; those unobserved are missed for good. So the
explanations of a plan are the ways to give the observations leaves that are open then, and all that the rest depends
on is a *state*: what is closed, which open parts were entered, how many leaves the plan has by now, how many
it missed, how many observations were needless, and what is known of the parameters. Per plan and observation a level
counts the explanations that end in each state:

    C_k[s'] = sum of C_{k-1}[s] over the states s from which observation k leads to s'

For a plan whose actions simply follow one another the closed leaves are those up to the last marked one j, and

    C_1[j] = [leaf j can be o_1]        C_k[j] = [leaf j can be o_k] * sum of C_{k-1}[i] over i < j

The score depends on the state only, so exact counts, posteriors, the best explanation, ties and a best-first stream
follow without enumerating any. ``docs/recognition.md`` says what every extension means; `tree_copying` is the
specification of the plain case, brute force that of the others (tests).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from itertools import count, takewhile

from casper.engine.explanation.explanation import Explanation
from casper.engine.recognition.levels import Levels
from casper.engine.recognition.paths import best_first
from casper.engine.recognition.scoring import least_tie
from casper.engine.recognition.standing import Standing
from casper.engine.recognition.states import NEEDLESS, Level, State, successors
from casper.engine.verification.matching import Binding


@dataclass(frozen=True, slots=True)
class Group:
    """All explanations of one plan that end in one state: they share their frontier, and their score.

    ``score`` is that of the best of them (of all, unless actions were uncertain), ``weight`` the score times the
    goal's prior, ``ties`` how many reach it.
    """

    plan: int
    state: State
    count: int
    score: float
    weight: float
    ties: int

    @property
    def missed(self) -> int:
        """How many leaves were missed."""
        return self.state[3]


@dataclass(frozen=True, slots=True)
class Found:
    """One explanation as the engine tells it: a leaf, or `states.NEEDLESS`, for every observation."""

    plan: int
    marks: tuple[int, ...]
    binding: Binding
    score: float
    weight: float


class Counting(Levels):
    """What the counts say. Interface: `recognisers.Recogniser`; arguments: `levels.Levels`."""

    _grouped: tuple[dict[int, Level], list[Group]] | None = None  # the groups of a level

    @property
    def explained(self) -> int:
        """How many observations were taken in."""
        return len(self.observations)

    def alive(self, level: int) -> set[int]:
        """The plans with an explanation of the first so many observations; none may take all of them for needless."""
        return {p for p, states in self.levels[level].items() if any(s[4] < level or not level for s in states)}

    def groups(self) -> list[Group]:
        """The groups of explanations, heaviest first; equal ones in the order of the library."""
        level = self.levels[-1]
        if self._grouped is None or self._grouped[0] is not level:
            least = self._least()
            found = [group for plan in level for group in self._groups_of(plan, least)]
            self._grouped = level, sorted(found, key=lambda g: (-g.weight, g.plan, g.state[0]))
        return self._grouped[1]

    def _groups_of(self, plan: int, least: int) -> Iterator[Group]:
        weights, prior = self._weights[-1], self.priors[plan]
        for state, number in self.levels[-1][plan].items():
            if self._observes(state):
                score, weight, ties = self._score(state, state[4]), self._score(state, state[4] - least), number
                if weights is not None:
                    _, largest, ties = weights[plan][state]
                    score, weight = score * largest, weight * largest
                yield Group(plan, state, number, score, prior * weight, ties)

    def _observes(self, state: State) -> bool:
        """Whether the state's explanations take anything for a leaf, or there was nothing to take."""
        return self.explained > state[4] or not self.explained

    def _score(self, state: State, priced: int) -> float:
        """Of an explanation that ends here, when so many needless observations cost their price."""
        above, below = self.measure(state[2], self.explained - state[4], state[3])
        return above / below if not priced else (self.noise or 1.0) ** priced * (above / below)

    def _least(self) -> int:
        """The fewest needless observations of an explanation: weights leave out the price that all of them pay."""
        if self.noise is None:
            return 0
        states = (state for found in self.levels[-1].values() for state in found)
        return min((state[4] for state in states if self._observes(state)), default=0)

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return sum(group.count for group in self.groups())

    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""
        return self._sums(0)

    def _sums(self, least: int) -> list[float]:
        """Per plan the sum of the scores of its explanations, without the price of so many needless observations."""
        sums = [0.0] * len(self.plans)
        for plan in self.levels[-1]:
            sums[plan] = self._sum(plan, least)
        return sums

    def _sum(self, plan: int, least: int) -> float:
        weights, price = self._weights[-1], self.noise or 1.0
        exact: dict[tuple[int, int], float] = {}  # by (denominator, needless): exact integers, unless weighted
        for state, number in self.levels[-1][plan].items():
            if self._observes(state):
                _, _, size, missed, needless, _ = state
                above, below = self.measure(size, self.explained - needless, missed)
                mass = number if weights is None else weights[plan][state][0]
                exact[below, needless] = exact.get((below, needless), 0) + mass * above
        return sum((total / below) * price ** (needless - least) for (below, needless), total in exact.items())

    def posterior(self) -> dict[str, float]:
        """Each goal's share of the sum of all scores, weighed by its prior."""
        return posterior_by(self.labels, [p * s for p, s in zip(self.priors, self._sums(self._least()))])

    def standing(self) -> Standing | None:
        """The best explanation and its rivals; None when there is none."""
        groups = self.groups()
        if not groups:
            return None
        top, label = groups[0], self.labels[groups[0].plan]
        least = least_tie(top.weight)
        equal = list(takewhile(lambda group: group.weight >= least, groups))
        rivals = sum(group.ties for group in equal if self.labels[group.plan] != label)
        missed = min(group.missed for group in equal if self.labels[group.plan] == label)
        return Standing(self.count, label, missed, rivals, sum(group.ties for group in equal))

    def first(self, goal: str | None = None) -> Explanation | None:
        """The best explanation, of all or of one goal; None when there is none."""
        plans = (group.plan for group in self.groups() if goal is None or self.labels[group.plan] == goal)
        plan = next(plans, None)
        return None if plan is None else self._told(next(self._paths(plan)), self._whole())

    def explanations(self) -> Iterator[Explanation]:
        """Every explanation, best first, lazily, with its share of all scores."""
        whole = self._whole()
        for found in self.stream():
            yield self._told(found, whole)

    def _told(self, found: Found, whole: float) -> Explanation:
        leaves = tuple(leaf for leaf in found.marks if leaf != NEEDLESS)
        needless = tuple(at for at, leaf in enumerate(found.marks) if leaf == NEEDLESS)
        share = found.weight / whole if whole else 0.0
        return Explanation(self.plans[found.plan], leaves, found.binding, found.score, share, needless)

    def _whole(self) -> float:
        """The sum of all weights."""
        least = self._least()
        return sum(self.priors[plan] * self._sum(plan, least) for plan in self.levels[-1])

    def ends(self) -> Iterator[tuple[tuple[tuple[int, int, Binding], ...], float]]:
        """Where explanations end: (plan, mask of closed leaves, binding), and the share of all scores."""
        whole = self._whole()
        for group in self.groups():
            weights = self._weights[-1]
            mass = group.weight * group.count
            if weights is not None:
                total, largest, _ = weights[group.plan][group.state]
                mass = group.weight / largest * total if largest else 0.0
            yield ((group.plan, group.state[0], group.state[5]),), mass / whole if whole else 0.0

    def stream(self) -> Iterator[Found]:
        """Every explanation, best first, lazily: by weight, then plan, then marked leaves."""
        bounds: dict[int, float] = {}
        for group in self.groups():
            bounds.setdefault(group.plan, group.weight)
        order = count()
        heap: list[tuple[float, int, tuple[int, ...], int, Found | None, Iterator[Found]]] = [
            (-bound, plan, (), next(order), None, self._paths(plan)) for plan, bound in bounds.items()
        ]
        heapify(heap)
        while heap:
            _, plan, _, _, found, rest = heappop(heap)
            if found is not None:
                yield found
            following = next(rest, None)
            if following is not None:
                heappush(heap, (-following.weight, plan, following.marks, next(order), following, rest))

    def _paths(self, plan: int) -> Iterator[Found]:
        """The explanations of one plan, best first."""
        prior, k, least = self.priors[plan], self.explained, self._least()
        finals = {s: self._score(s, s[4] - least) for s in self.levels[-1][plan] if self._observes(s)}
        before: dict[int, dict[State, list[tuple[State, int, float]]]] = {}

        def back(level: int, state: State) -> Iterable[tuple[State, int, float]]:
            if level not in before:
                before[level] = self._before(plan, level)
            return before[level][state]

        for weight, marks, state in best_first(finals, back, k):
            likelihood = 1.0 if self._weights[-1] is None else weight / (finals[state] or 1.0)
            yield Found(plan, marks, state[5], self._score(state, state[4]) * likelihood, prior * weight)

    def _before(self, plan: int, level: int) -> dict[State, list[tuple[State, int, float]]]:
        """For every state of a level, what led to it."""
        found: dict[State, list[tuple[State, int, float]]] = {}
        edges = self._edges[level - 1][plan]
        for state in self.levels[level - 1][plan]:
            for mark, following, likelihood in successors(self.charts[plan], state, edges, self.noise is not None):
                found.setdefault(following, []).append((state, mark, likelihood))
        return found


def posterior_by(labels: Iterable[str], sums: Sequence[float]) -> dict[str, float]:
    """Each label's share of the sums; all zero when nothing explains the observations."""
    totals: dict[str, float] = {}
    for label, part in zip(labels, sums):
        totals[label] = totals.get(label, 0.0) + part
    whole = sum(totals.values())
    return {label: total / whole if whole else 0.0 for label, total in totals.items()}
