"""How the robot's gripper takes hold of an object: where, how wide, and whether the fingers touch it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import bearing
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import WALL, Point, Thing

RIM_DEPTH = 0.006  # fingertips' reference this far below the rim: the tips stay clear of a dish's floor
BODY_DEPTH = 0.03


@dataclass(frozen=True, slots=True)
class Grip:
    """Fingertips ``out`` from the middle towards the robot and ``up`` from it; what is between is ``width`` wide."""

    out: float
    up: float
    width: float

    @property
    def is_rim(self) -> bool:
        """Whether it is the rim that is taken, not the whole."""
        return self.out > 0.0

    def point(self, physics: Physics, name: str, robot: Point) -> Spot:
        """Where the fingertips belong now."""
        x, y, z = physics.position(name)
        near = bearing((x, y), robot)
        return x + self.out * math.cos(near), y + self.out * math.sin(near), z + self.up


def grip_of(thing: Thing) -> Grip:
    """A dish is pinched at the rim nearest the robot, everything else is taken round the top."""
    if thing.shape == "dish":
        return Grip(thing.radius - WALL / 2, thing.height / 2 - RIM_DEPTH, WALL)
    return Grip(0.0, thing.height / 2 - min(BODY_DEPTH, thing.height / 2), max(thing.size[:2]))


def touching(physics: Physics, robot: str, thing: str) -> bool:
    """Whether a finger touches the object."""
    fingers = {physics.body_id(f"{robot}:{side}_finger") for side in ("inner", "outer")}
    body, owner = physics.body_id(thing), physics.model.geom_bodyid
    for contact in physics.data.contact:
        pair = {int(owner[contact.geom1]), int(owner[contact.geom2])}
        if body in pair and pair & fingers:
            return True
    return False
