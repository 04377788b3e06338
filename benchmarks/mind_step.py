"""How long one step of the mind takes: a world state of the kitchen in, events out (seven objects).

    python benchmarks/mind_step.py [--trials N]

World states of whole lunches are recorded first; then fresh minds take them in, and each update is timed alone.
"""

import argparse
import statistics
import sys
import time

from casper import Domain, Mind
from casper.sim_adapter.trial import Trial, TrialSettings

BOUND = 300.0  # microseconds on average, as the project promises


def recorded(domain: Domain, seed: int) -> list:
    """The world states of one lunch, as the robot's eye saw them."""
    trial = Trial(domain, TrialSettings("lunch", seed, robot=False))
    states = []
    observe = trial.simulation.observe

    def recording():  # type: ignore[no-untyped-def]
        states.append(observe())
        return states[-1]

    trial.simulation.observe = recording  # type: ignore[method-assign]
    for _ in trial.events():
        pass
    return states


def main() -> int:
    """Print the table; exit code 1 when the mean is above the bound."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--trials", type=int, default=5)
    arguments = parser.parse_args()
    domain = Domain.load("kitchen")
    recordings = [recorded(domain, seed) for seed in range(arguments.trials)]
    print("verification  steps   mean µs  median µs  99 % µs  largest µs")
    worst = 0.0
    for verification in (True, False):
        times = []
        for states in recordings * 3:
            mind = Mind(domain, verification=verification)
            for state in states:
                began = time.perf_counter_ns()
                mind.update(state)
                times.append((time.perf_counter_ns() - began) / 1000)
        times.sort()
        mean = statistics.fmean(times)
        worst = max(worst, mean)
        row = (mean, statistics.median(times), times[int(0.99 * len(times))], times[-1])
        print(f"{'on' if verification else 'off':<12} {len(times):6d}  " + "  ".join(f"{x:9.1f}" for x in row))
    print(f"\nbound: {BOUND:.0f} µs on average; {'held' if worst <= BOUND else 'NOT held'}")
    return int(worst > BOUND)


if __name__ == "__main__":
    sys.exit(main())
