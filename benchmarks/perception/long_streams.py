"""Streams in figures: memory over a day at 10 Hz, and recordings spread over processes.

    python benchmarks/perception/long_streams.py [--hours 24] [--recordings 100] [--minutes 480] [--jobs 2] [--noise 0]

A lunch is simulated once; its world states, at 10 Hz and with fresh noise, are what every hour consists of. They come
as lines of JSON, through the reordering window, as `casper watch FILE` reads them. Without ``--noise`` the sensor is
the kitchen's (1 cm); with 0.06 it is found to be poor and filtered. Rates are world states a second of processor time,
that of making them up left out.
"""

import argparse
import json
import random
import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from casper import Domain
from casper.batch import watch_many
from casper.engine.live import Partners
from casper.engine.live.memory import keep_loaded
from casper.engine.perception.world import AgentState, ObjectState, WorldState, world_state_to_json
from casper.streams.watching import watched

RATE = 10  # world states a second
GROWS = 5.0  # MB from the second 24th to the last that are no growth


def lunch(domain: Domain) -> list[WorldState]:
    """The world states of one lunch, as the robot's eye saw them."""
    from casper.sim_adapter.trial import Trial, TrialSettings  # MuJoCo, which nothing else here needs

    trial, states = Trial(domain, TrialSettings("lunch", robot=False)), []
    trial.sensed = states.append
    for _ in trial.events():
        pass
    return states


def repeated(states: list[WorldState], seconds: float, noise: float, seed: int = 0) -> Iterator[WorldState]:
    """The states again and again, ten a second, each place between two with noise of its own."""
    source, length, start = random.Random(seed), states[-1].t - states[0].t + 0.5, states[0].t
    at, count = 0, int(seconds * RATE)
    for n in range(count):
        t = n / RATE
        within = start + t % length
        if within < states[at].t:
            at = 0
        while at + 2 < len(states) and states[at + 1].t <= within:
            at += 1
        yield between(states[at], states[at + 1], t, within, noise, source)


def between(a: WorldState, b: WorldState, t: float, within: float, noise: float, source: random.Random) -> WorldState:
    """What both see, where it is in between."""
    share = min(max((within - a.t) / (b.t - a.t), 0.0), 1.0)

    def place(p: AgentState | ObjectState, q: AgentState | ObjectState) -> tuple[float, float]:
        return p.x + share * (q.x - p.x) + source.gauss(0, noise), p.y + share * (q.y - p.y) + source.gauss(0, noise)

    agents = {n: AgentState(*place(p, b.agents[n]), p.heading, p.holding) for n, p in a.agents.items() if n in b.agents}
    objects = {n: ObjectState(*place(p, b.objects[n]), p.z) for n, p in a.objects.items() if n in b.objects}
    return WorldState(t, agents, objects)


def resident() -> float:
    """Megabytes of this process, now."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


class Lines:
    """World states as lines of JSON, and the processor time that it took to make them up (seconds)."""

    def __init__(self, worlds: Iterator[WorldState]) -> None:
        self.worlds, self.took = worlds, 0.0

    def __iter__(self) -> Iterator[str]:
        began = time.process_time()
        for world in self.worlds:
            line = json.dumps(world_state_to_json(world))
            self.took += time.process_time() - began
            yield line
            began = time.process_time()


def day(domain: Domain, states: list[WorldState], hours: float, noise: float) -> bool:
    """One line each 24th of the time: states, rate, memory; whether the memory stayed what it was after the second."""
    lines = Lines(repeated(states, hours * 3600.0, noise))
    began, line, memory, part = time.process_time(), 1, [], hours * 150.0
    print(f"{'hour':>6}{'states':>10}{'events':>10}{'states/s':>10}{'MB':>8}")
    for events, event in enumerate(watched(Partners(domain), lines, window=1.0), 1):
        if event.t >= line * part or event.type == "summary":
            memory.append(resident())
            count, used = int(line * part * RATE), time.process_time() - began - lines.took
            told = f"{line * part / 3600:>6.2f}{count:>10,}{events:>10,}{count / used:>10,.0f}{memory[-1]:>8.1f}"
            print(told, flush=True)
            line += 1
    return memory[-1] - memory[1] <= GROWS


def spread(states: list[WorldState], recordings: int, minutes: float, jobs: int, noise: float) -> None:
    """Recordings read by processes: world states a second, of the clock and of one processor."""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{number}.jsonl" for number in range(recordings)]
        for seed, file in enumerate(files):
            with file.open("w") as out:
                for world in repeated(states, minutes * 60.0, noise, seed):
                    out.write(json.dumps(world_state_to_json(world)) + "\n")
        count = recordings * int(minutes * 60 * RATE)
        for workers in dict.fromkeys((1, jobs)):
            began, used = time.perf_counter(), time.process_time()
            found = watch_many("kitchen", list(map(str, files)), jobs=workers)
            took = time.perf_counter() - began
            read = sum(row["predicted"] == "lunch" for row in found)
            note = f", {count / (time.process_time() - used):,.0f} of processor time" if workers == 1 else ""
            what = f"{recordings} recordings of {minutes:g} min, {workers} process(es)"
            print(f"{what}: {count / took:,.0f} states/s{note}; {read} read lunch", flush=True)


def main() -> int:
    """Print both tables; exit code 1 when memory grew."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hours", type=float, default=24.0)
    parser.add_argument("--recordings", type=int, default=100)
    parser.add_argument("--minutes", type=float, default=480.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--noise", type=float, default=0.0, help="metres beside the kitchen's own")
    given = parser.parse_args()
    domain = Domain.load("kitchen")
    states = lunch(domain)
    keep_loaded()
    kept = day(domain, states, given.hours, given.noise) if given.hours else True
    if given.recordings:
        spread(states, given.recordings, given.minutes, given.jobs, given.noise)
    print(f"memory: {'constant' if kept else 'NOT constant'}")
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
