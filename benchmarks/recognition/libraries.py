"""Random plan libraries and episodes for the benchmarks: the same seed gives the same."""

from __future__ import annotations

import random

from casper.engine.observation import Observation
from casper.kb.terms import Compound, Variable
from casper.plans.plan import Action, Plan, Shape, Task

THINGS = ("cup", "pot", "pan", "jar", "tray", "bowl")


def chains(goals: int, leaves: int, symbols: int, seed: int = 0) -> list[Plan]:
    """Goals of so many leaves each, drawn evenly from so many action names."""
    chance = random.Random(seed)
    actions = [Action(Compound((f"a{n}",))) for n in range(symbols)]
    return [
        Plan(f"g{n}", Task(Compound((f"g{n}",)), tuple(chance.choices(actions, k=leaves)))) for n in range(goals)
    ]


def episode(plans: list[Plan], length: int, chance: random.Random, together: int = 1) -> list[Observation]:
    """What is seen of some of the plans, interleaved: so many of each one's actions, in order."""
    rows = []
    for plan in chance.sample(plans, together):
        seen = sorted(chance.sample(range(len(plan.leaves)), min(length, len(plan.leaves))))
        rows.append([Observation(plan.leaves[at].functor) for at in seen])
    return interleaved(rows, chance)


def interleaved(rows: list[list[Observation]], chance: random.Random) -> list[Observation]:
    """The rows shuffled into one another."""
    rows, seen = [list(row) for row in rows], []
    while any(rows):
        seen.append(chance.choice([row for row in rows if row]).pop(0))
    return seen


def partly_ordered(goals: int, names: int, chance: random.Random) -> list[Plan]:
    """Goals of 5 to 17 partly ordered steps with two parameters each, about two pairs of the order a step."""
    plans = []
    for number in range(goals):
        parameters = (Variable("X"), Variable("Y"))
        count = chance.randint(5, 17)
        steps = tuple(
            Action(Compound((f"a{chance.randrange(names)}", chance.choice(parameters), chance.choice(THINGS[:3]))))
            for _ in range(count)
        )
        pairs = [(a, b) for a in range(count) for b in range(a + 1, count) if chance.random() < 2 / count]
        shape = Shape("steps", steps, frozenset(pairs))
        plans.append(Plan(f"g{number}", Task(Compound((f"g{number}", *parameters)), (shape,))))
    return plans


def carried_out(plan: Plan, chance: random.Random, missing: float = 0.1) -> list[Observation]:
    """One order that a partly ordered plan allows, with its parameters settled, and some steps unseen."""
    values = {parameter: chance.choice(THINGS) for parameter in plan.variables}
    (shape,) = plan.root.children
    assert isinstance(shape, Shape)
    waiting, seen = set(range(len(plan.leaves))), []
    while waiting:
        ready = [step for step in sorted(waiting) if not any(b == step and a in waiting for a, b in shape.order)]
        step = chance.choice(ready)
        waiting.remove(step)
        if chance.random() >= missing:
            leaf = plan.leaves[step]
            seen.append(Observation(leaf.functor, tuple(values.get(arg, arg) for arg in leaf.args)))
    return seen
