"""The sensors that a mind is tried with: one quantity at a time from good to bad, and a cheap camera, poor in several.

A row is a name, what it is called, seconds between two world states, and settings of the simulated eye.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

PERIOD = 0.5
DEFAULT, CHEAP = "default", "cheap"


@dataclass(frozen=True)
class Sensor:
    """``value`` is the quantity's, in the unit of its family."""

    name: str
    tells: str
    value: float = 0.0
    period: float = PERIOD
    eye: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Family:
    """A quantity on its own: what it is called, its unit, what the kitchen's own sensor has, rows from good to bad."""

    quantity: str
    unit: str
    own: float
    rows: tuple[Sensor, ...]


def _family(stem: str, quantity: str, unit: str, own: float, setting: str, values: dict[str, float]) -> Family:
    """Rows ``stem_VALUE`` for values in the unit, each with that of the eye's setting."""
    space = "" if unit == "°" else " "
    rows = (
        Sensor(f"{stem}_{shown}", f"{quantity} {shown}{space}{unit}", float(shown), eye={setting: value})
        for shown, value in values.items()
    )
    return Family(quantity, unit, own, tuple(rows))


def _shares(*percent: int) -> dict[str, float]:
    return {str(p): p / 100 for p in percent}


FAMILIES = (
    _family("noise", "position noise", "cm", 1.0, "noise", _shares(0, 3, 4, 6, 8, 10)),
    _family("drop", "detections lost", "%", 2.0, "drop", _shares(0, 15, 30, 45, 60)),
    Family(
        "time between two states",
        "s",
        PERIOD,
        tuple(Sensor(f"period_{s:g}", f"a state every {s:g} s", s, s) for s in (0.1, 0.2, 1.0, 2.0)),
    ),
    _family("misread", "hands misread", "%", 1.0, "hold_misread", _shares(0, 5, 10, 20)),
    _family("heading", "heading noise", "°", 2.0, "heading_noise", {str(d): float(d) for d in (0, 8, 15, 30)}),
    _family("view", "field of view", "°", 95.0, "field_of_view", {str(d): float(d) for d in (120, 70, 50)}),
)
ALONE = (
    Sensor(DEFAULT, "the kitchen's own: 1 cm, 2 % lost, 1 % misread, a state every 0.5 s"),
    Sensor(
        CHEAP,
        "cheap camera: 4 cm, 30 % lost, 10 % misread, a state every 0.2 s",
        period=0.2,
        eye={"noise": 0.04, "drop": 0.3, "hold_misread": 0.1},
    ),
)


def sensors() -> dict[str, Sensor]:
    """All of them by name, in the order of the table."""
    return {sensor.name: sensor for sensor in _in_order()}


def _in_order() -> Iterator[Sensor]:
    yield ALONE[0]
    for family in FAMILIES:
        yield from family.rows
    yield ALONE[1]
