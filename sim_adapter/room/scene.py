"""The scene of a domain as frozen data: walls, floor, furniture, objects of interest, agents, settings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from casper.kb.errors import DomainError
from casper.sim_adapter.room.settings import HumanSettings, RobotSettings, SensorSettings, SimSettings

Point = tuple[float, float]

FURNITURE_KINDS = ("counter", "table", "cabinet")
MOVABLE_SHAPES = ("box", "cylinder", "dish")
FIXED_SHAPES = ("basin", "panel")
PLACINGS = ("inside", "on_top", "beside")
SIDES = ("north", "south", "east", "west")
BODY = "primitive"  # the robot's, where nobody asks for another one
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

    @property
    def footprint(self) -> tuple[float, float, float, float]:
        """The floor it takes up: least x and y, greatest x and y."""
        half_x, half_y = self.size_x / 2, self.size_y / 2
        return self.x - half_x, self.y - half_y, self.x + half_x, self.y + half_y

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
    """Everything the simulator builds from; ``docs/rooms.md`` has the facts and their units.

    ``people`` are those who are watched, ``starts`` x, y, heading (radians) of those whose start is said, ``body`` is
    the robot's (`sim_adapter.physics.bodies`).
    """

    outline: tuple[Point, ...]
    walkable: tuple[Point, ...]
    holes: tuple[tuple[float, float, float, float], ...]
    furniture: tuple[Furniture, ...]
    things: Mapping[str, Thing]
    people: tuple[str, ...]
    robot: str
    starts: Mapping[str, tuple[float, float, float]]
    sim: SimSettings
    human_settings: HumanSettings
    robot_settings: RobotSettings
    sensor: SensorSettings
    body: str = BODY

    @property
    def human(self) -> str:
        """The first of the people."""
        return self.people[0]

    @property
    def middle(self) -> Point:
        """The middle of the room, where it is widest."""
        (left, right), (front, back) = self.extent
        return (left + right) / 2, (front + back) / 2

    @property
    def extent(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """From where to where the room goes, east and north."""
        xs, ys = zip(*self.outline)
        return (min(xs), max(xs)), (min(ys), max(ys))

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
