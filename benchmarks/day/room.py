"""Whole days in the simulated kitchen: goals in a row, and a partner who changes their mind, seed after seed.

    python benchmarks/day/room.py [--seeds N] [--first N]

Of each seed it is counted whether every goal was read (predicted, and its episode closed as finished), whether the
robot helped with it (did a part that it had announced), and whether it did anything that it had withdrawn.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from casper import Domain
from casper.engine.events import Event
from casper.sim_adapter.trial import Trial, TrialSettings


class Scenario(NamedTuple):
    """What a partner does, and how it is called."""

    name: str
    goals: str
    changes_mind: bool


SCENARIOS = (
    Scenario("breakfast, a drink, lunch", "breakfast,drink,lunch", False),
    Scenario("lunch, no, breakfast", "lunch,breakfast", True),
)


class Judged(NamedTuple):
    """What became of one seed: the goals read and helped with, faults of the robot, simulated and CPU seconds."""

    wanted: tuple[str, ...]
    read: tuple[str, ...]
    helped: tuple[str, ...]
    withdrawn: tuple[str, ...]
    broken: tuple[str, ...]
    seconds: float
    cpu: float

    @property
    def is_right(self) -> bool:
        """Everything wanted was read and helped with, and nothing withdrawn was done."""
        return self.read == self.wanted == self.helped and not self.broken


def read_of(events: Iterable[Event]) -> Iterator[str]:
    """The goals that were predicted and whose episode was finished, in order."""
    predicted: set[str] = set()
    for event in events:
        if event.type == "prediction":
            predicted.add(event.data["goal"])
        elif event.type == "episode" and event.data["outcome"] == "finished" and event.data["goal"] in predicted:
            yield event.data["goal"]


def helped_of(events: Iterable[Event]) -> Iterator[str]:
    """The goals of which the robot did the whole part that it was asked for, in order."""
    goal, left = "", 0
    for event in events:
        if event.type == "plan" and event.data["actions"]:
            goal = event.data["goal"]
        elif event.type == "robot":
            left += {"asked": 1, "done": -1}.get(event.data["status"], 0)
            if event.data["status"] == "done" and left == 0:
                yield goal


def broken_by(events: Iterable[Event]) -> Iterator[str]:
    """Actions that the robot was asked for, or did, after it had withdrawn them and before it announced them anew."""
    withdrawn: set[str] = set()
    announced: set[str] = set()
    for event in events:
        if event.type == "plan":
            announced = set(event.data["actions"])
            withdrawn -= announced
        elif event.type == "withdrawn":
            withdrawn |= announced
        elif event.type == "robot" and event.data["status"] in ("asked", "done") and event.data["action"] in withdrawn:
            yield f"{event.data['status']} {event.data['action']} at {event.t:g} s"


def judged(domain: Domain, scenario: Scenario, seed: int) -> Judged:
    """Run one seed."""
    began = time.process_time()
    trial = Trial(domain, TrialSettings(scenario.goals, seed, changes_mind=scenario.changes_mind))
    events = list(trial.events())
    wanted = tuple(pursuit.goal for pursuit in trial.partner.pursuits if not pursuit.given_up)
    withdrawn = tuple(event.data["goal"] for event in events if event.type == "withdrawn")
    found = (tuple(read_of(events)), tuple(helped_of(events)), withdrawn, tuple(broken_by(events)))
    return Judged(wanted, *found, events[-1].t, time.process_time() - began)


def table(domain: Domain, scenarios: Sequence[Scenario], seeds: Sequence[int]) -> Iterator[str]:
    """A line for each scenario, with the seeds that went wrong below it."""
    yield f"{'scenario':<28} right   read helped  withdrawn broken  simulated s  CPU s"
    for scenario in scenarios:
        rows = [judged(domain, scenario, seed) for seed in seeds]
        n = len(rows)
        right, read, helped = (
            sum(ok(row) for row in rows)
            for ok in (lambda r: r.is_right, lambda r: r.read == r.wanted, lambda r: r.helped == r.wanted)
        )
        means = sum(row.seconds for row in rows) / n, sum(row.cpu for row in rows) / n
        counted = f"{right:3d}/{n:<3d} {read:3d} {helped:6d} {sum(bool(r.withdrawn) for r in rows):9d}"
        yield f"{scenario.name:<28} {counted} {sum(len(r.broken) for r in rows):8d} {means[0]:11.1f} {means[1]:8.1f}"
        for seed, row in zip(seeds, rows):
            if not row.is_right:
                yield f"    seed {seed}: read {row.read}, helped {row.helped}, broken {row.broken}"


def main() -> int:
    """Print the table; exit code 1 when a seed went wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    arguments = parser.parse_args()
    seeds, wrong = range(arguments.first, arguments.first + arguments.seeds), False
    for text in table(Domain.load("kitchen"), SCENARIOS, seeds):
        print(text, flush=True)
        wrong = wrong or text.startswith("    seed")
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
