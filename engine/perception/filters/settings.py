"""What the tracker mends, and from when on a sensor is filtered."""

from __future__ import annotations

from dataclasses import dataclass

from casper.engine.settings import Rows, read_settings, require


@dataclass(frozen=True, slots=True)
class TrackerSettings:
    """What the tracker mends.

    enabled: off passes world states through. gate: metres within which a detection of a resting object is
    noise and is averaged. memory: over how many detections at most. outliers: so many detections in a row
    outside the gate mean that it moved. agent_smoothing: weight of the previous estimate of an agent's
    position, 0 is off. hold_bridge: for how many steps a hand that seems empty still holds. hold_confirm:
    how many steps in a row an object must be seen in the hand to count as held. agent_bridge: seconds an
    agent that is out of sight is thought to go on as it went; 0 leaves it absent.

    association: ``name``, or ``nearest`` where the numbers of names say nothing
    (`engine.perception.filters.association`).

    steady: whether a sensor that is found to be poor is filtered (`engine.perception.filters`). It is poor from
    steady_noise metres of noise, steady_lost lost detections (a share), or steady_period seconds from state to state.
    It is then told at a pace of seconds, with a lag of seconds at least.
    """

    enabled: bool = True
    gate: float = 0.15
    memory: int = 50
    outliers: int = 2
    agent_gate: float = 0.08
    hold_bridge: int = 1
    hold_confirm: int = 1
    agent_bridge: float = 2.0
    association: str = "name"
    steady: bool = True
    steady_noise: float = 0.02
    steady_lost: float = 0.12
    steady_period: float = 1.2
    pace: float = 0.5
    lag: float = 1.5

    def __post_init__(self) -> None:
        for name in ("gate", "agent_gate", "agent_bridge", "steady_noise", "steady_lost", "steady_period", "lag"):
            require(getattr(self, name) >= 0.0, f"{name} of the tracker must not be negative")
        require(self.association in ("name", "nearest"), f"association is name or nearest, not {self.association}")
        require(self.pace > 0.0, "pace of the tracker must be above 0")
        require(self.memory >= 1 and self.outliers >= 1, "memory and outliers of the tracker start at 1")
        require(self.hold_bridge >= 0 and self.hold_confirm >= 1, "hold_bridge starts at 0, hold_confirm at 1")


def tracker_settings(rows: Rows) -> TrackerSettings:
    """Settings from facts ``setting(tracking, Name, Value)``.

    Raises:
        DomainError: an unknown setting or a value of the wrong kind.
    """
    return read_settings(TrackerSettings, rows, "tracking")
