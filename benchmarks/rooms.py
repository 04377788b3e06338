"""Trials in the shipped rooms: goals read, robot's parts finished, announcements withdrawn, seed after seed.

    python benchmarks/rooms.py [DOMAIN …] [--trials N] [--first N]

Goals are drawn from the seeds, of each partner. A trial is right when the goal of everybody was read, and finished when
the robot has done its part in each of them and everything rests where it belongs.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from typing import NamedTuple

from casper import Domain
from casper.sim_adapter.trial import Trial, TrialSettings

DOMAINS = ("kitchen", "workshop", "care_home", "minimal")


class Judged(NamedTuple):
    """What became of one seed: whose goals were which, what was read, and CPU seconds."""

    seed: int
    wanted: tuple[str, ...]
    read: tuple[str | None, ...]
    right: bool
    before_the_last_action: bool
    finished: bool
    withdrawn: tuple[str, ...]
    seconds: float
    cpu: float

    @property
    def is_good(self) -> bool:
        """Nothing went wrong."""
        return self.right and self.finished and not self.withdrawn


def judged(domain: Domain, seed: int) -> Judged:
    """Run one seed."""
    began = time.process_time()
    events = list(Trial(domain, TrialSettings(seed=seed)).events())
    last = events[-1].data
    rows = last.get("partners") or [last]
    early = all((row["prediction_time"] or 1e9) < (row["partner_finished"] or 0.0) for row in rows)
    withdrawn = tuple(event.data["goal"] for event in events if event.type == "withdrawn")
    goals, read = (tuple(row[key] for row in rows) for key in ("goal", "predicted"))
    ends = (last["correct"], early, last["robot"]["done"], withdrawn)
    return Judged(seed, goals, read, *ends, events[-1].t, time.process_time() - began)


def table(name: str, seeds: range) -> Iterator[str]:
    """A line for the domain, and one for each seed that went wrong."""
    rows = [judged(Domain.load(name), seed) for seed in seeds]
    n = len(rows)
    counted = (
        sum(row.right for row in rows),
        sum(row.before_the_last_action for row in rows),
        sum(row.finished for row in rows),
        sum(bool(row.withdrawn) for row in rows),
    )
    means = sum(row.seconds for row in rows) / n, sum(row.cpu for row in rows) / n
    figures = " ".join(f"{count:7d}" for count in counted)
    yield f"{name:<12} {n:6d} {figures} {means[0]:12.1f} {means[1]:7.1f}"
    for row in rows:
        if not row.is_good:
            yield f"    seed {row.seed}: wanted {row.wanted}, read {row.read}, finished {row.finished}, {row.withdrawn}"


def main() -> int:
    """Print the table; exit code 1 when something went wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("domains", nargs="*", default=DOMAINS, help="by default all that are shipped")
    parser.add_argument("--trials", type=int, default=60)
    parser.add_argument("--first", type=int, default=0)
    arguments = parser.parse_args()
    wrong = False
    print(f"{'domain':<12} {'trials':>6} {'right':>7} {'early':>7} {'done':>7} {'taken back':>7}  simulated s  CPU s")
    for name in arguments.domains:
        for text in table(name, range(arguments.first, arguments.first + arguments.trials)):
            print(text, flush=True)
            wrong = wrong or text.startswith("    seed")
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
