"""Random plan libraries for the benchmarks: the same seed gives the same."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from itertools import combinations, count, cycle
from typing import Literal, TypeAlias

from casper.kb.terms.terms import Compound, Variable
from casper.plans.library import PlanLibrary
from casper.plans.trees.nodes import Action, Shape, Task
from casper.plans.trees.plan import Plan

THINGS = ("cup", "pot", "pan", "jar", "tray", "bowl")
PARAMETERS = (Variable("X"), Variable("Y"))
Order: TypeAlias = Literal["ordered", "partly", "unordered"]


def chains(goals: int, leaves: int, symbols: int, seed: int = 0) -> list[Plan]:
    """Goals of so many leaves each, drawn evenly from so many action names."""
    chance = random.Random(seed)
    actions = [Action(Compound((f"a{n}",))) for n in range(symbols)]
    return [
        Plan(f"g{n}", Task(Compound((f"g{n}",)), tuple(chance.choices(actions, k=leaves)))) for n in range(goals)
    ]


def with_parameters(goals: int, leaves: int, symbols: int, seed: int = 0) -> list[Plan]:
    """As `chains`; each goal has two parameters, and each action one of them and a thing."""
    chance = random.Random(seed)
    return [
        Plan(f"g{n}", Task(Compound((f"g{n}", *PARAMETERS)), tuple(_action(symbols, chance) for _ in range(leaves))))
        for n in range(goals)
    ]


def partly_ordered(goals: int, symbols: int, seed: int = 0) -> list[Plan]:
    """Goals of 5 to 17 partly ordered steps with two parameters each, about two pairs of the order a step."""
    chance, plans = random.Random(seed), []
    for number in range(goals):
        steps = tuple(_action(symbols, chance) for _ in range(chance.randint(5, 17)))
        pairs = frozenset(pair for pair in combinations(range(len(steps)), 2) if chance.random() < 2 / len(steps))
        plans.append(Plan(f"g{number}", Task(Compound((f"g{number}", *PARAMETERS)), (Shape("steps", steps, pairs),))))
    return plans


def strands(goals: int, rows: int, leaves: int, symbols: int, seed: int = 0) -> list[Plan]:
    """Goals of so many rows of steps that interleave, with two parameters each: several pots on the hobs."""
    chance, plans = random.Random(seed), []
    for number in range(goals):
        made = [Shape("sequence", tuple(_action(symbols, chance) for _ in range(leaves))) for _ in range(rows)]
        shape = Shape("unordered", tuple(made))
        plans.append(Plan(f"g{number}", Task(Compound((f"g{number}", *PARAMETERS)), (shape,))))
    return plans


def _action(symbols: int, chance: random.Random) -> Action:
    return Action(Compound((f"a{chance.randrange(symbols)}", chance.choice(PARAMETERS), chance.choice(THINGS[:3]))))


def choices(tasks: int, alternatives: int, symbols: int, seed: int = 0) -> Plan:
    """One goal of so many tasks, each done by any one of so many different actions."""
    chance = random.Random(seed)
    actions = [Action(Compound((f"a{n}",))) for n in range(symbols)]
    made = tuple(Shape("choice", tuple(chance.sample(actions, alternatives))) for _ in range(tasks))
    return Plan("g", Task(Compound(("g",)), made))


class AndOr:
    """Libraries of and/or trees in the manner of the PHATT literature, as text.

    A goal is done by all of its tasks, a task by any one of its alternatives, and each of these by all of its tasks in
    turn, down to actions. By default there are 5 goals and 245 productions.

    Args:
        goals: how many.
        widths: for each level how many children its AND nodes have, taken in turn; the last level's are actions.
        alternatives: how many children each OR node has.
        symbols: how many action names the leaves are drawn from.
        order: whether the children of an AND node follow one another, or each pair with a chance of a half, or no pair.
    """

    def __init__(
        self,
        goals: int = 5,
        widths: Sequence[Sequence[int]] = ((3,), (3, 4), (2, 3)),
        alternatives: int = 2,
        symbols: int = 100,
        order: Order = "partly",
        seed: int = 0,
    ) -> None:
        self.alternatives, self.symbols, self.order = alternatives, symbols, order
        self.chance, self.tasks = random.Random(seed), count()
        self.widths = [cycle(level) for level in widths]
        stated = [f"goal(g{number})." for number in range(goals)]
        made = [line for number in range(goals) for line in self._production(f"g{number}", 0)]
        self.text = "\n".join([*stated, *made])

    def library(self) -> PlanLibrary:
        """The text as a library."""
        return PlanLibrary.from_text(self.text)

    def _production(self, head: str, level: int) -> Iterator[str]:
        """A production, and those of all tasks in it."""
        width, is_last = next(self.widths[level]), level == len(self.widths) - 1
        if is_last:
            yield f"{head} --> {self._all_of([f'a{self.chance.randrange(self.symbols)}' for _ in range(width)])}."
            return
        tasks = [f"t{next(self.tasks)}" for _ in range(width)]
        yield f"{head} --> {self._all_of(tasks)}."
        for task in tasks:
            for _ in range(self.alternatives):
                yield from self._production(task, level + 1)

    def _all_of(self, items: Sequence[str]) -> str:
        if self.order == "ordered":
            return ", ".join(items)
        if self.order == "unordered":
            return f"unordered({', '.join(items)})"
        labelled = ", ".join(f"i{at}: {item}" for at, item in enumerate(items))
        pairs = [pair for pair in combinations(range(len(items)), 2) if self.chance.random() < 0.5]
        return f"steps([{labelled}], [{', '.join(f'i{a} < i{b}' for a, b in pairs)}])"
