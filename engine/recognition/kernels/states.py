"""States of a plan under observation, and how one observation leads from states to states (pure functions)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

from casper.engine.recognition.kernels.kernel import NEEDLESS
from casper.engine.verification.matching import Binding
from casper.engine.verification.observation import Seen, options_of
from casper.plans.trees.chart import Chart
from casper.plans.trees.plan import Plan

State: TypeAlias = tuple[int, int, int, int, int, Binding]
"""Closed leaves, open parts that were entered, leaves of the plan, missed, needless observations, binding."""
Counts: TypeAlias = dict[State, int]  # how many explanations end in each state
Edge: TypeAlias = tuple[int, Binding, float]  # leaf, binding after, likelihood
Edges: TypeAlias = dict[Binding, list[Edge]]  # by binding before: what was matched at one observation
Weight: TypeAlias = tuple[float, float, int]
"""Of a state's paths: the sum and the largest of their likelihoods, and how many are as large."""


def start(chart: Chart, binding: Binding) -> State:
    """Nothing was observed yet."""
    return (*chart.start, 0, binding)


def successors(chart: Chart, state: State, edges: Edges, noisy: bool) -> Iterator[tuple[int, State, float]]:
    """The states that one observation leads to, each with the leaf it was taken for and its likelihood."""
    closed, entered, size, missed, needless, binding = state
    if noisy:
        yield NEEDLESS, (closed, entered, size, missed, needless + 1, binding), 1.0
    for leaf, after, likelihood in edges.get(binding, ()):
        if not closed >> leaf & 1:
            yield leaf, (*chart.close((closed, entered, size, missed), leaf), needless, after), likelihood


def advance(chart: Chart, counts: Counts, edges: Edges, noisy: bool) -> Counts:
    """The next counts. A chain of leaves takes one pass from left to right, other charts look at every state."""
    advanced: Counts = {}
    if chart.is_chain:
        if noisy:
            advanced = {(c, e, n, m, needless + 1, b): count for (c, e, n, m, needless, b), count in counts.items()}
        return _along(chart.leaves, counts, edges, advanced)
    for state, count in counts.items():
        for _, following, _ in successors(chart, state, edges, noisy):
            advanced[following] = advanced.get(following, 0) + count
    return advanced


def _along(leaves: int, counts: Counts, edges: Edges, advanced: Counts) -> Counts:
    """Sums from left to right: what may be marked at leaf j is all that was marked before it."""
    states = sorted(counts.items(), key=lambda item: item[0][0])
    passed: dict[Binding, dict[tuple[int, int], int]] = {}  # by binding: counts by (observed, needless)
    moves = sorted(((leaf, before, after) for before, found in edges.items() for leaf, after, _ in found), key=_leaf)
    at = 0
    for leaf, before, after in moves:
        while at < len(states) and states[at][0][0] < 1 << leaf:
            (closed, _, _, missed, needless, binding), count = states[at]
            sums = passed.setdefault(binding, {})
            key = (closed.bit_length() - missed, needless)
            sums[key] = sums.get(key, 0) + count
            at += 1
        for (observed, needless), count in passed.get(before, {}).items():
            following = ((2 << leaf) - 1, 0, leaves, leaf - observed, needless, after)
            advanced[following] = advanced.get(following, 0) + count
    return advanced


def _leaf(move: tuple[int, Binding, Binding]) -> int:
    return move[0]


def weigh(
    chart: Chart, counts: Counts, weights: Mapping[State, Weight] | None, edges: Edges, noisy: bool
) -> dict[State, Weight]:
    """The weights of the next counts; None stands for all paths being certain so far."""
    weighed: dict[State, Weight] = {}
    for state, count in counts.items():
        before = weights[state] if weights is not None else (float(count), 1.0, count)
        for _, following, likelihood in successors(chart, state, edges, noisy):
            weighed[following] = joined(weighed.get(following, (0.0, 0.0, 0)), before, likelihood)
    return weighed


def joined(there: Weight, before: Weight, likelihood: float) -> Weight:
    """The weight of a state that is reached from one more state."""
    total, largest, ties = before
    reached = largest * likelihood
    if reached > there[1]:
        return there[0] + total * likelihood, reached, ties
    return there[0] + total * likelihood, there[1], there[2] + (ties if reached == there[1] else 0)


def is_certain(seen: Seen) -> bool:
    """Whether it was made out what was done."""
    options = options_of(seen)
    return len(options) == 1 and options[0][1] == 1.0


def positions_of(plan: Plan) -> dict[str, list[int]]:
    """The leaves of each action name, from left to right."""
    positions: dict[str, list[int]] = {}
    for at, leaf in enumerate(plan.leaves):
        positions.setdefault(leaf.functor, []).append(at)
    return positions


def split(marks: Iterable[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Marks as the leaves that were marked, and the numbers of the observations that are needless."""
    marks = tuple(marks)
    leaves = tuple([leaf for leaf in marks if leaf != NEEDLESS])
    return leaves, tuple([at for at, leaf in enumerate(marks) if leaf == NEEDLESS])
