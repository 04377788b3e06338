"""How well anybody could do at half of an emergency's actions: what the generator itself says of equal beginnings.

    python benchmarks/day/prefixes.py [--episodes N] [--drawn N] [--seed N]

Many episodes are drawn; for the first half of each tested one those are counted that begin alike, but for the names of
things of one kind. The goal that most of them have is the best guess of somebody who knows how episodes are drawn and
sees what was done. Three are told apart: who does not know how much is still to come; who looks at some moment of an
episode, each as likely (then one of n actions is seen at this moment with chance 1 / n); and who is told that just half
was done, which nobody is who watches. Beginnings that few others share count as right: the figures are upper bounds.
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import TypeAlias

from emergencies import Episodes
from flood import KINDS

KIND = {name: kind for kind, names in KINDS.items() for name in names.split()}
FEW = 20  # other episodes that begin alike
Half: TypeAlias = tuple[tuple[str, ...], ...]
# by who guesses: what an episode of so many actions counts for whose first so many were seen
WEIGHTS: dict[str, Callable[[int, int], float]] = {
    "who does not know how much is to come": lambda seen, whole: 1.0,
    "who looks at some moment, each as likely": lambda seen, whole: 1 / whole,
    "who is told that it is half": lambda seen, whole: float((whole + 1) // 2 == seen),
}


def alike(actions: list[str]) -> tuple[tuple[str, ...], ...]:
    """The actions with things numbered by kind in the order in which they are met."""
    names: dict[str, str] = {}
    numbers: Counter[str] = Counter()
    found = []
    for action in actions:
        name, things = action[:-1].split("(")
        for thing in things.split(", "):
            if thing not in names:
                names[thing] = f"{KIND[thing]}{numbers[KIND[thing]]}"
                numbers[KIND[thing]] += 1
        found.append((name, *(names[thing] for thing in things.split(", "))))
    return tuple(found)


def known(actions: Sequence[str], wanted: Collection[Half], lengths: Sequence[int]) -> Iterator[Half]:
    """The beginnings of an episode that are wanted."""
    found = alike(list(actions))
    return (found[:length] for length in lengths if length <= len(found) and found[:length] in wanted)


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=1000, help="tested")
    parser.add_argument("--drawn", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=7)
    given = parser.parse_args()
    tested, drawn = Episodes(given.seed), Episodes(given.seed + 1000)
    halves: list[tuple[str, Half]] = []
    for _ in range(given.episodes):
        episode = tested.make()
        halves.append((episode.goal, alike(episode.actions)[: (len(episode.actions) + 1) // 2]))
    wanted, lengths = {half for _, half in halves}, sorted({len(half) for _, half in halves})
    goals = {who: {half: defaultdict[str, float](float) for half in wanted} for who in WEIGHTS}
    shared: Counter[Half] = Counter()
    for _ in range(given.drawn):
        episode = drawn.make()
        for half in known(episode.actions, wanted, lengths):
            shared[half] += 1
            for who, weight in WEIGHTS.items():
                goals[who][half][episode.goal] += weight(len(half), len(episode.actions))
    rare = sum(shared[half] < FEW for _, half in halves)
    print(f"{len(halves) - rare} halves begin as {FEW} and more others do; the {rare} others are taken for right")
    for who, counted in goals.items():
        often = [(goal, counted[half]) for goal, half in halves if shared[half] >= FEW]
        right = sum(max(counts, key=counts.__getitem__) == goal for goal, counts in often)
        print(f"{who}: right of {right}, {(right + rare) / len(halves):.1%} at best")


if __name__ == "__main__":
    main()
