"""Emergency response in figures: which goal leads at half of its actions and at the end, and what an observation takes.

    python benchmarks/day/monroe.py [--episodes N] [--kept N] [--seed N] [--missed N]

The figures are of a plain beam: the best so many states are kept, by how few leaves they miss and how many ways there
were to go on; the leading goal has most of the weight.
"""

from __future__ import annotations

import argparse
import gc
import statistics
import time
from collections.abc import Iterator

from emergencies import Episode, Episodes
from flood import domain

from casper.engine.domain.domain import Domain
from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.state import State
from casper.engine.live.memory import Uninterrupted, keep_loaded
from casper.engine.verification.observation import observation_of


class Beam:
    """The best states of an episode: weight by state, a share of it for every way in which an observation is taken."""

    def __init__(self, networks: Networks, kept: int, unseen: float = 0.05) -> None:
        self.networks, self.kept, self.unseen, self.seen, self.lost = networks, kept, unseen, 0, 0
        self.weights: dict[State, float] = {networks.begin(goal): 1.0 for goal in range(len(networks.goals))}

    def observe(self, seen: object) -> None:
        """Go on by one observation; where nothing takes it, everything is as it was."""
        after: dict[State, float] = {}
        self.seen += 1
        for state, weight in self.weights.items():
            share = weight / max(1, self.networks.choices(state))
            for step in self.networks.steps(state, seen, None):  # type: ignore[arg-type]
                after[step.state] = after.get(step.state, 0.0) + share * step.part * self.unseen**step.missed
        best = sorted(after.items(), key=lambda pair: -pair[1] * self.grown(pair[0]))[: self.kept]
        whole = sum(weight for _, weight in best)
        self.lost += not best
        self.weights = {state: weight / whole for state, weight in best} or self.weights

    def grown(self, state: State) -> float:
        """The share of a plan that was seen: what is long for the little that speaks for it is less likely."""
        return self.seen / (self.seen + self.networks.least_left(state))

    def leading(self) -> str:
        """The goal with most weight."""
        totals: dict[int, float] = {}
        for state, weight in self.weights.items():
            totals[state.goal] = totals.get(state.goal, 0.0) + weight * self.grown(state)
        return self.networks.goals[max(totals, key=totals.__getitem__)]


def networks_of(flood: Domain, missed: int) -> Networks:
    """How its goals go on."""
    library = flood.library
    goals = list(zip(library.goals, [goal for goal, _ in library.goal_terms]))
    return Networks(library.tables, goals, Asking(flood.kb), flood.partner, flood.robot, most_missed=missed)


def measured(networks: Networks, flood: Domain, episodes: list[Episode], kept: int) -> Iterator[tuple[str, object]]:
    """The figures, by name."""
    half = end = lost = 0
    times: list[float] = []
    for episode in episodes:
        gc.collect()  # as `casper.engine.live.memory.tidied` does
        beam = Beam(networks, kept)
        for number, action in enumerate(episode.actions, 1):
            seen = observation_of(action, flood.library.actions)
            start = time.process_time()
            with Uninterrupted():  # as a live mind takes in a step
                beam.observe(seen)
            times.append(time.process_time() - start)
            if number == (len(episode.actions) + 1) // 2:
                half += beam.leading() == episode.goal
        lost += beam.lost > 0
        end += beam.leading() == episode.goal
    times.sort()
    lengths = [len(episode.actions) for episode in episodes]
    yield "episodes", f"{len(episodes)} of {min(lengths)} to {max(lengths)} actions"
    yield "leads at half", f"{half} of {len(episodes)}"
    yield "leads at the end", f"{end} of {len(episodes)}"
    yield "nothing kept took an observation", f"in {lost}"
    yield "an observation, median", f"{statistics.median(times) * 1e3:.1f} ms"
    yield "99 of 100", f"{times[int(0.99 * len(times))] * 1e3:.1f} ms"
    yield "the longest", f"{times[-1] * 1e3:.1f} ms"
    yield "cut", networks.was_cut


def main() -> None:
    """Make episodes, read them, print the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=100)
    parser.add_argument("--kept", type=int, default=20)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--missed", type=int, default=0)
    chosen = parser.parse_args()
    start = time.process_time()
    flood = domain()
    keep_loaded()
    library = flood.library
    print(f"{len(library.goals)} goals, {len(library.tasks)} tasks, {len(library.productions)} methods")
    print(f"loaded in {time.process_time() - start:.2f} s")
    makes = Episodes(chosen.seed)
    episodes = [makes.make() for _ in range(chosen.episodes)]
    for name, figure in measured(networks_of(flood, chosen.missed), flood, episodes, chosen.kept):
        print(f"{name}: {figure}")


if __name__ == "__main__":
    main()
