"""Training data for the movement classifier (paper section IV-B): scripted trials, seen through the robot's eye.

The script that moves the human gives the labels; the features are what the mind perceives, never touched by a label.
One trial may be seen through several eyes at once, of other noise and another rate.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from casper.engine.domain.domain import Domain
from casper.engine.movements.features import Features, Seen
from casper.engine.movements.tree import Sample
from casper.engine.movements.watching import Recording, samples_of
from casper.engine.perception.world import WorldState
from casper.engine.settings import check_seed, require
from casper.sim_adapter.eye.sensors import Sensor
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.training.training import training_script

LOOK = 0.1  # seconds between two looks at the script
LONGEST = 180.0  # simulated seconds after which a trial is cut off


@dataclass(frozen=True, slots=True)
class Eye:
    """A sensor to train for: noise of positions in metres (None: the scene's), seconds between two world states."""

    noise: float | None = None
    period: float | None = None

    def __post_init__(self) -> None:
        require(self.noise is None or 0.0 <= self.noise <= 1.0, f"noise lies between 0 and 1 m, not {self.noise}")
        require(self.period is None or LOOK <= self.period <= 10.0, f"a period is {LOOK} to 10 s, not {self.period}")

    def named(self, scene: Scene) -> str:
        """What its samples are called in a scene: ``6 cm, 0.5 s``."""
        noise = scene.sensor.noise if self.noise is None else self.noise
        return f"{100 * noise:g} cm, {self.period or scene.sim.period:g} s"


OWN = Eye()
MANY = tuple(Eye(noise, period) for noise in (None, 0.03, 0.06, 0.1) for period in (0.2, None, 1.0))
"""The scene's own sensor and poorer ones, at several rates."""


def training_samples(
    domain: Domain,
    trials: int,
    seed: int,
    *,
    step_back: bool = True,
    eyes: Sequence[Eye] = (OWN,),
    kind: type[Seen] = Features,
    uses: bool = False,
) -> Iterator[Sample]:
    """The samples of ``trials`` random trials, one per world state; the same seed gives the same samples.

    ``kind`` are the features; all else is as for `training_recordings`.
    """
    for recorded in training_recordings(domain, trials, seed, step_back=step_back, eyes=eyes, uses=uses):
        yield from samples_of(recorded, domain.kb.rows, domain.partner, kind)


def training_recordings(
    domain: Domain,
    trials: int,
    seed: int,
    *,
    step_back: bool = True,
    eyes: Sequence[Eye] = (OWN,),
    uses: bool = False,
) -> Iterator[list[Recording]]:
    """The recordings of ``trials`` random trials, trial by trial; the same seed gives the same ones.

    Args:
        domain: where, and with which settings of the stages.
        trials: how many.
        seed: of the first.
        step_back: as for `training_script`.
        eyes: through which sensors; one trial is seen through all of them.
        uses: whether in every other trial what was brought is also used.

    Raises:
        DomainError: the domain lacks a scene, or a seed that is no whole number from 0.
    """
    check_seed(seed)
    scene = scene_of(domain)
    for trial in range(trials):
        yield _trial(scene, trial, seed * 1000 + trial, step_back, uses and trial % 2 == 1, eyes)


def _trial(
    scene: Scene, trial: int, seed: int, step_back: bool, uses: bool, eyes: Sequence[Eye]
) -> list[Recording]:
    """One trial, recorded through each eye."""
    simulation = Simulation(scene, seed=seed)
    simulation.human.do(training_script(scene, np.random.default_rng(seed), step_back=step_back, uses=uses))
    sensors = [_sensor(simulation, eye, seed, at) for at, eye in enumerate(eyes)]
    states: list[list[WorldState]] = [[] for _ in eyes]
    labels: list[tuple[float, str]] = []
    every = [round((eye.period or scene.sim.period) / LOOK) for eye in eyes]
    people = simulation.people.items()
    while simulation.time < LONGEST and not simulation.human.idle:
        simulation.advance(LOOK)
        labels.append((simulation.time, simulation.human.movement))
        poses = {name: (human.x, human.y, human.heading) for name, human in people}
        for sensor, found, steps in zip(sensors, states, every):
            if len(labels) % steps == 0:
                found.append(sensor.observe(poses, simulation.robot.pose, simulation.robot.holding))
    named = [eye.named(scene) if len(eyes) > 1 else "" for eye in eyes]
    return [Recording(trial, found, labels, level) for found, level in zip(states, named)]


def _sensor(simulation: Simulation, eye: Eye, seed: int, at: int) -> Sensor:
    """The robot's own, or one like it of another noise, in the same head."""
    if eye.noise is None and at == 0:
        return simulation.sensor
    sensor = Sensor(simulation.physics, np.random.default_rng([seed, 1000 + at]))
    if eye.noise is not None:
        sensor.settings = replace(sensor.settings, noise=eye.noise)
    return sensor
