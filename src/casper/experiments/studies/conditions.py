"""Conditions of the robustness study: a condition is a row of settings, one level of each factor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from casper.experiments.experiment import Asked, Trial
from casper.experiments.trials import trials_of
from casper.sim_adapter.partners.behaviours.table import MIXED, NAMES, PLAIN


@dataclass(frozen=True, slots=True)
class Level:
    """What one level of a factor sets: fields of a trial, and settings of the domain."""

    trial: Mapping[str, Any] = field(default_factory=dict)
    settings: Mapping[str, float] = field(default_factory=dict)


CHEAP = {"sensor.noise": 0.04, "sensor.drop": 0.3, "sensor.hold_misread": 0.1, "sim.period": 0.2}
FACTORS: Mapping[str, Mapping[str, Level]] = {
    "partner": {name: Level({"partner": name} if name != PLAIN else {}) for name in NAMES},
    "sensor": {
        "as it is": Level(),
        "3 cm noise": Level({}, {"sensor.noise": 0.03}),
        "6 cm noise": Level({}, {"sensor.noise": 0.06}),
        "cheap camera": Level({}, CHEAP),
    },
    "frame rate": {
        "2 a second": Level(),
        "5 a second": Level({}, {"sim.period": 0.2}),
        "1 in 2 seconds": Level({}, {"sim.period": 2.0}),
    },
    "walking": {
        "0.6 m/s": Level(),
        "0.3 m/s": Level({}, {"human.walk_speed": 0.3}),
        "1.0 m/s": Level({}, {"human.walk_speed": 1.0}),
    },
    "verification": {"on": Level(), "off": Level({"verification": False})},
}
"""The factors; the first level of each is how the kitchen is. A cheap camera has 4 cm of noise, loses 30 %, misreads
the hand in 10 %, and sees five times a second."""


@dataclass(frozen=True, slots=True)
class Condition:
    """One level of each factor, by name."""

    levels: Mapping[str, str]

    @property
    def name(self) -> str:
        """Where it differs from how the kitchen is."""
        others = [f"{factor}: {level}" for factor, level in self.levels.items() if level != usual(factor)]
        return ", ".join(others) or "as it is"

    def trials(self, asked: Asked, count: int, **how: Any) -> list[Trial]:
        """Its trials, goals in turn."""
        found = [FACTORS[factor][level] for factor, level in self.levels.items()]
        settings = {name: value for level in found for name, value in level.settings.items()}
        fields = {name: value for level in found for name, value in level.trial.items()}
        rest: dict[str, Any] = {**fields, **how, **({"settings": settings} if settings else {})}
        return trials_of(asked, count, **rest)

    @property
    def alone(self) -> Condition:
        """The same partner at the same pace, whoever looks on."""
        kept = ("partner", "walking")
        return Condition({f: level if f in kept else usual(f) for f, level in self.levels.items()})


def usual(factor: str) -> str:
    """The level of a factor that the kitchen has."""
    return next(iter(FACTORS[factor]))


def partners() -> Iterator[Condition]:
    """The kitchen as it is, with each way to behave."""
    base = {factor: usual(factor) for factor in FACTORS}
    yield from (Condition({**base, "partner": name}) for name in FACTORS["partner"])


def one_at_a_time() -> Iterator[Condition]:
    """How the kitchen is, every other level of each factor beside that, and mixed partners without verification."""
    base = {factor: usual(factor) for factor in FACTORS}
    yield Condition(base)
    for factor, levels in FACTORS.items():
        yield from (Condition({**base, factor: level}) for level in levels if level != usual(factor))
    yield Condition({**base, "partner": MIXED, "verification": "off"})


def crossed() -> Iterator[Condition]:
    """Every level of each factor with every level of all others."""
    for levels in product(*FACTORS.values()):
        yield Condition(dict(zip(FACTORS, levels)))
