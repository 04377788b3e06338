"""The counting engine: Algorithm 1 without copying a tree.

Marking a leaf turns every unobserved leaf on its left into missed for good, so the explanations of a plan are the
strictly increasing tuples of leaves that spell the observations. Per plan and observation a level counts them by
(last marked leaf, binding):

    C_1[j] = [leaf j can be o_1]        C_k[j] = [leaf j can be o_k] * sum of C_{k-1}[i] over i < j

The score depends on (n, k, j) only, so counts, posteriors, the best explanation and a best-first stream of all of
them follow without enumerating any (shared facts: section "Algorithm 1, and how to do it without enumerating").
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.engine.matching import Binding, Matcher, Mismatch
from casper.engine.observation import Observation
from casper.engine.scoring import numerator, score
from casper.plans.plan import Plan

State: TypeAlias = tuple[int, Binding]  # the last marked leaf (-1: none yet), what is known of the parameters
Level: TypeAlias = dict[State, int]  # how many explanations end in each state
Edges: TypeAlias = dict[State, Binding]  # (leaf, binding before) -> binding after: what was matched at one observation
Path: TypeAlias = tuple[tuple[int, ...], Binding]  # marked leaves from left to right, and the final binding


@dataclass(frozen=True, slots=True)
class Group:
    """All explanations of one plan that end in one leaf: they share their score and their frontier."""

    plan: int
    last: int
    count: int
    score: float


@dataclass
class Counting:
    """Counts for a library, observation by observation; ``undo`` takes the last one back.

    ``levels[k][p]`` is plan p's level after k observations.
    """

    plans: Sequence[Plan]
    matcher: Matcher
    observations: list[Observation] = field(default_factory=list)
    levels: list[list[Level]] = field(init=False)
    mismatches: dict[int, dict[str, None]] = field(init=False)  # by plan: why it was cut at the last observation

    def __post_init__(self) -> None:
        self._positions = [_positions(plan) for plan in self.plans]
        self.mismatches = {}
        self.levels = [[self._initial(plan) for plan in range(len(self.plans))]]
        self._edges: list[list[Edges]] = []

    def _initial(self, plan: int) -> Level:
        binding = self.matcher.initial(plan)
        if isinstance(binding, Mismatch):
            self._note(plan, binding)
            return {}
        return {(-1, binding): 1}

    def observe(self, observation: Observation) -> None:
        """Advance every plan by one observation."""
        self.mismatches = {}
        before = self.levels[-1]
        steps = [self._advance(plan, before[plan], observation) for plan in range(len(self.plans))]
        self.levels.append([level for level, _ in steps])
        self._edges.append([edges for _, edges in steps])
        self.observations.append(observation)
        self.matcher.observed(observation)

    def undo(self) -> None:
        """Take back the last observation."""
        self.levels.pop()
        self._edges.pop()
        self.observations.pop()
        self.matcher.forget()
        self.mismatches = {}

    def _advance(self, plan: int, level: Level, observation: Observation) -> tuple[Level, Edges]:
        positions = self._positions[plan].get(observation.action)
        if not level or positions is None:
            return {}, {}
        states = sorted(level.items(), key=lambda item: item[0][0])
        passed: defaultdict[Binding, int] = defaultdict(int)  # sum of counts over the leaves left of this one
        at, advanced, edges = 0, defaultdict[State, int](int), {}
        for leaf in positions:
            while at < len(states) and states[at][0][0] < leaf:
                (_, binding), count = states[at]
                passed[binding] += count
                at += 1
            for binding, count in passed.items():
                matched = self.matcher.match(plan, leaf, observation, binding)
                if isinstance(matched, Mismatch):
                    self._note(plan, matched)
                else:
                    edges[leaf, binding] = matched
                    advanced[leaf, matched] += count
        return dict(advanced), edges

    def _note(self, plan: int, mismatch: Mismatch) -> None:
        self.mismatches.setdefault(plan, {}).update(dict.fromkeys(mismatch.reasons))

    # --- what the counts say ---------------------------------------------------------------------------------------

    @property
    def explained(self) -> int:
        """How many observations were taken in."""
        return len(self.observations)

    def groups(self) -> list[Group]:
        """The groups of explanations, best first; equal scores in the order of the library."""
        found = []
        for number, level in enumerate(self.levels[-1]):
            leaves, counts = len(self.plans[number].leaves), defaultdict[int, int](int)
            for (last, _), count in level.items():
                counts[last] += count
            found += [Group(number, j, c, score(leaves, self.explained, j)) for j, c in counts.items()]
        return sorted(found, key=lambda g: (-g.score, g.plan, g.last))

    @property
    def count(self) -> int:
        """The exact number of explanations; before the first observation, of plans."""
        return sum(sum(level.values()) for level in self.levels[-1])

    def score_sums(self) -> list[float]:
        """Per plan the sum of the scores of its explanations."""
        sums = []
        for plan, level in zip(self.plans, self.levels[-1]):
            leaves = len(plan.leaves)
            total = sum(count * numerator(leaves, self.explained, last) for (last, _), count in level.items())
            sums.append(total / (leaves * leaves))
        return sums

    def stream(self) -> Iterator[tuple[Group, Path]]:
        """Every explanation, best first, lazily: by score, then plan, then marked leaves."""
        for group in self.groups():
            for path in self._paths(group.plan, group.last):
                yield group, path

    def _paths(self, plan: int, last: int) -> Iterator[Path]:
        """The explanations of one group in the order of their marked leaves, walked through the kept levels."""
        levels = [level[plan] for level in self.levels]
        if self.explained == 0:
            yield from (((), binding) for _, binding in levels[0])
            return
        alive = self._reaching(plan, last)

        def walk(k: int, state: State, marks: tuple[int, ...]) -> Iterator[Path]:
            if k == self.explained:
                yield marks, state[1]
                return
            for following in sorted(self._successors(plan, k, state) & alive[k + 1].keys(), key=lambda s: s[0]):
                yield from walk(k + 1, following, (*marks, following[0]))

        for state in alive[0]:
            yield from walk(0, state, ())

    def _reaching(self, plan: int, last: int) -> list[dict[State, None]]:
        """Per level the states from which some explanation of the group can be completed."""
        final = [state for state in self.levels[-1][plan] if state[0] == last]
        alive = [dict.fromkeys(final)]
        for k in range(self.explained - 1, -1, -1):
            following = alive[0].keys()
            alive.insert(0, {s: None for s in self.levels[k][plan] if self._successors(plan, k, s) & following})
        return alive

    def _successors(self, plan: int, k: int, state: State) -> set[State]:
        """The states of level k + 1 that follow from a state of level k."""
        last, binding = state
        edges = self._edges[k][plan].items()
        return {(leaf, after) for (leaf, before), after in edges if leaf > last and before == binding}


def _positions(plan: Plan) -> dict[str, list[int]]:
    """The leaves of each action name, from left to right."""
    positions: dict[str, list[int]] = {}
    for at, leaf in enumerate(plan.leaves):
        positions.setdefault(leaf.functor, []).append(at)
    return positions


def posterior_by(labels: Iterable[str], sums: Sequence[float]) -> dict[str, float]:
    """Each label's share of the sum of scores; all zero when nothing explains the observations."""
    totals: dict[str, float] = {}
    for label, part in zip(labels, sums):
        totals[label] = totals.get(label, 0.0) + part
    whole = sum(totals.values())
    return {label: total / whole if whole else 0.0 for label, total in totals.items()}
