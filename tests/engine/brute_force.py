"""Explanations by sheer enumeration, from what the shapes mean and nothing else: no charts, no states, no sums.

A plan is spelled out into every row of leaves that it allows. An explanation gives each observation a leaf (or nothing,
where noise is allowed) such that some row has these leaves in the order of the observations, and every optional part
of the row has one of them. Of the rows that agree, the one that misses fewest counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, count, permutations, product

from casper.engine.matching import Matcher, Mismatch
from casper.engine.observation import Observation
from casper.plans.plan import Action, Node, Plan, Shape

Row = tuple[tuple[int, ...], frozenset[int]]  # leaves in order; the optional parts that are in it


@dataclass(frozen=True)
class Told:
    """An explanation of one plan: a leaf or -1 per observation, and what its score is made of."""

    plan: int
    marks: tuple[int, ...]
    options: tuple[int, ...]  # which of an uncertain observation's options each mark stands for
    binding: tuple
    leaves: int
    observed: int
    missed: int

    @property
    def score(self) -> float:
        return self.observed * (self.leaves - self.missed) / self.leaves**2


def rows(plan: Plan) -> tuple[list[Row], dict[int, set[int]]]:
    """Every row of leaves that the plan allows, and the leaves of each optional part."""
    leaf_numbers, part_numbers = count(), count()
    parts: dict[int, set[int]] = {}

    def spell(node: Node) -> list[Row]:
        if isinstance(node, Action):
            return [((next(leaf_numbers),), frozenset())]
        number = next(part_numbers) if isinstance(node, Shape) and node.kind == "optional" else None
        choices = [spell(child) for child in node.children]
        orders = [tuple(range(len(choices)))]
        if isinstance(node, Shape) and node.kind in ("unordered", "steps"):
            orders = [
                order
                for order in permutations(range(len(choices)))
                if all(order.index(a) < order.index(b) for a, b in node.order)
            ]
        found = []
        for order in orders:
            for choice in product(*(choices[at] for at in order)):
                inside = frozenset().union(*(included for _, included in choice))
                found.append((tuple(chain.from_iterable(leaves for leaves, _ in choice)), inside))
        if number is None:
            return found
        parts[number] = {leaf for leaves, _ in found for leaf in leaves}
        return [*((leaves, inside | {number}) for leaves, inside in found), ((), frozenset())]

    return spell(plan.root), parts


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
    allowed, parts = rows(plan)
    best: dict[tuple, Told] = {}
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


def markings(number, plan, leaves, observations, matcher, noise):
    """Every way to give the observations leaves of the row from left to right."""
    initial = matcher.initial(number)
    if isinstance(initial, Mismatch):
        return

    def go(at: int, past: int, marks: tuple, options: tuple, binding: tuple):
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
