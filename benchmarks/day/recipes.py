"""Recipes with shared beginnings, and cooks who change their mind at some point, or do not.

In the manner of Ghose et al., "I've Changed My Mind" (arXiv 2511.15914, 2025): thirty recipes, no action is done twice.
Recipes come in families that share their first steps; later steps may be shared by any two. Who changes goes on with
the steps of the new recipe that were not done yet.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass

from casper.plans.library import PlanLibrary

RECIPES, FAMILY = 30, 5


@dataclass(frozen=True)
class Cook:
    """What was done, the goal it began with, the goal of each action, and when the new goal can be known.

    ``telling`` is the number, from 0, of the first action that only the new goal explains (None: no change, or none).
    """

    actions: tuple[str, ...]
    first: str
    goals: tuple[str, ...]
    telling: int | None


def recipes(seed: int = 0) -> dict[str, tuple[str, ...]]:
    """The actions of each recipe, in order: 2 to 4 of its family's, then 5 to 8 drawn from sixty, none twice."""
    chance, found = random.Random(seed), dict[str, tuple[str, ...]]()
    for family in range(RECIPES // FAMILY):
        shared = tuple(f"begin{family}_{step}" for step in range(chance.randint(2, 4)))
        for _ in range(FAMILY):
            own = tuple(f"step{n}" for n in chance.sample(range(60), chance.randint(5, 8)))
            found[f"recipe{len(found)}"] = shared + own
    return found


def library(rows: dict[str, tuple[str, ...]]) -> PlanLibrary:
    """The recipes as plans."""
    lines = [f"goal({name}).\n{name} --> {', '.join(row)}." for name, row in rows.items()]
    return PlanLibrary.from_text("\n".join(lines))


def cook(rows: dict[str, tuple[str, ...]], changes: bool, chance: random.Random) -> Cook:
    """Someone who cooks a recipe to the end, or leaves it for another after some of its actions."""
    first, second = chance.sample(sorted(rows), 2)
    if not changes:
        return Cook(rows[first], first, (first,) * len(rows[first]), None)
    done = rows[first][: chance.randint(1, len(rows[first]) - 1)]
    rest = tuple(action for action in rows[second] if action not in done)
    goals = (first,) * len(done) + (second,) * len(rest)
    return Cook(done + rest, first, goals, _telling(rows, first, second, done, rest))


def _telling(
    rows: dict[str, tuple[str, ...]], first: str, second: str, done: Sequence[str], rest: Sequence[str]
) -> int | None:
    """When the actions since the change are next ones of the new recipe alone, and not of the old one."""
    for count in range(1, len(rest) + 1):
        since = tuple(rest[:count])
        fitting = {name for name, row in rows.items() if _left(row, done)[:count] == since}
        if fitting == {second}:
            return len(done) + count - 1
    return None


def _left(row: Sequence[str], done: Sequence[str]) -> tuple[str, ...]:
    return tuple(action for action in row if action not in done)
