"""Kitchens: dishes of verbs, ingredients and containers that share most of their actions; several are cooked at once.

A dish takes one to three ingredients, each through a few steps of its own in order, then heat, then some finish. What
is an ingredient or a container of the dish may be a parameter that only a later action settles. No two dishes have the
same verbs equally often. Everything is drawn from a seed; nothing here knows of any recogniser.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass

from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Term, Variable
from casper.plans.library import PlanLibrary
from casper.plans.trees.nodes import Action, Node, Shape
from casper.plans.trees.plan import Plan

FOODS = (
    "carrot", "leek", "potato", "onion", "pepper", "tomato", "rice", "bean", "egg", "fish", "tofu", "apple",
    "pasta", "lentil", "kale", "beet", "squash", "mushroom", "cheese", "chicken", "pear", "plum", "nut", "herb",
)  # fmt: skip
VESSELS = ("pot", "pan", "wok", "tray", "bowl", "dish", "tin", "steamer", "casserole", "skillet")
PREPARING = ("wash", "peel", "chop", "slice", "grate", "season", "marinate")
HEATING = ("boil", "fry", "bake", "steam", "roast", "simmer")
FINISHING = ("stir", "cover", "drain", "garnish", "taste", "salt")


@dataclass(frozen=True)
class Seen:
    """What was seen in one episode, and for each observation the goal it serves (None: needless)."""

    observations: tuple[Observation, ...]
    goals: tuple[str | None, ...]

    @property
    def pursued(self) -> tuple[str, ...]:
        """The goals, sorted."""
        return tuple(sorted({goal for goal in self.goals if goal is not None}))


def kitchen(dishes: int, seed: int = 0) -> str:
    """The text of a plan library of so many dishes."""
    chance, lines, bags = random.Random(seed), list[str](), set[tuple[str, ...]]()
    while len(lines) < 2 * dishes:
        head, body, verbs = _dish(len(lines) // 2, chance)
        if (bag := tuple(sorted(verbs))) not in bags:
            bags.add(bag)
            lines += [f"goal({head}).", f"{head} --> {body}."]
    return "\n".join(lines)


def _dish(number: int, chance: random.Random) -> tuple[str, str, list[str]]:
    foods = chance.sample(FOODS, chance.randint(1, 3))
    named = [food if chance.random() < 0.5 else f"F{at}" for at, food in enumerate(foods)]
    rows, verbs = [], []
    for food in named:
        own = chance.sample(PREPARING, chance.randint(0, 2))
        verbs += ["take", *own, "put"]
        rows.append(", ".join([f"take({food})", *(f"{verb}({food})" for verb in own), f"put({food}, C)"]))
    last = [chance.choice(HEATING), *chance.sample(FINISHING, chance.randint(0, 2))]
    verbs += [*last, "serve"]
    first = f"unordered({', '.join(f'({row})' for row in rows)})" if len(rows) > 1 else rows[0]
    body = ", ".join([first, *(f"{verb}(C)" for verb in last), "serve(C, D)"])
    parameters = [food for food in named if food.startswith("F")]
    return f"dish{number}({', '.join([*parameters, 'C', 'D'])})", body, verbs


def cooked(
    plans: Sequence[Plan], together: int, chance: random.Random, needless: float = 0.0, unseen: float = 0.0
) -> Seen:
    """So many dishes, begun at different times and interleaved, each carried out to its end.

    At any time half of the steps go on with what was touched last. A container is used for one dish at a time, and so
    is a food, but for what several dishes cannot do without.
    """
    pursued = chance.sample(plans, together)
    vessels = chance.sample(VESSELS, together)
    needed = {arg for plan in pursued for leaf in plan.leaves for arg in leaf.args}
    foods = [food for food in FOODS if food not in needed]
    chance.shuffle(foods)
    rows = [carried_out(plan, chance, vessel, foods) for plan, vessel in zip(pursued, vessels)]
    starts, at = [0], 0
    for row in rows[:-1]:
        at += chance.randint(1, max(1, len(row)))
        starts.append(at)
    waiting, seen, goals, last, time = [list(row) for row in rows], [], [], 0, 0
    while any(waiting):
        ready = [n for n, row in enumerate(waiting) if row and starts[n] <= time]
        if ready:
            last = last if last in ready and chance.random() < 0.5 else chance.choice(ready)
            observation = waiting[last].pop(0)
            if chance.random() >= unseen:
                seen.append(observation)
                goals.append(pursued[last].label)
        if chance.random() < needless:
            seen.append(anything(plans, chance))
            goals.append(None)
        time += 1
    return Seen(tuple(seen), tuple(goals))


def carried_out(plan: Plan, chance: random.Random, vessel: str, foods: list[str]) -> list[Observation]:
    """A way to do the plan, in this vessel and with some of these foods, which are used up but for the last one."""
    values: dict[Term, Term] = {}
    for variable in plan.variables:
        values[variable] = vessel if variable.name == "C" else "plate" if variable.name == "D" else _some(foods)
    done = _row(plan.root, chance)
    return [Observation(leaf.functor, tuple(values.get(arg, arg) for arg in leaf.args)) for leaf in done]


def _some(foods: list[str]) -> str:
    return foods.pop() if len(foods) > 1 else foods[0]


def _row(node: Node, chance: random.Random) -> list[Compound]:
    if isinstance(node, Action):
        return [node.term]
    waiting = [_row(child, chance) for child in node.children]
    done = []
    is_free = isinstance(node, Shape) and node.kind == "unordered"
    while any(waiting):
        left = [at for at, rest in enumerate(waiting) if rest]
        done.append(waiting[chance.choice(left) if is_free else left[0]].pop(0))
    return done


def anything(plans: Sequence[Plan], chance: random.Random) -> Observation:
    """An action of the library with whatever it is done with."""
    leaf = chance.choice(chance.choice(plans).leaves)
    things = [chance.choice(VESSELS if isinstance(arg, Variable) and arg.name in "CD" else FOODS) for arg in leaf.args]
    return Observation(leaf.functor, tuple(things))


def library(dishes: int, seed: int = 0) -> PlanLibrary:
    """The library of a kitchen."""
    return PlanLibrary.from_text(kitchen(dishes, seed))
