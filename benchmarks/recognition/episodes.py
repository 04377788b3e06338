"""Episodes: what is seen of one goal that is pursued, or of several at once."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence

from libraries import THINGS
from meaning import comes_before

from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound
from casper.plans.trees.nodes import Action, Node, Shape
from casper.plans.trees.plan import Plan


def episode(plans: Sequence[Plan], length: int, chance: random.Random, together: int = 1) -> list[Observation]:
    """What is seen of some of the plans, interleaved: so many of each one's actions, in order. The plans are chains."""
    rows = []
    for plan in chance.sample(plans, together):
        seen = sorted(chance.sample(range(len(plan.leaves)), min(length, len(plan.leaves))))
        rows.append(told(plan, [plan.leaves[at] for at in seen], chance))
    return interleaved(rows, chance)


def carried_out(plan: Plan, chance: random.Random, missing: float = 0.1) -> list[Observation]:
    """One way and order that the plan allows, with its parameters settled, and some steps unseen."""
    return told(plan, [leaf for leaf in row(plan.root, chance) if chance.random() >= missing], chance)


def told(plan: Plan, leaves: Iterable[Compound], chance: random.Random) -> list[Observation]:
    """The leaves as they are seen, each parameter of the plan being some thing."""
    values = {parameter: chance.choice(THINGS) for parameter in plan.variables}
    return [Observation(leaf.functor, tuple(values.get(arg, arg) for arg in leaf.args)) for leaf in leaves]


def blurred(seen: Iterable[Observation]) -> list[Observation]:
    """The same, but only the names of the actions are seen."""
    return [Observation(observation.action) for observation in seen]


def row(node: Node, chance: random.Random) -> list[Compound]:
    """The actions that a node is done by, in an order that it allows."""
    if isinstance(node, Action):
        return [node.term]
    kind = node.kind if isinstance(node, Shape) else "sequence"
    if kind == "choice":
        return row(chance.choice(node.children), chance)
    if kind == "optional" and chance.random() < 0.5:
        return []
    waiting = [row(child, chance) for child in node.children]
    done = []
    while any(waiting):
        left = [at for at, rest in enumerate(waiting) if rest]
        ready = [at for at in left if not any(comes_before(node, other, at) for other in left)]
        done.append(waiting[chance.choice(ready)].pop(0))
    return done


def interleaved(rows: Iterable[Sequence[Observation]], chance: random.Random) -> list[Observation]:
    """The rows shuffled into one another."""
    waiting, seen = [list(row) for row in rows], []
    while any(waiting):
        seen.append(chance.choice([rest for rest in waiting if rest]).pop(0))
    return seen
