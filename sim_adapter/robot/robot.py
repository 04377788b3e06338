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
from casper.sim_adapter.robot.skills import RobotSkills
from casper.sim_adapter.robot.space import Space
from casper.sim_adapter.room.geometry import Disc, turn
from casper.sim_adapter.room.navigation import Navigator
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import Step, StepFailed, StepQueue, Ticks, Worker, check_objects

ROBOT_SKILLS = ("pick_and_place", "use")


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
        self.space = Space(physics)
        self.base = RobotBase(physics, navigator, start, others, self.space)
        self.arm = RobotArm(physics, self.name)
        self.arm.settle()
        self.hand = RobotHand(physics, self.base, self.arm, self.space)
        self.skills = RobotSkills(physics, self.base, self.hand)
        self.head = RobotHead(physics, self.name)
        self.post: Point | None = None
        self.queue = StepQueue()
        self._dt = self.scene.sim.control
        self._skill: Ticks | None = None
        self._ending = False  # the step under way is being ended
        self._failure: str | None = None  # why, where it is given up
        self._watching: Ticks | None = None
        self._looking = self._look_round()

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
            self._ending, self._skill = True, self.skills.end(current)

    def give_way(self, spot: Point) -> None:
        """Go to a spot where somebody else gets by: at once where there is nothing to do, else when it waits itself."""
        if self.idle and self.holding is None:
            self._watching = self._go_aside(spot)
        else:
            self.base.aside = spot

    def tick(self) -> None:
        """One control step."""
        self.space.update(self.base.place)
        if self._skill is None and self.queue.waiting:
            self.queue.current = self.queue.waiting.popleft()
            self._skill, self._watching = self.skills.run(self.queue.current), None
        if self._skill is None:
            self._watch()
        else:
            self._advance(self._skill)
            if self.base.waits:
                next(self._looking)
        self.head.update(self.base.pose)
        self.base.update()
        self.arm.update(self.space.pace)

    def _advance(self, skill: Ticks) -> None:
        try:
            next(skill)
        except StopIteration:
            self._over(self._failure)
        except StepFailed as reason:
            self._give_up(str(reason))

    def _give_up(self, reason: str) -> None:
        """A step failed, and with it all that was to come after it; what the robot has begun it ends safely first."""
        current = self.queue.current
        if current is None:
            return
        if self._ending:
            held = None if self.holding is None else f"{reason}, so {self.holding} is still in the gripper"
            self._over("; then ".join(told for told in (self._failure, held) if told is not None) or None)
        elif self.skills.is_at_rest:
            self._over(reason)
        else:
            self._failure, self._ending, self._skill = reason, True, self.skills.end(current)

    def _over(self, failure: str | None) -> None:
        """The step under way is done, ended or has failed; what waits for one that failed fails with it."""
        current = self.queue.current
        if self._ending and failure is None:
            self.queue.end()
        else:
            self.queue.finish(failure)
            if failure is None and self.skills.found:
                self.queue.found.add(len(self.queue.done) - 1)
        self._skill, self._ending, self._failure = None, False, None
        while failure is not None and self.queue.waiting:
            self.queue.failed.append((self.queue.waiting.popleft(), f"{current} comes before it: {failure}"))

    # -- watching ---------------------------------------------------------------------------------------------------

    def _watch(self) -> None:
        """Go to the post when there is one, and turn with the partner when the neck cannot."""
        if self._watching is None:
            self._watching = self._take_post()
        try:
            next(self._watching)
        except (StopIteration, StepFailed):
            self._watching = self._looking

    def _go_aside(self, spot: Point) -> Ticks:
        yield from self.base.go(lambda others: [spot])

    def _take_post(self) -> Ticks:
        yield from self.skills.put_away()
        yield from self.hand.home()
        if self.post is not None and math.dist(self.post, self.base.place) > 0.1:
            post = self.post
            yield from self.base.go(lambda others: [post])

    def _look_round(self) -> Ticks:
        while True:
            wanted = self.head.wants_turn(self.base.pose)
            while wanted is not None and abs(turn(wanted - self.base.aim_yaw)) > 0.05:
                self.base.turn_to(wanted, 0.8)
                yield
                wanted = self.head.bearing(self.base.pose, wanted)
            yield
