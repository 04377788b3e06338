"""Figures of plans with alternatives and partial orders, one goal at a time, against the plain baseline."""

from __future__ import annotations

import random
from math import prod

from comparison import compared
from episodes import blurred, carried_out
from libraries import AndOr, Order, choices, strands

from casper.engine.recognition.options import PAPER
from casper.engine.verification.matching import NameMatcher, ParameterMatcher
from casper.plans.trees.nodes import Action, Node, Shape

AND_OR: tuple[tuple[Order, int, float | None], ...] = (  # order, action names, bound in ms
    ("ordered", 100, 10),
    ("ordered", 10, None),
    ("partly", 100, 10),
    ("partly", 20, None),
    ("partly", 10, None),
    ("unordered", 100, 10),
    ("unordered", 20, None),
    ("unordered", 10, None),
)


def and_or(quick: bool) -> None:
    """And/or libraries of 5 goals and 245 productions, nine observations of one goal."""
    for order, symbols, bound in AND_OR:
        if quick and symbols <= 20:
            continue
        library, chance = AndOr(symbols=symbols, order=order).library(), random.Random(0)
        plans = library.ways
        is_hard = (order, symbols) == ("unordered", 10)  # for the baseline, which takes long before it gives up
        episodes = [carried_out(plan, chance)[:9] for plan in chance.sample(plans, 1 if is_hard else 5)]
        what = f"and/or, 5 goals, {len(library.productions)} productions, {order}, {symbols} names"
        compared(what, plans, NameMatcher(plans), PAPER, episodes, bound)


def many_ways() -> None:
    """A plan of 17 choices of 3: 129 million ways."""
    plan, chance = choices(17, 3, 10), random.Random(0)
    episodes = [carried_out(plan, chance, missing=0.5)[:8] for _ in range(5)]
    what = f"17 choices of 3: {ways(plan.root):,} ways, 10 names, 8 observations"
    compared(what, [plan], NameMatcher([plan]), PAPER, episodes, 10)


def ways(node: Node) -> int:
    """In how many ways the choices below a node can be decided."""
    if isinstance(node, Action):
        return 1
    is_choice = isinstance(node, Shape) and node.kind == "choice"
    return (sum if is_choice else prod)(map(ways, node.children))


def two_strands() -> None:
    """Goals of two rows of steps that interleave, with parameters; only names are seen."""
    plans, chance = strands(10, 2, 12, 4), random.Random(0)
    episodes = [blurred(carried_out(plan, chance, missing=0.4)[:12]) for plan in chance.sample(plans, 3)]
    what, matcher = "10 goals of two interleaving rows of 12, 4 names", ParameterMatcher(plans)
    compared(f"{what}, 8 observations", plans, matcher, PAPER, [seen[:8] for seen in episodes])
    compared(f"{what}, 12 observations", plans, matcher, PAPER, episodes[:1])


def figures(quick: bool) -> None:
    """Tell them all."""
    and_or(quick)
    many_ways()
    two_strands()
