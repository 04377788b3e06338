"""The counting engine: Algorithm 1 without copying a tree, with all its extensions.

Marking a leaf closes every leaf that the plan puts before it; those unobserved are missed for good. So the explanations
of a plan are the ways to give the observations leaves that are open then, and all that the rest depends on is a *state*:
what is closed, which open optional parts were entered, how many leaves the plan has by now, how many it missed, how many
observations were needless, and what is known of the parameters. Per plan and observation a level counts the
explanations that end in each state:

    C_k[s'] = sum of C_{k-1}[s] over the states s from which observation k leads to s'

For a plan whose actions simply follow one another the closed leaves are those up to the last marked one j, and

    C_1[j] = [leaf j can be o_1]        C_k[j] = [leaf j can be o_k] * sum of C_{k-1}[i] over i < j

The score depends on the state only, so exact counts, posteriors, the best explanation, ties and a best-first stream
follow without enumerating any. `docs/recognition.md` says what every extension means; `engine.tree_copying` is the
specification of the plain case and brute force of the others (tests).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heapify, heappop, heappush
from typing import TypeAlias

from casper.engine.matching import Binding, Matcher, Mismatch
from casper.engine.observation import Seen, options_of
from casper.engine.paths import best_first
from casper.engine.scoring import Score, paper
from casper.plans.chart import Chart, chart_of
from casper.plans.plan import Plan

State: TypeAlias = tuple[int, int, int, int, int, Binding]
"""Closed leaves, entered optional parts, leaves of the plan, missed, needless observations, binding."""
Level: TypeAlias = dict[State, int]  # how many explanations end in each state
Edge: TypeAlias = tuple[int, Binding, float]  # leaf, binding after, likelihood
Edges: TypeAlias = dict[Binding, list[Edge]]  # by binding before: what was matched at one observation
Weight: TypeAlias = tuple[float, float, int]  # sum and largest of the likelihoods of a state's paths; how many are largest
Step: TypeAlias = tuple[State, float]

NEEDLESS = -1  # the mark of an observation that was taken for no leaf


@dataclass(frozen=True, slots=True)
class Group:
    """All explanations of one plan that end in one state: they share their score and their frontier.

    ``score`` is that of the best of them (all of them, unless actions were uncertain), ``weight`` the score times the
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
        """Leaves that were missed."""
        return self.state[3]


@dataclass(frozen=True, slots=True)
class Found:
    """One explanation as the engine tells it: marks has a leaf (or `NEEDLESS`) for every observation."""

    plan: int
    marks: tuple[int, ...]
    binding: Binding
    score: float
    weight: float
    missed: int


class Counting:
    """Counts for some plans, observation by observation; ``undo`` takes the last one back.

    Args:
        plans: the plans; their shapes may be anything.
        matcher: what can be taken for what.
        noise: the factor on a score for each observation that is needless or misread; None allows none.
        priors: per plan the prior of its goal.
        measure: the score.
    """

    def __init__(
        self,
        plans: Sequence[Plan],
        matcher: Matcher,
        noise: float | None = None,
        priors: Sequence[float] | None = None,
        measure: Score = paper,
    ) -> None:
        self.plans, self.matcher, self.noise, self.measure = plans, matcher, noise, measure
        self.priors = priors or (1.0,) * len(plans)
        self.charts = [chart_of(plan) for plan in plans]
        self._positions = [positions_of(plan) for plan in plans]
        self.observations: list[Seen] = []
        self.mismatches: list[dict[int, dict[str, None]]] = [{}]  # after each observation, by plan: why it was cut
        self.levels: list[dict[int, Level]] = [{}]
        self._edges: list[dict[int, Edges]] = []
        self._weights: list[dict[int, dict[State, Weight]] | None] = [None]
        self._groups: list[Group] | None = None
        for plan, chart in enumerate(self.charts):
            binding = matcher.initial(plan)
            if isinstance(binding, Mismatch):
                self._note(plan, binding)
            else:
                self.levels[0][plan] = {(*chart.start, 0, binding): 1}

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, seen: Seen) -> None:
        """Advance every plan by one observation."""
        options = options_of(seen)
        self.mismatches.append({})
        level: dict[int, Level] = {}
        edges: dict[int, Edges] = {}
        for plan, before in self.levels[-1].items():
            matched = self._matched(plan, before, options)
            advanced = self._advanced(plan, before, matched)
            if advanced:
                level[plan], edges[plan] = advanced, matched
        self._weights.append(self._weighed(level, edges, uncertain=options[0][1] != 1.0 or len(options) > 1))
        self.levels.append(level)
        self._edges.append(edges)
        self.observations.append(seen)
        self.matcher.observed(options[0][0], certain=len(options) == 1)
        self._groups = None

    def undo(self) -> None:
        """Take back the last observation."""
        for kept in (self.levels, self._edges, self.observations, self.mismatches, self._weights):
            kept.pop()  # type: ignore[attr-defined]
        self.matcher.forget()
        self._groups = None

    def fork(self) -> Counting:
        """A copy that goes its own way; what was counted so far is shared."""
        other = object.__new__(Counting)
        other.__dict__.update(self.__dict__)
        for name in ("levels", "_edges", "observations", "mismatches", "_weights"):
            setattr(other, name, list(getattr(self, name)))
        other.matcher = self.matcher.fork()
        return other

    def _matched(self, plan: int, level: Level, options: Iterable[tuple[object, float]]) -> Edges:
        """What the observation can be, by what was known before."""
        opened: dict[Binding, int] = {}
        for closed, *_, binding in sorted(level):
            opened[binding] = opened.get(binding, 0) | ~closed
        edges: Edges = {}
        for observation, likelihood in options:
            for leaf in self._positions[plan].get(observation.action, ()):  # type: ignore[attr-defined]
                for binding, mask in opened.items():
                    if not mask >> leaf & 1:
                        continue
                    after = self.matcher.match(plan, leaf, observation, binding)  # type: ignore[arg-type]
                    if isinstance(after, Mismatch):
                        self._note(plan, after)
                    else:
                        edges.setdefault(binding, []).append((leaf, after, likelihood))
        return edges
