"""What the robot's eye gets to see: field of view, range, occlusion, noise, drops, and who holds what."""

from __future__ import annotations

import math
from collections.abc import Mapping

import mujoco
import numpy as np

from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.sim_adapter.physics.bodies.body import eye_name
from casper.sim_adapter.physics.model import hand_name
from casper.sim_adapter.physics.parts import FURNITURE, WALLS
from casper.sim_adapter.physics.physics import Physics, Vector
from casper.sim_adapter.physics.room import furniture_name
from casper.sim_adapter.room.geometry import turn
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Thing

PERSON_HEIGHTS = (1.65, 1.3, 1.0)  # a person is seen when any of these points is
SLACK = 0.03
Pose = tuple[float, float, float]
_OPAQUE = np.array([group in (FURNITURE, WALLS) for group in range(6)], dtype=np.uint8)


class Sensor:
    """A seeded model of the camera in the robot's head; ``observe`` draws one noisy world state."""

    def __init__(self, physics: Physics, rng: np.random.Generator) -> None:
        self.physics = physics
        self.scene = physics.scene
        self.settings = self.scene.sensor
        self._rng = rng
        self._geom = np.zeros(1, dtype=np.int32)

    # -- what can be seen -----------------------------------------------------------------------------------------

    def sees_person(self, place: tuple[float, float]) -> bool:
        """Whether a person standing there is in view and not hidden."""
        eye = self.eye
        return any(
            self.in_view((*place, height)) and self.clear(eye, (*place, height), None) for height in PERSON_HEIGHTS
        )

    def sees_thing(self, name: str) -> bool:
        """Whether an object is in view and not hidden; what it stands in or on never hides it."""
        thing, spot = self.scene.thing(name), self.physics.position(name)
        return self.in_view(spot) and visible_from(self, self.eye, thing, spot)

    @property
    def eye(self) -> Vector:
        """Where the camera is."""
        return self.physics.site(eye_name(self.scene.robot))

    def in_view(self, spot: Spot) -> bool:
        """Within the range and the horizontal field of view."""
        eye = self.eye.tolist()
        dx, dy, dz = spot[0] - eye[0], spot[1] - eye[1], spot[2] - eye[2]
        if math.hypot(dx, dy, dz) > self.settings.range:
            return False
        looking = self.physics.looking(eye_name(self.scene.robot))
        return abs(turn(math.atan2(dy, dx) - looking)) <= math.radians(self.settings.field_of_view) / 2

    def clear(self, eye: Vector, spot: Spot, through: str | None) -> bool:
        """Whether nothing opaque lies between, not counting the body ``through``."""
        way = np.asarray(spot) - eye
        gap = float(np.linalg.norm(way))
        skip = -1 if through is None else self.physics.body_id(through)
        model, data = self.physics.model, self.physics.data
        hit = mujoco.mj_ray(model, data, eye, way / gap, _OPAQUE, 1, skip, self._geom)
        return bool(hit < 0 or hit > gap - SLACK)

    # -- the world state ------------------------------------------------------------------------------------------

    def observe(self, people: Mapping[str, Pose], robot: Pose, robot_holds: str | None) -> WorldState:
        """One noisy world state. Poses are x, y, heading (radians); the robot knows its own exactly."""
        objects = {name: spot for name in self.physics.positions() if (spot := self._glimpse(name)) is not None}
        agents = {self.scene.robot: AgentState(*robot, robot_holds)}
        for name, pose in people.items():
            person = self._person(name, pose, objects)
            if person is not None:
                agents[name] = person
        seen = {name: ObjectState(*spot) for name, spot in objects.items()}
        return WorldState(self.physics.time, agents, seen)

    def _glimpse(self, name: str) -> Spot | None:
        """An object's place as detected now, or None."""
        noise, luck = self._rng.normal(0.0, self.settings.noise, 3), self._rng.random()
        if luck < self.settings.drop or not self.sees_thing(name):
            return None
        x, y, z = self.physics.position(name)
        return x + float(noise[0]), y + float(noise[1]), z + float(noise[2])

    def _person(self, name: str, pose: Pose, objects: Mapping[str, Spot]) -> AgentState | None:
        noise, luck = self._rng.normal(0.0, 1.0, 6), self._rng.random()
        misread = self._rng.random() < self.settings.hold_misread
        if luck < self.settings.drop or not self.sees_person(pose[:2]):
            return None
        jitter = self.settings.noise * noise
        hx, hy, hz = self.physics.position(hand_name(name))
        hand = (hx + float(jitter[3]), hy + float(jitter[4]), hz + float(jitter[5]))
        heading = turn(pose[2] + math.radians(self.settings.heading_noise) * float(noise[2]))
        holding = self._holding(hand, objects, misread)
        return AgentState(pose[0] + float(jitter[0]), pose[1] + float(jitter[1]), heading, holding)

    def _holding(self, hand: Spot, objects: Mapping[str, Spot], misread: bool) -> str | None:
        """The detected object the detected hand is at; a misread takes the nearest for held, or a held for free."""
        gaps = {
            name: surface_distance(self.scene.thing(name), spot, hand)
            for name, spot in objects.items()
            if self.scene.thing(name).movable
        }
        nearest = min(gaps, key=gaps.__getitem__, default=None)
        if nearest is None:
            return None
        held = nearest if gaps[nearest] <= self.settings.hold_distance else None
        if not misread:
            return held
        return nearest if held is None else None


def visible_from(sensor: Sensor, eye: Vector, thing: Thing, spot: Spot) -> bool:
    """Whether an object's middle or top can be seen from a point, whatever it stands in or on."""
    x, y, z = spot
    top = z + thing.height / 2 if thing.movable else z
    support = _support(sensor, thing, spot)
    return any(sensor.clear(eye, (x, y, height + 0.01), support) for height in (z, top))


def surface_distance(thing: Thing, spot: Spot, point: Spot) -> float:
    """Distance from a point to the upright cylinder that covers an object; 0 inside."""
    out = math.hypot(point[0] - spot[0], point[1] - spot[1]) - thing.radius
    up = abs(point[2] - spot[2]) - thing.height / 2
    return math.hypot(max(0.0, out), max(0.0, up))


def _support(sensor: Sensor, thing: Thing, spot: Spot) -> str | None:
    """The counter or table an object stands on or is let into; a cabinet's walls do hide what is inside."""
    for piece in sensor.scene.furniture:
        if piece.kind != "cabinet" and piece.holds(spot[0], spot[1]):
            return furniture_name(piece.name)
    return None
