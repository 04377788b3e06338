"""How well anybody could do in kitchens where actions go unseen: the best guess of one who is told more than is seen.

    python benchmarks/day/optimum.py [--dishes N] [--episodes N] [--unseen P] [--seed N …]

They are told which observations belong together, and how episodes are drawn: every order of a dish as likely as it is,
every step unseen with this chance, every open food and vessel alike. Of each goal's observations the likeliest dish is
guessed, and where dishes tie, one of them. The figure is how many sets of goals are right then, in expectation: an
upper bound for whoever must find out what belongs together.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from collections.abc import Sequence

import kitchens

from casper.engine.verification.observation import Observation
from casper.kb.terms.terms import Compound, Variable
from casper.plans.trees.nodes import Action, Node, Shape
from casper.plans.trees.plan import Plan

CHANCES = {"C": 1 / len(kitchens.VESSELS), "D": 1.0}  # of a value, by parameter; any other one is a food
FOOD = 1 / 18  # there are 24; some are what a dish of the episode cannot do without
Known = tuple[tuple[str, str], ...]


class Dish:
    """A plan as rows that may interleave, and what comes after all of them."""

    def __init__(self, plan: Plan, unseen: float) -> None:
        first, *last = plan.root.children
        is_free = isinstance(first, Shape) and first.kind == "unordered"
        self.rows = [_leaves(child) for child in first.children] if is_free else []
        self.tail = [leaf for child in (last if is_free else plan.root.children) for leaf in _leaves(child)]
        self.label, self.unseen = plan.label, unseen
        self.names = Counter(leaf.functor for leaf in plan.leaves)

    def likelihood(self, seen: Sequence[Observation]) -> float:
        """The probability that just this is seen of it."""
        if any(self.names[name] < count for name, count in Counter(each.action for each in seen).items()):
            return 0.0
        self._seen, self._found = seen, dict[tuple[tuple[int, ...], int, int, Known], float]()
        return self._from((0,) * len(self.rows), 0, 0, ())

    def _from(self, at: tuple[int, ...], last: int, number: int, known: Known) -> float:
        """The probability of the observations from this number on, so many leaves of each row being done."""
        key = at, last, number, known
        if key not in self._found:
            left = [row for row, done in enumerate(at) if done < len(self.rows[row])]
            steps = [(self.rows[row][at[row]], (*at[:row], at[row] + 1, *at[row + 1 :]), last) for row in left]
            if not left and last < len(self.tail):
                steps = [(self.tail[last], at, last + 1)]
            each = 1 / len(steps) if steps else float(number == len(self._seen))
            self._found[key] = each * sum(self._step(*step, number, known) for step in steps) if steps else each
        return self._found[key]

    def _step(self, leaf: Compound, at: tuple[int, ...], last: int, number: int, known: Known) -> float:
        total = self.unseen * self._from(at, last, number, known)
        if number < len(self._seen):
            chance, after = _taken(leaf, self._seen[number], known)
            if chance:
                total += (1 - self.unseen) * chance * self._from(at, last, number + 1, after)
        return total


def _leaves(node: Node) -> list[Compound]:
    return [node.term] if isinstance(node, Action) else [leaf for child in node.children for leaf in _leaves(child)]


def _taken(leaf: Compound, seen: Observation, known: Known) -> tuple[float, Known]:
    """The chance of these values, and what is known of the parameters then."""
    values, chance = dict(known), 1.0
    if leaf.functor != seen.action or leaf.arity != len(seen.args or ()):
        return 0.0, known
    for argument, value in zip(leaf.args, seen.args or ()):
        if not isinstance(argument, Variable):
            chance *= argument == value
        elif argument.name in values:
            chance *= values[argument.name] == value
        else:
            chance *= CHANCES.get(argument.name, FOOD)
            values[argument.name] = value
    return chance, tuple(sorted(values.items()))


def expected(plans: Sequence[Plan], episodes: int, unseen: float, chance: random.Random) -> float:
    """How many of so many sets of goals are right."""
    dishes, right = [Dish(plan, unseen) for plan in plans], 0.0
    for _ in range(episodes):
        episode, sure = kitchens.cooked(plans, chance.randint(2, 5), chance, 0.0, unseen), 1.0
        for goal in episode.pursued:
            own = [seen for seen, serves in zip(episode.observations, episode.goals) if serves == goal]
            found = {dish.label: dish.likelihood(own) for dish in dishes}
            best = [label for label, value in found.items() if value >= max(found.values()) * (1 - 1e-9)]
            sure *= (goal in best) / len(best)
        right += sure
    return right


def main() -> None:
    """Print the figure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dishes", type=int, default=100)
    parser.add_argument("--episodes", type=int, default=30, help="of each seed")
    parser.add_argument("--unseen", type=float, default=0.2)
    parser.add_argument("--seed", type=int, nargs="+", default=[7000, 7001, 7002, 7003])
    given = parser.parse_args()
    right = 0.0
    for seed in given.seed:
        plans = kitchens.library(given.dishes, seed).ways
        right += expected(plans, given.episodes, given.unseen, random.Random(seed + 1))
    of = given.episodes * len(given.seed)
    print(f"{right:.1f} of {of} sets of goals are right at best: {right / of:.1%}")


if __name__ == "__main__":
    main()
