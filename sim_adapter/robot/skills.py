"""The robot's skills, done through its actuators: fetch, carry, place, use, and how each is ended safely.

The world changes while it works. Before every reach it looks where the object is: it waits while another hand holds it,
drives elsewhere when it was moved, is done when somebody has brought it to its place, and tries again what went wrong.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Mapping, Sequence

from casper.sim_adapter.physics.model import hand_name
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.robot.base import RobotBase, never
from casper.sim_adapter.robot.hand import RobotHand
from casper.sim_adapter.room.geometry import Disc, point_to_segment
from casper.sim_adapter.room.navigation import square_on
from casper.sim_adapter.room.placement import Spot, is_placed
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import Missed, OutOfReach, Step, StepFailed, Ticks

RINGS = (0.6, 0.52, 0.64, 0.48, 0.44, 0.66, 0.68, 0.70)  # distances to stand at beside the preferred one
REACH = 0.76  # 2-D distance from the base beyond which the arm is of no use
WAIT_FOR_SPACE = 15.0  # seconds it waits for the best standing places to become free
BESIDE = 0.06  # metres an object must be away from the arm's way at least
MOVED = 0.05  # metres by which something is elsewhere than it was
MOST_MOVED = 5  # times that something is moved away before the robot gives it up
AT_IT = 0.2  # metres within which a hand is at an object
FOLDED = 0.5  # metres before the base within which the fingertips may be while it drives


class RobotSkills:
    """What the robot can do with an object and a place; each takes its time, and raises StepFailed where it fails."""

    def __init__(self, physics: Physics, base: RobotBase, hand: RobotHand) -> None:
        self.physics = physics
        self.scene = physics.scene
        self.name = self.scene.robot
        self.settings = self.scene.robot_settings
        self.base, self.hand = base, hand
        self.found = False  # the step under way had been done by somebody else when its turn came
        self._taken_from: Spot | None = None  # where what is held was grasped
        self._stood = math.inf  # how far from its object it stood last
        self._too_far = math.inf  # from how far the arm did not reach

    @property
    def holding(self) -> str | None:
        """What is in the gripper."""
        return self.physics.held_by(self.name)

    def run(self, step: Step) -> Ticks:
        """A step of one of the skills."""
        target, destination = str(step.target), str(step.destination)
        self.found, self._too_far, self.base.waits = False, math.inf, False
        skills = {"pick_and_place": self._pick_and_place, "use": self._use}
        return skills[step.skill](target, destination)

    def _pick_and_place(self, target: str, destination: str) -> Ticks:
        self._check_gripper(target)
        yield from self._again(lambda: self._carry(target, destination), target)

    def _carry(self, target: str, destination: str) -> Ticks:
        if self.holding is None:
            yield from self._take(target, destination)
            self.found = self.holding is None  # somebody has brought it there
            if self.found:
                return
        yield from self.hand.take_up(target)
        yield from self._bring(target, destination)

    def _use(self, target: str, destination: str) -> Ticks:
        self._check_gripper(target)
        if self.holding is None:
            yield from self._again(lambda: self._take_at(target, destination), target)
        yield from self.hand.scrub(target)
        yield from self.hand.release(target)

    def _check_gripper(self, target: str) -> None:
        if self.holding not in (None, target):
            raise StepFailed(f"the gripper still holds {self.holding}")

    def _again(self, attempt: Callable[[], Ticks], target: str) -> Ticks:
        """Try, and once more after each miss, as often as the setting allows; the last reason is that of the step."""
        for left in reversed(range(1 + round(self.settings.retries))):
            try:
                yield from attempt()
                return
            except Missed as missed:
                if not left:
                    raise
                if isinstance(missed, OutOfReach):
                    self._too_far = min(self._too_far, self._stood)
            yield from self.base.stop()
            if self.holding is None:
                yield from self.hand.back_off(target)

    # --- taking hold ------------------------------------------------------------------------------------------------

    def _take(self, target: str, destination: str) -> Ticks:
        """Grasp an object where it is, unless it comes to its place without the robot."""
        for _ in range(MOST_MOVED):
            yield from self._until_free(target)
            if self._placed(target, destination) or (yield from self._took(target, target)):
                return
        raise StepFailed(f"{target} was moved away again and again")

    def _take_at(self, target: str, destination: str) -> Ticks:
        """Grasp an object at the place where it is to be used; whoever put it there may still have a hand on it."""
        for _ in range(MOST_MOVED):
            yield from self._until_free(target)
            if not self._placed(target, destination):
                raise StepFailed(f"{target} is not at {destination}")
            if (yield from self._took(target, destination)):
                return
        raise StepFailed(f"{target} was moved away again and again")

    def _took(self, target: str, place: str) -> Generator[None, None, bool]:
        """Drive to a place and grasp an object there; False as soon as it is not there any more."""
        at = self.physics.position(target)
        if not (yield from self._approach(place, {target: at, place: self.physics.position(place)})):
            return False
        yield from self._until_clear(target)
        if self._is_elsewhere(target, at):
            return False
        self._taken_from = self.physics.position(target)
        for _ in self.hand.grasp(target):
            if self._is_elsewhere(target, at):
                yield from self.hand.back_off(target)
                return False
            yield
        return True

    def _is_elsewhere(self, name: str, at: Spot) -> bool:
        """Whether an object is no longer where it was, or in another hand, or gone."""
        if name in self.physics.removed or self.physics.holder(name) not in (None, self.name):
            return True
        return math.dist(self.physics.position(name), at) > MOVED

    def _until_free(self, name: str) -> Ticks:
        """Wait while somebody else holds an object."""
        since = self.physics.time
        while self.physics.holder(name) not in (None, self.name):
            if self.physics.time - since > self.settings.patience:
                raise StepFailed(f"{self.physics.holder(name)} keeps holding {name}")
            self.base.waits = True
            yield
            self.base.waits = False
            yield from self.base.step_aside()
        if name in self.physics.removed:
            raise StepFailed(f"{name} is no longer there")

    def _until_clear(self, name: str) -> Ticks:
        """Wait while somebody's hand is at an object: they may be about to take it, or what lies in it."""
        since = self.physics.time
        while (who := self._whose_hand_at(name)) is not None:
            if self.physics.time - since > self.settings.patience:
                raise StepFailed(f"{who} keeps a hand at {name}")
            yield
            yield from self.base.step_aside()

    def _whose_hand_at(self, name: str) -> str | None:
        at = self.physics.position(name)
        reach = AT_IT + self.scene.thing(name).radius
        near = (who for who in self.scene.people if math.dist(self.physics.position(hand_name(who)), at) < reach)
        return next(near, None)

    # --- bringing ---------------------------------------------------------------------------------------------------

    def _bring(self, target: str, destination: str) -> Ticks:
        """Carry what is held to a place, wherever that is, and put it there."""
        for _ in range(MOST_MOVED):
            yield from self._until_free(destination)
            at = self.physics.position(destination)
            if not (yield from self._approach(destination, {destination: at})):
                continue
            yield from self._until_clear(destination)
            if not self._is_elsewhere(destination, at):
                yield from self.hand.put(target, destination)
                return
        raise StepFailed(f"{destination} was moved away again and again")

    def end(self, step: Step) -> Ticks:
        """End a step safely: fold the empty arm, or bring what is held back to where it was taken from."""
        target, spot, self.base.waits = str(step.target), self._taken_from, False
        yield from self.base.stop()
        yield from self.base.halt(0.3)
        if self.holding is None or spot is None:
            yield from self.hand.back_off(target)
        elif step.skill == "use":
            yield from self.hand.lower(target, spot)
        else:
            yield from self.put_away()

    def put_away(self) -> Ticks:
        """Bring what is held, if anything, back to where it was taken from."""
        target, spot = self.holding, self._taken_from
        if target is None or spot is None:
            return
        yield from self.hand.take_up(target)
        yield from self._go_near(target, lambda: (spot[0], spot[1]))
        yield from self.hand.lay(target, spot)

    @property
    def is_at_rest(self) -> bool:
        """Whether nothing need be done to end a step: the gripper is empty and the arm folded."""
        return self.holding is None and math.dist(self.hand.arm.tool, self.physics.body.home) < 0.01

    # --- standing where it can be reached ---------------------------------------------------------------------------

    def _placed(self, target: str, destination: str) -> bool:
        """At its place, and in nobody's hand."""
        where = self.physics.positions()
        return self.physics.holder(target) is None and is_placed(self.scene, where, target, destination)

    def _approach(self, name: str, watched: Mapping[str, Spot]) -> Generator[None, None, bool]:
        """Drive to where an object can be handled, and face it.

        False as soon as one of the objects that are watched is no longer where it was, or in another hand.
        """

        def stale() -> bool:
            return any(self._is_elsewhere(other, at) for other, at in watched.items())

        return (yield from self._go_near(name, lambda: self._at(name), stale))

    def _go_near(
        self, name: str, at: Callable[[], Point], stale: Callable[[], bool] = never
    ) -> Generator[None, None, bool]:
        """Drive to where an object at that point can be handled, and face the point; False when that became stale."""
        if not any(abs(math.dist(self.base.place, at()) - ring) < 0.02 for ring in self._rings):
            yield from self._fold(name)
            if not (yield from self.base.go(lambda others: self._standing(name, at(), others), stale)):
                return False
        yield from self.base.face(at())
        self._stood = math.dist(self.base.place, at())
        if self._stood > REACH:
            raise OutOfReach(f"{name} is out of reach")
        return not stale()

    @property
    def _rings(self) -> list[float]:
        """Distances to stand at, the best first: nearer than where the arm did not reach."""
        rings = (self.settings.stand_distance, *RINGS)
        return [ring for ring in rings if ring < self._too_far - 0.03] or [min(rings)]

    def _fold(self, name: str) -> Ticks:
        """Nothing is driven about with the arm stretched out."""
        if math.hypot(*self.hand.arm.tool[:2]) <= FOLDED:
            return
        held = self.holding
        yield from self.hand.back_off(name) if held is None else self.hand.take_up(held)

    def _standing(self, name: str, at: Point, people: Sequence[Disc]) -> list[Point]:
        """Where to stand for an object: so that nothing is between, after a while of waiting as little as can be."""
        ways, beside = self.base.navigator, self._beside(name, at)
        clear = next((points for ring in self._rings if (points := self._clear(at, ring, beside))), [])
        if clear and self.base.held_up < WAIT_FOR_SPACE:
            return [point for point in clear if ways.free(point, people)]
        points = ways.standing_points(at, self._rings, people)
        most = max((_room(point, at, beside) for point in points), default=0.0)
        return [point for point in points if _room(point, at, beside) >= most - 0.02]

    def _clear(self, at: Point, ring: float, beside: Sequence[Disc]) -> list[Point]:
        """Standing places at that distance from which nothing is in the arm's way."""
        points = square_on(self.scene, at, self.base.navigator.standing_points(at, (ring,)))
        return [point for point in points if _room(point, at, beside) > BESIDE]

    def _beside(self, name: str, at: Point) -> list[Disc]:
        """The other objects round it."""
        others = (other for other in self.scene.movables if other not in (name, self.holding))
        discs = [Disc(*self._at(other), self.scene.thing(other).radius) for other in others]
        return [disc for disc in discs if math.dist((disc.x, disc.y), at) > 0.05]

    def _at(self, name: str) -> Point:
        x, y, _ = self.physics.position(name)
        return x, y


def _room(point: Point, at: Point, beside: Sequence[Disc]) -> float:
    """How far the nearest of some objects is from the straight way between two points."""
    return min((point_to_segment((disc.x, disc.y), (point, at)) - disc.radius for disc in beside), default=math.inf)
