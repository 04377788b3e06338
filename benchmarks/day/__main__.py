"""A day in figures: sets of goals, changes of mind, whole days. Times are CPU time.

    python benchmarks/day [--quick] [--only a|b|c] [--seed N] [--recorded N] [--episodes N] [--no-rivals]

Prices are the defaults everywhere; with --recorded those of kitchens are learned from so many other episodes, as
``casper train --plans`` does, for each row anew. Exit code 1 when a bound of the project is not held.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from measuring import Score, changes, kitchen, whole_day

CASES = (("everything seen", 0.0, 0.0, 0.98), ("a tenth needless", 0.1, 0.0, 0.98), ("a fifth unseen", 0.0, 0.2, 0.9))
held: list[bool] = []


def told(what: str, share: float, bound: float | None, note: str = "") -> None:
    """One line: a share and whether it holds."""
    verdict = ""
    if bound is not None:
        held.append(share >= bound)
        verdict = f"at least {bound:.0%}: {'held' if held[-1] else 'NOT held'}"
    print(f"{what:<62} {share:>7.1%}  {verdict:<22} {note}".rstrip(), flush=True)


def times(score: Score, median: float, longest: float) -> None:
    """The median and the longest observation, in milliseconds, and whether they hold."""
    for what, figure, bound in (("median", score.median(), median), ("longest", max(score.seconds), longest)):
        held.append(1e3 * figure <= bound)
        verdict = "held" if held[-1] else "NOT held"
        print(f"  an observation, {what:<44} {1e3 * figure:>7.2f} ms  bound {bound:g} ms: {verdict}", flush=True)


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true", help="fewer episodes, a few minutes")
    parser.add_argument("--only", choices="abc", help="one part only")
    parser.add_argument("--seed", type=int, default=0, help="of the libraries and of what is done")
    parser.add_argument("--recorded", type=int, default=0, help="episodes of a kitchen to learn prices from; 0: none")
    parser.add_argument("--episodes", type=int, help="of each row of kitchens")
    parser.add_argument("--no-rivals", action="store_true", help="leave the other recognisers out of kitchens")
    given = parser.parse_args()
    episodes, many, goals = (20, 50, 40) if given.quick else (200, 500, 200)
    episodes = given.episodes or episodes
    if given.only in (None, "a"):
        for dishes in (20, 100):
            for what, needless, unseen, bound in CASES:
                ours, theirs = kitchen(
                    dishes, episodes, needless, unseen, not given.no_rivals, given.seed, given.recorded
                )
                told(f"(a) 2-5 of {dishes} dishes, {what}: right set", ours.share, bound, f"{ours.of} episodes")
                times(ours, 5, 100)
                for name, score in theirs.items() if not given.no_rivals else ():
                    told(f"  {name}", score.share, None, f"{score.of} episodes")
    if given.only in (None, "b"):
        mine, others = changes(many, given.seed)
        told("(b) the new recipe leads within two actions", mine.found.share, 0.95, f"{mine.found.of} episodes")
        for name, score in others.items():
            told(f"  {name}", score.found.share, None, f"{score.found.of} episodes")
        told("(b) no change announced where there is none", mine.quiet.share, 0.98, f"{mine.quiet.of} episodes")
        for name, score in others.items():
            told(f"  {name}", score.quiet.share, None, f"{score.quiet.of} episodes")
        times(mine.found, 5, 100)
    if given.only in (None, "c"):
        score = whole_day(goals, seed=given.seed)
        told(f"(c) a day of {goals} goals: goals right", score.share, 0.95, f"{score.invented} episodes of no goal")
        for name, led in score.led.items():
            told(f"  a goal leads at its last action: {name}", led.share, None, f"{led.of} goals")
        print(f"  the PHATT-style recogniser gave up at observation {score.gave_up}")
        times(score, 10, 100)
        held.append(score.kept[-1] <= 1.5 * max(score.kept[:2]))
        print(f"  objects kept, by quarter: {score.kept}; {'constant' if held[-1] else 'NOT constant'}")
    print(f"\n{'every bound held' if all(held) else 'some bound NOT held'}")
    return int(not all(held))


if __name__ == "__main__":
    sys.exit(main())
