"""Whole days in a kitchen: dish after dish, now and then two at once, with needless, unseen and unknown actions."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from kitchens import FOODS, VESSELS, anything, carried_out

from casper.engine.verification.observation import Observation
from casper.plans.trees.plan import Plan

UNKNOWN = ("dance", "phone", "sweep", "read")


class Done(NamedTuple):
    """An action that was seen; the number of the goal it serves among those of the day (None: none), and its label."""

    observation: Observation
    number: int | None
    goal: str | None


def day(
    plans: Sequence[Plan],
    goals: int,
    chance: random.Random,
    needless: float = 0.05,
    unseen: float = 0.1,
    unknown: float = 0.03,
    together: float = 0.3,
) -> Iterator[Done]:
    """The actions of a day of so many goals; with chance ``together`` the next one begins before one is over."""
    begun, under_way = 0, list[tuple[int, Plan, list[Observation]]]()
    while begun < goals or under_way:
        if begun < goals and (not under_way or (len(under_way) < 2 and chance.random() < together / 5)):
            used = {plan.label for _, plan, _ in under_way}
            plan = chance.choice([plan for plan in plans if plan.label not in used])
            vessel = chance.choice([v for v in VESSELS if all(v not in o.args for _, _, row in under_way for o in row)])
            foods = [food for food in FOODS if all(food not in o.args for _, _, row in under_way for o in row)]
            chance.shuffle(foods)
            under_way.append((begun, plan, carried_out(plan, chance, vessel, foods)))
            begun += 1
        number, plan, row = chance.choice(under_way)
        observation = row.pop(0)
        if chance.random() >= unseen:
            yield Done(observation, number, plan.label)
        if chance.random() < needless:
            yield Done(anything(plans, chance), None, None)
        if chance.random() < unknown:
            yield Done(Observation(chance.choice(UNKNOWN), ()), None, None)
        under_way = [entry for entry in under_way if entry[2]]
