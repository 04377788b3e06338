"""How well anybody could do at half of an emergency's actions: what the generator itself says of equal beginnings.

    python benchmarks/day/prefixes.py [--episodes N] [--drawn N] [--seed N]

Many episodes are drawn; for the first half of each tested one those are counted that begin alike, but for the names of
things of one kind. The goal that most of them have is the best guess of somebody who sees what was done and does not
know how much is still to come. Beginnings that few others share count as right: the figure is an upper bound.
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict

from emergencies import Episodes
from flood import KINDS

KIND = {name: kind for kind, names in KINDS.items() for name in names.split()}
FEW = 20  # other episodes that begin alike


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


def main() -> None:
    """Print the figure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=1000, help="tested")
    parser.add_argument("--drawn", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=7)
    given = parser.parse_args()
    tested, drawn = Episodes(given.seed), Episodes(given.seed + 1000)
    halves = []
    for _ in range(given.episodes):
        episode = tested.make()
        halves.append((episode.goal, alike(episode.actions)[: (len(episode.actions) + 1) // 2]))
    wanted, lengths = {half for _, half in halves}, sorted({len(half) for _, half in halves})
    goals: defaultdict[object, Counter[str]] = defaultdict(Counter)
    for _ in range(given.drawn):
        episode = drawn.make()
        actions = alike(episode.actions)
        for length in lengths:
            if length <= len(actions) and actions[:length] in wanted:
                goals[actions[:length]][episode.goal] += 1
    known = [(goal, goals[half]) for goal, half in halves if goals[half].total() >= FEW]
    right = sum(counts.most_common(1)[0][0] == goal for goal, counts in known)
    rare = len(halves) - len(known)
    print(f"{len(known)} halves begin as {FEW} and more others do: the best guess is right of {right}")
    print(f"with the {rare} others taken for right: {(right + rare) / len(halves):.1%} at best")


if __name__ == "__main__":
    main()
