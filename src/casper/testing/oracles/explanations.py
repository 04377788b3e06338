"""Explanations by sheer enumeration, from what the shapes mean and nothing else: no charts, no states, no sums.

A plan is spelled out into every row of leaves that it allows. An explanation gives each observation a leaf (or nothing,
where noise is allowed) such that some row has these leaves in the order of the observations, and every optional part
and alternative of the row has one of them; but the smallest alternative of a choice needs none. Of the rows that agree,
the one that misses fewest counts.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, count, product

import networkx as nx

from casper.engine.verification.binding import Binding
from casper.engine.verification.matching import Matcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation
from casper.plans.trees.nodes import Action, Condition, Node, Shape
from casper.plans.trees.plan import Plan

Row = tuple[tuple[int, ...], frozenset[int]]  # leaves in order; the parts that are in it and must be seen


@dataclass(frozen=True)
class Told:
    """An explanation of one plan: a leaf or -1 per observation, and what its score is made of."""

    plan: int
    marks: tuple[int, ...]
    options: tuple[int, ...]  # which of an uncertain observation's options each mark stands for
    binding: Binding
    leaves: int
    observed: int
    missed: int

    @property
    def score(self) -> float:
        return self.observed * (self.leaves - self.missed) / self.leaves**2


def rows(plan: Plan) -> tuple[list[Row], dict[int, set[int]]]:
    """Every row of leaves that the plan allows, and the leaves of each part."""
    leaf_numbers, part_numbers = count(), count()
    parts: dict[int, set[int]] = {}

    def spell(node: Node) -> list[Row]:
        if isinstance(node, Action):
            return [((next(leaf_numbers),), frozenset())]
        if isinstance(node, Condition):  # what it asks is the matcher's
            return [((), frozenset())]
        number = next(part_numbers) if isinstance(node, Shape) and node.kind == "optional" else None
        if isinstance(node, Shape) and node.kind == "choice":
            smallest = min(range(len(node.children)), key=lambda at: size(node.children[at]))
            return [row for at, child in enumerate(node.children) for row in alternative(child, at == smallest)]
        choices = [spell(child) for child in node.children]
        before = {(a, b) for a in range(len(choices)) for b in range(a + 1, len(choices))}
        if isinstance(node, Shape) and node.kind in ("unordered", "steps"):
            before = {(a, b) for a, b in before if nx.has_path(ordered(len(choices), node.order), a, b)}
        found: list[Row] = []
        for choice in product(*choices):
            inside = frozenset().union(*(included for _, included in choice))
            found.extend((leaves, inside) for leaves in merged([leaves for leaves, _ in choice], before))
        if number is None:
            return found
        parts[number] = {leaf for leaves, _ in found for leaf in leaves}
        return [*((leaves, inside | {number}) for leaves, inside in found), ((), frozenset())]

    def alternative(child: Node, is_smallest: bool) -> list[Row]:
        number, found = next(part_numbers), spell(child)
        parts[number] = {leaf for leaves, _ in found for leaf in leaves}
        return found if is_smallest else [(leaves, inside | {number}) for leaves, inside in found]

    return spell(plan.root), parts


def size(node: Node) -> int:
    """How many leaves are done at least."""
    if isinstance(node, Action):
        return 1
    if isinstance(node, Condition):
        return 0
    kind = node.kind if isinstance(node, Shape) else "sequence"
    sizes = [size(child) for child in node.children]
    return 0 if kind == "optional" else min(sizes) if kind == "choice" else sum(sizes)


def ordered(items: int, pairs: Iterable[tuple[int, int]]) -> nx.DiGraph:
    """The items of a shape, with an edge from each to those stated to come after it."""
    graph = nx.DiGraph()
    graph.add_nodes_from(range(items))
    graph.add_edges_from(pairs)
    return graph


def merged(parts: list[tuple[int, ...]], before: set[tuple[int, int]]) -> Iterator[tuple[int, ...]]:
    """Every order of all leaves that keeps the order within each part, and the parts that come before others."""
    if not any(parts):
        yield ()
    for at, part in enumerate(parts):
        if part and not any(parts[earlier] for earlier, later in before if later == at):
            for rest in merged([*parts[:at], part[1:], *parts[at + 1 :]], before):
                yield (part[0], *rest)


def explanations(
    plans: Sequence[Plan], observations: Sequence[Sequence[tuple[Observation, float]]], matcher: Matcher, noise: bool
) -> list[Told]:
    """Every explanation that marks at least one leaf; an observation is a row of options with likelihoods."""
    return list(chain.from_iterable(of_plan(n, p, observations, matcher, noise) for n, p in enumerate(plans)))


def of_plan(
    number: int,
    plan: Plan,
    observations: Sequence[Sequence[tuple[Observation, float]]],
    matcher: Matcher,
    noise: bool,
) -> Iterator[Told]:
    """The explanations by one plan (arguments: `explanations`, and the plan's number)."""
    allowed, parts = rows(plan)
    best: dict[tuple[tuple[int, ...], tuple[int, ...]], Told] = {}
    for leaves, inside in dict.fromkeys(allowed):
        for marks, options, binding in markings(number, plan, leaves, observations, matcher, noise):
            marked = [leaf for leaf in marks if leaf >= 0]
            if not marked or any(not parts[part] & set(marked) for part in inside):
                continue
            missed = leaves.index(marked[-1]) + 1 - len(marked)
            told = Told(number, marks, options, binding, len(leaves), len(marked), missed)
            key = (marks, options)
            if key not in best or best[key].missed > missed:
                best[key] = told
    yield from best.values()


def markings(
    number: int,
    plan: Plan,
    leaves: tuple[int, ...],
    observations: Sequence[Sequence[tuple[Observation, float]]],
    matcher: Matcher,
    noise: bool,
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...], Binding]]:
    """Every way to give the observations leaves of the row from left to right."""
    initial = matcher.initial(number)
    if isinstance(initial, Mismatch):
        return

    def go(
        at: int, past: int, marks: tuple[int, ...], options: tuple[int, ...], binding: Binding
    ) -> Iterator[tuple[tuple[int, ...], tuple[int, ...], Binding]]:
        if at == len(observations):
            yield marks, options, binding
            return
        if noise:
            yield from go(at + 1, past, (*marks, -1), (*options, 0), binding)
        for place in range(past, len(leaves)):
            leaf = leaves[place]
            for option, (observation, _) in enumerate(observations[at]):
                if plan.leaves[leaf].functor == observation.action:
                    after = matcher.match(number, leaf, observation, binding)
                    if not isinstance(after, Mismatch):
                        yield from go(at + 1, place + 1, (*marks, leaf), (*options, option), after)

    yield from go(0, 0, (), (), initial)
