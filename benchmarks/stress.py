"""Trials of the kitchen over all conditions at random: none may break, none may come too near to somebody.

    python benchmarks/stress.py [--trials 2000] [--seed 0] [--jobs 2] [--out trials.jsonl]

Each trial draws a level of every factor of the study (partner, sensor, frame rate, walking speed, verification) and a
goal from its seed. Results are kept in the file as they come, so a run that was interrupted goes on where it was, and
more trials are added to those that are there. Exit code 1 when a trial broke off, a part of the robot ended without a
reason, or the robot moved while somebody was within its limit.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from casper import Domain
from casper.batch.trials import run_trials
from casper.experiments.studies.conditions import FACTORS
from casper.sim_adapter.room.facts import scene_of

GOALS = ("breakfast", "drink", "lunch")


def trial(seed: int) -> dict[str, Any]:
    """What the trial of a seed is about: a goal, and a level of each factor."""
    draw = random.Random(seed)
    levels = [draw.choice(list(levels.values())) for levels in FACTORS.values()]
    fields = {name: value for level in levels for name, value in level.trial.items()}
    settings = {name: value for level in levels for name, value in level.settings.items()}
    return {"goal": GOALS[seed % len(GOALS)], "seed": seed, **fields, **({"settings": settings} if settings else {})}


def lines(found: list[dict[str, Any]], limit: float) -> Iterator[str]:
    """What became of them, counted; then each trial that broke off or came too near."""
    whole = [row for row in found if not row["mistake"]]
    moved = [row for row in whole if row["least_distance"] is not None]
    nearest = min(moved, key=lambda row: row["least_distance"], default=None)
    yield f"trials              {len(found):6d}"
    yield f"broken off          {len(found) - len(whole):6d}"
    for name in ("right", "helped", "help_ended"):
        yield f"{name.replace('_', ' '):<20}{sum(row[name] for row in whole):6d}"
    wrong = [len(row["wrong_interventions"]) for row in whole if row["wrong_interventions"]]
    yield f"wrong interventions {sum(wrong):6d} in {len(wrong)} trials"
    if nearest is not None:
        speed = nearest["speed_there"]
        yield f"least distance      {nearest['least_distance']:6.3f} m at {speed:.2f} m/s, limit {limit:g} m"
    gave_up = Counter(row["gave_up"] for row in whole if row["gave_up"])
    yield from (f"    {count:4d} × {reason}" for reason, count in gave_up.most_common(12))
    yield from (f"    seed {row['trial']['seed']}: {row['mistake']}" for row in found if row["mistake"])
    near = (row for row in moved if _is_near(row, limit))
    yield from (f"    seed {row['trial']['seed']}: {row['least_distance']:.3f} m" for row in near)


def main() -> int:
    """Run them and print what became of them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    domain = Domain.load("kitchen")
    limit = scene_of(domain).robot_settings.stop_distance
    trials = [trial(seed) for seed in range(given.seed, given.seed + given.trials)]
    found = run_trials(domain, trials, jobs=given.jobs, journal=given.out, progress=sys.stderr.isatty())
    print("\n".join(lines(found, limit)))
    return int(any(row["mistake"] or not row["help_ended"] or _is_near(row, limit) for row in found))


def _is_near(row: dict[str, Any], limit: float) -> bool:
    """Whether the robot moved while somebody was within its limit."""
    return row["least_distance"] is not None and row["least_distance"] < limit


if __name__ == "__main__":
    sys.exit(main())
