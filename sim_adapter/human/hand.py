"""What the simulated human does with the hand: take, lift, put down, handle."""

from __future__ import annotations

import math

from casper.sim_adapter.human.body import HumanBody, between
from casper.sim_adapter.human.pose import CARRY
from casper.sim_adapter.human.walk import REACHABLE
from casper.sim_adapter.physics.model import hand_name
from casper.sim_adapter.physics.physics import STILL_SPEED
from casper.sim_adapter.room.geometry import bearing
from casper.sim_adapter.room.placement import Spot, place_spot
from casper.sim_adapter.room.scene import WALL
from casper.sim_adapter.steps import StepFailed, Ticks

HOVER, TOUCH = 0.1, 0.004  # metres above its place at which an object is brought there, and let down to
ARM = 0.75  # metres the arm reaches; farther is a mistake of the script


class HumanHand:
    """Moves the hand of a body that stands still."""

    def __init__(self, body: HumanBody) -> None:
        self.body = body
        self.physics = body.physics
        self.scene = body.physics.scene

    def pick(self, target: str, seconds: float) -> Ticks:
        """Free hand to the object, then hold it."""
        self._must_reach(target)
        x, y, z = self._grip(target)
        yield from self._to((x, y, z + 0.12), 0.8 * seconds, "pick")
        yield from self._to(self._grip(target), 0.2 * seconds, "pick")
        if not self.physics.grasp(self.body.name, target):
            raise StepFailed(f"{self.physics.holder(target)} holds {target}")

    def lift(self) -> Ticks:
        """Straight up, clear of what it stood on; towards the body it comes on the way."""
        x, y, z = self.body.hand
        yield from self._move((x, y, max(z + 0.06, CARRY[2])), 0.25, "pick")

    def put(self, target: str, destination: str, seconds: float) -> Ticks:
        """Bring what is held over its place, lower it, let go when it rests, take the hand back."""
        self._must_reach(destination)
        spot = place_spot(self.scene, self.physics.positions(), target, destination, self.body.place)
        yield from self._lower(target, spot, seconds)

    def lay(self, target: str, spot: Spot, seconds: float) -> Ticks:
        """As `put`, at a spot: where the middle of what is held is to be."""
        if math.dist(self.body.place, spot[:2]) > max(ARM, REACHABLE):
            raise StepFailed(f"the place where {target} was to be set down is out of reach")
        yield from self._lower(target, spot, seconds)

    def handle(self, target: str, seconds: float) -> Ticks:
        """The second half of a use: towards the body, back to where it was, let go."""
        x, y, z = spot = self.physics.position(target)
        near = bearing((x, y), self.body.place)
        away = (x + 0.1 * math.cos(near), y + 0.1 * math.sin(near), z + 0.2)
        yield from self._to(self._hand_for(target, away), 0.35 * seconds, "place")
        yield from self._lower(target, spot, 0.65 * seconds)

    def _lower(self, target: str, spot: Spot, seconds: float) -> Ticks:
        x, y, z = spot
        yield from self._to(self._hand_for(target, (x, y, z + HOVER)), 0.35 * seconds, "place")
        yield from self._to(self._hand_for(target, (x, y, z + TOUCH)), 0.35 * seconds, "place")
        for _ in range(self.body.ticks(1.0)):
            self.body.stand("place")
            yield
            if self.physics.speed(target) < STILL_SPEED:
                break
        self.physics.release(self.body.name)
        x, y, z = self.body.hand
        yield from self._move((x - 0.12, y - 0.05, z + 0.14), 0.15 * seconds, "place")

    def _must_reach(self, name: str) -> None:
        if math.dist(self.body.place, self.body.at(name)) > max(ARM, REACHABLE):
            raise StepFailed(f"{name} is out of reach")

    def _grip(self, name: str) -> Spot:
        """Where the hand holds an object: a dish at the rim nearest the body, else near the top."""
        thing = self.scene.thing(name)
        x, y, z = self.physics.position(name)
        if thing.shape != "dish":
            return x, y, z + thing.height / 2 - 0.02
        near = bearing((x, y), self.body.place)
        reach = thing.radius - WALL / 2
        return x + reach * math.cos(near), y + reach * math.sin(near), z + thing.height / 2

    def _hand_for(self, target: str, spot: Spot) -> Spot:
        """Where the hand must be for the held object's middle to be at a spot."""
        hand, held = self.physics.position(hand_name(self.body.name)), self.physics.position(target)
        return spot[0] + hand[0] - held[0], spot[1] + hand[1] - held[1], spot[2] + hand[2] - held[2]

    def _to(self, goal: Spot, seconds: float, movement: str) -> Ticks:
        yield from self._move(self.body.local(goal), seconds, movement)

    def _move(self, goal: Spot, seconds: float, movement: str) -> Ticks:
        """Move the hand smoothly (least jerk) to a point of the body's frame."""
        start, steps = self.body.hand, self.body.ticks(seconds)
        for step in range(1, steps + 1):
            t = step / steps
            self.body.hand = between(start, goal, t * t * t * (10 - 15 * t + 6 * t * t))
            self.body.stand(movement)
            yield
