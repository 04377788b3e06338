"""The robot's skills, done through its actuators: fetch, carry, place, use; and watching the partner meanwhile."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from casper.kb.errors import DomainError
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.robot.arm import RobotArm
from casper.sim_adapter.robot.base import RobotBase
from casper.sim_adapter.robot.hand import RobotHand
from casper.sim_adapter.robot.head import RobotHead
from casper.sim_adapter.room.geometry import Disc, point_to_segment, turn
from casper.sim_adapter.room.navigation import Navigator, square_on
from casper.sim_adapter.room.placement import Spot, is_placed
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import Step, StepFailed, StepQueue, Ticks, Worker, check_objects

ROBOT_SKILLS = ("pick_and_place", "use")
RINGS = (0.6, 0.52, 0.64, 0.48, 0.44, 0.66, 0.68, 0.70)  # distances to stand at beside the preferred one
REACH = 0.76  # 2-D distance from the base beyond which the arm is of no use
WAIT_FOR_SPACE = 15.0  # seconds it waits for the best standing places to become free
BESIDE = 0.06  # metres an object must be away from the arm's way at least


class Robot(Worker):
    """Does steps one after another, and watches from its ``post`` when there are none.

    Args:
        physics: the world it acts in.
        navigator: ways for its base.
        start: x, y (metres), heading (radians).
        others: gives the discs of those to keep away from.
    """

    def __init__(
        self,
        physics: Physics,
        navigator: Navigator,
        start: tuple[float, float, float],
        others: Callable[[], Sequence[Disc]],
    ) -> None:
        self.physics = physics
        self.scene = physics.scene
        self.name = self.scene.robot
        self.settings = self.scene.robot_settings
        self.base = RobotBase(physics, navigator, start, others)
        self.arm = RobotArm(physics, self.name)
        self.arm.settle()
        self.hand = RobotHand(physics, self.base, self.arm)
        self.head = RobotHead(physics, self.name)
        self.post: Point | None = None
        self.queue = StepQueue()
        self._dt = self.scene.sim.control
        self._skill: Ticks | None = None
        self._ending = False  # the step under way is being ended
        self._taken_from: Spot | None = None  # where what is held was grasped
        self._watching: Ticks | None = None

    @property
    def pose(self) -> tuple[float, float, float]:
        """x, y (metres), heading (radians)."""
        return self.base.pose

    @property
    def holding(self) -> str | None:
        """What is in the gripper."""
        return self.physics.held_by(self.name)

    def do(self, steps: Iterable[Step]) -> None:
        """Queue steps.

        Raises:
            DomainError: a skill it does not have, or an object that cannot be handled so.
        """
        for step in steps:
            if step.skill not in ROBOT_SKILLS:
                raise DomainError(f"{self.name} has no skill {step.skill}; it has {', '.join(ROBOT_SKILLS)}")
            check_objects(self.scene, step)
            self.queue.waiting.append(step)

    def leave(self, steps: Sequence[Step]) -> None:
        """Leave steps undone: those not begun are forgotten, one under way is ended safely.

        What the robot holds then is brought back to where it took it from.
        """
        self.queue.drop(steps)
        current = self.queue.current
        if current is not None and current in steps and not self._ending:
            self._ending, self._skill = True, self._end(current)

    def tick(self) -> None:
        """One control step."""
        if self._skill is None and self.queue.waiting:
            self.queue.current = self.queue.waiting.popleft()
            self._skill, self._watching = self._run(self.queue.current), None
        if self._skill is not None:
            self._advance(self._skill)
        else:
            self._watch()
        self.head.update(self.base.pose)
        self.base.update()
        self.arm.update()

    def _advance(self, skill: Ticks) -> None:
        try:
            next(skill)
        except StopIteration:
            self._over(None)
        except StepFailed as reason:
            self._over(str(reason))
            while self.queue.waiting:
                self.queue.failed.append((self.queue.waiting.popleft(), "what comes before it failed"))

    def _over(self, failure: str | None) -> None:
        """The step under way is done, ended or has failed."""
        if self._ending and failure is None:
            self.queue.end()
        else:
            self.queue.finish(failure)
        self._skill, self._ending = None, False

    # -- watching ---------------------------------------------------------------------------------------------------

    def _watch(self) -> None:
        """Go to the post when there is one, and turn with the partner when the neck cannot."""
        if self._watching is None:
            self._watching = self._take_post()
        try:
            next(self._watching)
        except (StopIteration, StepFailed):
            self._watching = self._look_round()

    def _take_post(self) -> Ticks:
        if self.holding is None:
            yield from self.hand.home()
        if self.post is not None and math.dist(self.post, self.base.place) > 0.1:
            post = self.post
            yield from self.base.go(lambda: [post])

    def _look_round(self) -> Ticks:
        while True:
            wanted = self.head.wants_turn(self.base.pose)
            while wanted is not None and abs(turn(wanted - self.base.aim_yaw)) > 0.05:
                self.base.turn_to(wanted, 0.8)
                yield
                wanted = self.head.bearing(self.base.pose, wanted)
            yield

    # -- skills -----------------------------------------------------------------------------------------------------

    def _run(self, step: Step) -> Ticks:
        target, destination = str(step.target), str(step.destination)
        skills = {"pick_and_place": self._pick_and_place, "use": self._use}
        return skills[step.skill](target, destination)

    def _pick_and_place(self, target: str, destination: str) -> Ticks:
        if self.holding not in (None, target):
            raise StepFailed(f"the gripper still holds {self.holding}")
        if self.holding is None:
            if self._placed(target, destination):
                return
            yield from self._approach(target)
            yield from self._grasp(target)
        yield from self.hand.take_up(target)
        yield from self._approach(destination)
        yield from self.hand.put(target, destination)

    def _use(self, target: str, destination: str) -> Ticks:
        if self.holding not in (None, target):
            raise StepFailed(f"the gripper still holds {self.holding}")
        if self.holding is None:
            yield from self._until_free(target)  # whoever just put it there may still have a hand on it
            if not self._placed(target, destination):
                raise StepFailed(f"{target} is not at {destination}")
            yield from self._approach(destination)
            yield from self._until_free(target)
            yield from self._grasp(target)
        yield from self.hand.scrub(target)
        yield from self.hand.release(target)

    def _grasp(self, target: str) -> Ticks:
        self._taken_from = self.physics.position(target)
        yield from self.hand.grasp(target)

    def _end(self, step: Step) -> Ticks:
        """End a step safely: fold the empty arm, or bring what is held back to where it was taken from."""
        target, spot = str(step.target), self._taken_from
        yield from self.base.halt(0.3)
        if self.holding is None or spot is None:
            yield from self.hand.back_off(target)
        elif step.skill == "use":
            yield from self.hand.lower(target, spot)
        else:
            yield from self.hand.take_up(target)
            yield from self._go_near(target, lambda: (spot[0], spot[1]))
            yield from self.hand.lay(target, spot)

    def _placed(self, target: str, destination: str) -> bool:
        """At its place, and in nobody's hand."""
        where = self.physics.positions()
        return self.physics.holder(target) is None and is_placed(self.scene, where, target, destination)

    def _approach(self, name: str) -> Ticks:
        """Drive to where an object can be handled, and face it."""
        yield from self._until_free(name)
        yield from self._go_near(name, lambda: self._at(name))

    def _go_near(self, name: str, at: Callable[[], Point]) -> Ticks:
        """Drive to where an object at that point can be handled, and face the point."""
        rings, since = (self.settings.stand_distance, *RINGS), self.physics.time
        if not any(abs(math.dist(self.base.place, at()) - ring) < 0.02 for ring in rings):
            yield from self.base.go(lambda: self._standing(name, at(), rings, since))
        yield from self.base.face(at())
        if math.dist(self.base.place, at()) > REACH:
            raise StepFailed(f"{name} is out of reach")

    def _until_free(self, name: str) -> Ticks:
        """Wait while somebody else holds an object."""
        since = self.physics.time
        while self.physics.holder(name) not in (None, self.name):
            if self.physics.time - since > self.settings.patience:
                raise StepFailed(f"somebody keeps holding {name}")
            yield
        if name in self.physics.removed:
            raise StepFailed(f"{name} is no longer there")

    def _standing(self, name: str, at: Point, rings: Sequence[float], since: float) -> list[Point]:
        """Where to stand for an object: so that no other one is between, or after a while of waiting anywhere."""
        ways = self.base.navigator
        others = [
            (self._at(other), self.scene.thing(other).radius + BESIDE)
            for other in self.scene.movables
            if other not in (name, self.holding) and math.dist(self._at(other), at) > 0.05
        ]
        points = square_on(self.scene, at, ways.standing_points(at, rings))
        clear = [p for p in points if all(point_to_segment(o, (p, at)) > gap for o, gap in others)]
        if clear and self.physics.time - since < WAIT_FOR_SPACE:
            return [point for point in clear if ways.free(point, self.base.others())]
        return ways.standing_points(at, rings, self.base.others())

    def _at(self, name: str) -> Point:
        x, y, _ = self.physics.position(name)
        return x, y
