"""The settings of every stage with their defaults, as the stages' own dataclasses have them."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from casper.engine.actions.prediction import ActionSettings
from casper.engine.episodes.prices import Prices
from casper.engine.perception.focus import FocusSettings
from casper.engine.perception.perception import PerceptionSettings
from casper.engine.perception.tracking import TrackerSettings
from casper.engine.verification.history import HistorySettings
from casper.sim_adapter.room.settings import HumanSettings, RobotSettings, SensorSettings, SimSettings

STAGES: Mapping[str, Any] = {
    "perception": PerceptionSettings,
    "tracking": TrackerSettings,
    "focus": FocusSettings,
    "actions": ActionSettings,
    "verification": HistorySettings,
    "plans": Prices,
    "sim": SimSettings,
    "human": HumanSettings,
    "robot": RobotSettings,
    "sensor": SensorSettings,
}


@dataclass(frozen=True, slots=True)
class Setting:
    """One setting: its stage, its name, its default as text ('' where it has none), and what its stage says."""

    section: str
    name: str
    default: str
    about: str


@cache
def settings() -> tuple[Setting, ...]:
    """Every setting there is."""
    found = []
    for section, stage in STAGES.items():
        about = inspect.cleandoc(stage.__doc__ or "")
        for each in dataclasses.fields(stage):
            default = each.default
            if default is not dataclasses.MISSING and not isinstance(default, (str, int, float)):
                continue  # other facts give it
            told = (
                ""
                if default is dataclasses.MISSING
                else str(default).lower()
                if default in (True, False)
                else f"{default}"
            )
            found.append(Setting(section, each.name, told, about))
    agents = "Who is watched, and who helps: the name of somebody there is."
    found += [Setting("agents", name, "", agents) for name in ("partner", "robot")]
    found.append(Setting("plans", "recursion", "", "How deep plans that contain themselves are unrolled."))
    return tuple(found)


def setting_named(section: str, name: str) -> Setting | None:
    """The setting of a section with a name."""
    return next((each for each in settings() if (each.section, each.name) == (section, name)), None)
