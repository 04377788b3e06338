"""The numbers a scene may set: how the partner, the robot, the robot's eye and the simulation behave."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, TypeVar

from casper.kb.errors import DomainError
from casper.kb.terms.numbers import as_float


@dataclass(frozen=True, slots=True)
class SimSettings:
    """Seconds of a physics step, of a control step, and between two world states."""

    timestep: float = 0.01
    control: float = 0.02
    period: float = 0.5


@dataclass(frozen=True, slots=True)
class HumanSettings:
    """The partner: metres, m/s, rad/s, seconds. The paper's human stops .6 m from what it goes to."""

    radius: float = 0.17
    walk_speed: float = 0.6
    turn_rate: float = 2.5
    stand_distance: float = 0.55
    pause_min: float = 1.0
    pause_max: float = 2.0
    pick_time: float = 2.5
    place_time: float = 3.0
    use_half: float = 3.0
    use_pairs: float = 3


@dataclass(frozen=True, slots=True)
class RobotSettings:
    """The robot: metres, m/s, rad/s, seconds; ``patience`` is how long one part of a skill may take.

    Among people, as gaps between outlines (`sim_adapter.robot.space`): ways keep ``keep_distance`` from them, within
    ``slow_distance`` the robot slows down, to ``slow_speed`` (its base; the arm by the same share), within
    ``stop_distance`` nothing of it moves. ``retries``: how often a grasp or a placement that went wrong is tried again.
    """

    radius: float = 0.28
    drive_speed: float = 0.6
    turn_rate: float = 1.2
    reach_speed: float = 0.3
    stand_distance: float = 0.56
    grasp_distance: float = 0.03
    use_time: float = 5.0
    patience: float = 60.0
    keep_distance: float = 0.2
    slow_distance: float = 0.4
    slow_speed: float = 0.25
    stop_distance: float = 0.1
    retries: float = 2


@dataclass(frozen=True, slots=True)
class SensorSettings:
    """The robot's eye: degrees, metres, degrees/s; noise as standard deviations; drops as probabilities."""

    field_of_view: float = 95.0
    range: float = 7.0
    pan_limit: float = 75.0
    pan_rate: float = 90.0
    noise: float = 0.01
    heading_noise: float = 2.0
    drop: float = 0.02
    hold_distance: float = 0.05
    hold_misread: float = 0.01


S = TypeVar("S", SimSettings, HumanSettings, RobotSettings, SensorSettings)


def settings_from(kind: type[S], group: str, table: dict[tuple[str, str], Any]) -> S:
    """The settings of one group out of ``setting(Group, Name, Value)`` facts; what is not set keeps its default.

    Raises:
        DomainError: an unknown name in this group, or a value that is no number of zero or more.
    """
    known = {field.name for field in fields(kind)}
    values: dict[str, float] = {}
    for (of, name), value in table.items():
        if of != group:
            continue
        if name not in known:
            raise DomainError(f"setting({group}, {name}, …) is unknown; {group} has {', '.join(sorted(known))}")
        if not as_float(value) >= 0:
            raise DomainError(f"setting({group}, {name}, {value!s:.40}) must be a number of zero or more")
        values[name] = as_float(value)
    return kind(**values)
