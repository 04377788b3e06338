"""The scene of a domain as frozen data: walls, floor, furniture, objects of interest, agents, settings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from casper.kb.errors import DomainError
from casper.kb.terms.numbers import as_float
from casper.sim_adapter.room.settings import HumanSettings, RobotSettings, SensorSettings, SimSettings, settings_from

Rows = Callable[[str, int], Iterable[tuple[Any, ...]]]
Point = tuple[float, float]

FURNITURE_KINDS = ("counter", "table", "cabinet")
MOVABLE_SHAPES = ("box", "cylinder", "dish")
FIXED_SHAPES = ("basin", "panel")
PLACINGS = ("inside", "on_top", "beside")
SIDES = ("north", "south", "east", "west")
WALL = 0.008  # thickness of a dish's floor and rim


@dataclass(frozen=True, slots=True)
class Furniture:
    """A piece of furniture: a box footprint (centre, sizes) up to ``top``; a cabinet has a shelf and an open side."""

    name: str
    kind: str
    x: float
    y: float
    size_x: float
    size_y: float
    top: float
    shelf: float | None = None
    opens: str | None = None

    @property
    def surface(self) -> float:
        """Height of the board things stand on."""
        return self.top if self.shelf is None else self.shelf

    def holds(self, x: float, y: float, margin: float = 0.0) -> bool:
        """Whether the point lies over the footprint, at least ``margin`` inside its edge."""
        return abs(x - self.x) <= self.size_x / 2 - margin and abs(y - self.y) <= self.size_y / 2 - margin


@dataclass(frozen=True, slots=True)
class Thing:
    """An object of interest: where it is at the start, its shape and sizes, its mass (None: it is fixed)."""

    name: str
    x: float
    y: float
    z: float
    shape: str
    size: tuple[float, float, float]
    mass: float | None = None
    placing: str | None = None
    colour: tuple[float, float, float] = (0.6, 0.6, 0.6)

    @property
    def movable(self) -> bool:
        """Whether it can be moved, that is, has a mass."""
        return self.mass is not None

    @property
    def radius(self) -> float:
        """Radius of the round footprint that covers it."""
        half_x, half_y = self.size[0] / 2, self.size[1] / 2
        return max(half_x, half_y) if self.shape in ("cylinder", "dish") else math.hypot(half_x, half_y)

    @property
    def height(self) -> float:
        """Height of the shape."""
        return self.size[2]


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything the simulator builds from; see ``domains/kitchen/scene.pl`` for the facts and their units."""

    outline: tuple[Point, ...]
    walkable: tuple[Point, ...]
    holes: tuple[tuple[float, float, float, float], ...]
    furniture: tuple[Furniture, ...]
    things: Mapping[str, Thing]
    human: str
    robot: str
    starts: Mapping[str, tuple[float, float, float]]
    sim: SimSettings
    human_settings: HumanSettings
    robot_settings: RobotSettings
    sensor: SensorSettings

    @property
    def movables(self) -> tuple[str, ...]:
        """Names of the objects that can be moved, in the scene's order."""
        return tuple(name for name, thing in self.things.items() if thing.movable)

    @property
    def destinations(self) -> tuple[str, ...]:
        """Names of the objects something can be put at, in the scene's order."""
        return tuple(name for name, thing in self.things.items() if thing.placing is not None)

    def thing(self, name: str | None) -> Thing:
        """The object of that name.

        Raises:
            DomainError: no such object in the scene.
        """
        if name is None or name not in self.things:
            raise DomainError(f"the scene has no object {name}; it has {', '.join(self.things)}")
        return self.things[name]


def scene_from(rows: Rows) -> Scene:
    """Read a scene from a domain's facts.

    Raises:
        DomainError: something is missing or contradicts itself; the sentence names the fact that is needed.
    """
    agents = {kind: name for name, kind in rows("body", 2)}
    for kind in ("person", "mobile_manipulator"):
        if kind not in agents:
            raise DomainError(f"the scene has no body(Name, {kind})")
    table = {(group, name): value for group, name, value in rows("setting", 3)}
    starts = {name: (_n(x), _n(y), math.radians(_n(h))) for name, x, y, h in rows("start", 4)}
    robot = agents["mobile_manipulator"]
    if robot not in starts:
        raise DomainError(f"the scene does not say where {robot} starts: start({robot}, X, Y, Heading) is missing")
    scene = Scene(
        outline=_corners(rows, "outline"),
        walkable=_corners(rows, "walkable"),
        holes=tuple((_n(a), _n(b), _n(c), _n(d)) for _, a, b, c, d in rows("hole", 5)),
        furniture=_furniture(rows),
        things=_things(rows),
        human=agents["person"],
        robot=robot,
        starts=starts,
        sim=settings_from(SimSettings, "sim", table),
        human_settings=settings_from(HumanSettings, "human", table),
        robot_settings=settings_from(RobotSettings, "robot", table),
        sensor=settings_from(SensorSettings, "sensor", table),
    )
    return scene


def _corners(rows: Rows, name: str) -> tuple[Point, ...]:
    corners = tuple((_n(x), _n(y)) for _, x, y in sorted(rows(name, 3)))
    if len(corners) < 3:
        raise DomainError(f"the scene needs at least three corners {name}(Number, X, Y); it has {len(corners)}")
    return corners


def _furniture(rows: Rows) -> tuple[Furniture, ...]:
    shelves: dict[str, Any] = dict(rows("shelf", 2))
    sides: dict[str, Any] = dict(rows("opens", 2))
    pieces = []
    for name, kind, x, y, size_x, size_y, top in rows("furniture", 7):
        if kind not in FURNITURE_KINDS:
            raise DomainError(f"furniture {name} is a {kind}; it must be one of {', '.join(FURNITURE_KINDS)}")
        if kind == "cabinet":
            _needs(name, shelves, f"shelf({name}, Height)")
            _needs(name, sides, f"opens({name}, Side)")
            _one_of(name, sides[name], SIDES)
        shelf = _n(shelves[name]) if name in shelves else None
        numbers = (_n(x), _n(y), _n(size_x), _n(size_y), _n(top))
        pieces.append(Furniture(name, kind, *numbers, shelf, sides.get(name)))
    return tuple(pieces)


def _things(rows: Rows) -> dict[str, Thing]:
    shapes = {name: (kind, (_n(x), _n(y), _n(z))) for name, kind, x, y, z in rows("shape", 5)}
    masses = {name: _n(mass) for name, mass in rows("mass", 2)}
    placings: dict[str, str] = dict(rows("placing", 2))
    colours = {name: (_n(r), _n(g), _n(b)) for name, r, g, b in rows("colour", 4)}
    things: dict[str, Thing] = {}
    for name, x, y, z in rows("position", 4):
        _needs(name, shapes, f"shape({name}, Kind, SizeX, SizeY, SizeZ)")
        kind, size = shapes[name]
        _one_of(name, kind, MOVABLE_SHAPES if name in masses else FIXED_SHAPES)
        if name in placings:
            _one_of(name, placings[name], PLACINGS)
        colour = colours.get(name, (0.6, 0.6, 0.6))
        things[name] = Thing(name, _n(x), _n(y), _n(z), kind, size, masses.get(name), placings.get(name), colour)
    if not things:
        raise DomainError("the scene has no object: position(Name, X, Y, Z) is missing")
    for name in (*shapes, *masses, *placings):
        _needs(name, things, f"position({name}, X, Y, Z)")
    return things


def _needs(name: str, table: Mapping[str, Any], fact: str) -> None:
    if name not in table:
        raise DomainError(f"the scene says nothing of {name} here: {fact} is missing")


def _one_of(name: str, value: Any, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise DomainError(f"{name} cannot be {value}; it must be one of {', '.join(allowed)}")


def _n(value: Any) -> float:
    if not math.isfinite(as_float(value)):
        raise DomainError(f"the scene needs a number where it has {value!r:.40}")
    return as_float(value)
