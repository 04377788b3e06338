"""The simulated human's body: where it stands, which way it faces, where its hand is, what the script is doing."""

from __future__ import annotations

import math

from casper.sim_adapter.human.pose import CARRY, REST, HumanPose
from casper.sim_adapter.physics.model import hand_name
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import turn
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Point

FAR_OUT = 0.4  # metres before the place where things are carried
HAND_SPEED = 1.0  # m/s of the hand when it swings back by itself


class HumanBody:
    """Kinematic state, handed to the physics by ``show``. ``hand`` is in the body's frame."""

    def __init__(self, physics: Physics, name: str, start: tuple[float, float, float]) -> None:
        self.physics = physics
        self.name = name
        self.settings = physics.scene.human_settings
        self.dt = physics.scene.sim.control
        self.x, self.y, self.heading = start
        self.speed = 0.0
        self.hand: Spot = REST
        self.movement = "still"
        self._pose = HumanPose(physics, self.name)
        self.show(at_once=True)

    @property
    def place(self) -> Point:
        """Where it stands."""
        return self.x, self.y

    @property
    def holding(self) -> str | None:
        """What is in its hand."""
        return self.physics.held_by(self.name)

    def ticks(self, seconds: float) -> int:
        """Control steps in a time, at least one."""
        return max(1, round(seconds / self.dt))

    @property
    def on_the_spot(self) -> str:
        """What standing in front of an object amounts to: a pick with a free hand, a place with a full one."""
        return "pick" if self.holding is None else "place"

    def stand(self, movement: str) -> None:
        """Be where it is for this control step, doing ``movement``."""
        self.movement = movement
        self.speed = 0.0

    def turn_to(self, wanted: float) -> None:
        """One control step of turning; slowly while something is held far out, not to sweep it into a wall."""
        out = 0.0 if self.holding is None else math.dist(self.hand, CARRY)
        most = self.settings.turn_rate * self.dt * max(0.2, 1.0 - out / FAR_OUT)
        self.heading = turn(self.heading + max(-most, min(most, turn(wanted - self.heading))))

    def relax_hand(self) -> None:
        """One control step of the hand back to hanging down, or to carrying what it holds."""
        goal = REST if self.holding is None else CARRY
        gap = math.dist(self.hand, goal)
        if gap > 1e-6:
            self.hand = between(self.hand, goal, min(1.0, HAND_SPEED * self.dt / gap))

    def at(self, name: str) -> Point:
        """Where an object is, on the floor plan."""
        x, y, _ = self.physics.position(name)
        return x, y

    def local(self, point: Spot) -> Spot:
        """A point of the world in the body's frame."""
        dx, dy = point[0] - self.x, point[1] - self.y
        c, s = math.cos(self.heading), math.sin(self.heading)
        return c * dx + s * dy, -s * dx + c * dy, point[2]

    def show(self, *, at_once: bool = False) -> None:
        """Hand the present pose to the physics."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        x, y, z = self.hand
        world = (self.x + c * x - s * y, self.y + s * x + c * y, z)
        self.physics.aim_mocap(self.name, (self.x, self.y, 0.0), self.heading, at_once=at_once)
        self.physics.aim_mocap(hand_name(self.name), world, self.heading, at_once=at_once)
        self._pose.update(self.speed, self.settings.walk_speed, self.hand, self.dt)


def between(start: Spot, goal: Spot, share: float) -> Spot:
    """The point that share of the way."""
    return (
        start[0] + share * (goal[0] - start[0]),
        start[1] + share * (goal[1] - start[1]),
        start[2] + share * (goal[2] - start[2]),
    )
