"""What a simulated trial costs, and that the cheap physics ends as the plain one does.

    python benchmarks/trial.py [--trials N] [--first N] [--goals GOAL …]

Each trial of the kitchen is run twice: with the plain physics (steps of 5 ms, nothing sleeps) and as it is shipped.
Cost is processor time. Results are equal when the same goal was read at the same time, the robot was asked for the same
and finished it, and the same events came in the same order, none off by more than a sampling period. Where a thing lies
at the end may differ: one that was knocked over rolls about.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any, NamedTuple

import mujoco

from casper import Domain
from casper.engine.events import Event
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.trial import Trial, TrialSettings

GOALS = ("breakfast", "lunch", "drink")
PLAIN_STEP = 0.005  # seconds
TELLING = {"action", "goal", "plan", "robot", "withdrawn", "episode"}  # events whose order and times are compared


class Run(NamedTuple):
    """What came of a trial, and what it cost: processor seconds in all, and of the physics."""

    events: list[Event]
    cpu: float
    physics: float

    @property
    def end(self) -> dict[str, Any]:
        """The summary."""
        return self.events[-1].data

    @property
    def course(self) -> list[tuple[str, str]]:
        """What happened, in order."""
        return [(event.type, str(event.data.get("action") or event.data.get("goal") or "")) for event in self.told]

    @property
    def told(self) -> list[Event]:
        """The events that are compared."""
        return [event for event in self.events if event.type in TELLING]


def plain(physics: Physics) -> None:
    """Make the physics plain: small steps, and all bodies awake."""
    physics.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    physics.model.opt.timestep = PLAIN_STEP
    physics.guided.substeps = round(physics.scene.sim.control / PLAIN_STEP)


def run(domain: Domain, goal: str, seed: int, *, is_plain: bool) -> Run:
    """One trial."""
    began = time.process_time()
    trial = Trial(domain, TrialSettings(goal=goal, seed=seed))
    physics = trial.simulation.physics
    if is_plain:
        plain(physics)
    spent, step = [0.0], physics.step

    def timed() -> None:
        since = time.process_time()
        step()
        spent[0] += time.process_time() - since

    physics.step = timed  # type: ignore[method-assign]
    events = list(trial.events())
    return Run(events, time.process_time() - began, spent[0])


RESULTS = ("predicted", "correct", "prediction_time", "observed", "missed", "waiting", "planned")
DONE = ("actions", "done", "gave_up")  # of the robot; how near it came to somebody depends on the step of the physics


def difference(one: Run, other: Run, period: float) -> str:
    """What differs in the results, in words; empty where they are equal.

    Args:
        one, other: of the same goal and seed.
        period: the sampling period, seconds: nothing may be off by more.
    """
    ends = [{**run.end, **{f"robot {what}": run.end["robot"][what] for what in DONE}} for run in (one, other)]
    for what in (*RESULTS, *(f"robot {what}" for what in DONE)):
        if ends[0][what] != ends[1][what]:
            return f"{what} is {ends[1][what]}, not {ends[0][what]}"
    if one.course != other.course:
        return f"the course is {other.course}, not {one.course}"
    off = max((abs(a.t - b.t) for a, b in zip(one.told, other.told)), default=0.0)
    return f"an event is off by {off:g} s" if off > period + 1e-9 else ""


def table(domain: Domain, goals: list[str], seeds: range) -> int:
    """Print a line a goal; returns how many trials ended differently."""
    print("goal       trials simulated s  plain s shipped s  ratio  physics  equal")
    period, different = scene_of(domain).sim.period, 0
    for goal in goals:
        pairs: list[tuple[Run, Run]] = []
        wrong: list[str] = []
        for seed in seeds:
            pairs.append((run(domain, goal, seed, is_plain=True), run(domain, goal, seed, is_plain=False)))
            told = difference(*pairs[-1], period)
            if told:
                wrong.append(told)
                print(f"    {goal}, seed {seed}: {told}")
        n = len(pairs)
        before, after = (sum(pair[at].cpu for pair in pairs) / n for at in (0, 1))
        share = sum(pair[1].physics for pair in pairs) / n / after
        simulated = sum(pair[1].events[-1].t for pair in pairs) / n
        different += len(wrong)
        costs = f"{before:8.2f} {after:9.2f} {before / after:6.2f} {share:8.0%}"
        print(f"{goal:<10} {n:6d} {simulated:11.1f} {costs}  {n - len(wrong)} of {n}", flush=True)
    return different


def main() -> int:
    """Print the table; exit code 1 when a result differs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--goals", nargs="+", default=list(GOALS))
    parser.add_argument("--trials", type=int, default=20, help="of each goal")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    arguments = parser.parse_args()
    domain = Domain.load("kitchen")
    run(domain, arguments.goals[0], 0, is_plain=False)  # what is worked out once for a domain is worked out now
    return int(bool(table(domain, arguments.goals, range(arguments.first, arguments.first + arguments.trials))))


if __name__ == "__main__":
    sys.exit(main())
