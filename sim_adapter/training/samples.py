"""Training data for the movement classifier (paper section IV-B): scripted trials, seen through the robot's eye.

The script that moves the human gives the labels; the features are what the mind perceives, never touched by a label.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from casper.engine.domain.domain import Domain
from casper.engine.movements.movements import features
from casper.engine.movements.tree import Sample
from casper.engine.perception.focus import FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, perception_settings
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.settings import check_seed
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.training.training import training_script

LOOKS = 5  # at the script during a period between two world states
LONGEST = 180.0  # simulated seconds after which a trial is cut off


def training_samples(domain: Domain, trials: int, seed: int, *, step_back: bool = True) -> Iterator[Sample]:
    """The samples of ``trials`` random trials, one per world state; the same seed gives the same samples.

    Raises:
        DomainError: the domain lacks a scene, or a seed that is no whole number from 0.
    """
    check_seed(seed)
    scene = scene_of(domain)
    for trial in range(trials):
        yield from _trial(domain, scene, trial, seed * 1000 + trial, step_back)


def _trial(domain: Domain, scene: Scene, trial: int, seed: int, step_back: bool) -> Iterator[Sample]:
    simulation = Simulation(scene, seed=seed)
    simulation.human.do(training_script(scene, np.random.default_rng(seed), step_back=step_back))
    rows = domain.kb.rows
    tracker = Tracker(tracker_settings(rows))
    perception = Perception(perception_settings(rows), domain.partner)
    focus = FocusEstimator(focus_settings(rows))
    while simulation.time < LONGEST:
        label = _label_of_period(simulation, scene.sim.period)
        if simulation.human.idle:
            return
        relations = perception.update(tracker.update(simulation.observe()))
        if relations is not None and relations.moving is not None:
            seen = features(relations, focus.update(relations))
            yield Sample(trial, seen, label)


def _label_of_period(simulation: Simulation, period: float) -> str:
    """What the script did for most of the period, as the features speak of the whole period too."""
    labels: Counter[str] = Counter()
    for _ in range(LOOKS):
        simulation.advance(period / LOOKS)
        labels[simulation.human.movement] += 1
    return labels.most_common(1)[0][0]
