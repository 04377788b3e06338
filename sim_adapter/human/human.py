"""The simulated human: a queue of steps, each a skill stepped by the clock, with the true label of every moment."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from casper.kb.errors import DomainError
from casper.sim_adapter.human.body import HumanBody
from casper.sim_adapter.human.hand import HumanHand
from casper.sim_adapter.human.walk import REACHABLE, HumanWalk
from casper.sim_adapter.physics.physics import Physics
from casper.sim_adapter.room.geometry import Disc
from casper.sim_adapter.room.navigation import Navigator
from casper.sim_adapter.room.placement import Spot
from casper.sim_adapter.room.scene import Point
from casper.sim_adapter.steps import SKILLS, Step, StepFailed, StepQueue, Ticks, Worker, check_objects

MOVEMENTS = ("still", "walk", "transport", "pick", "place")
LONGEST_WAIT = 120.0  # seconds for a place where others are at work
AT_HAND = 0.35  # metres within which an object counts as being at the destination of its use


class Human(Worker):
    """Does steps one after another. ``movement`` is what the script is doing at this moment, one of MOVEMENTS.

    Args:
        physics: the world it moves in.
        name: whose body of the scene it is.
        navigator: ways for its body.
        start: x, y (metres), heading (radians).
        others: gives the discs of those to keep away from.
        rng: for the length of its pauses.
        vacant: whether something can be brought to a place now, of what and where; others may be at work there.
    """

    def __init__(
        self,
        physics: Physics,
        name: str,
        navigator: Navigator,
        start: tuple[float, float, float],
        others: Callable[[], Sequence[Disc]],
        rng: np.random.Generator,
        vacant: Callable[[str, str], bool] = lambda target, place: True,
    ) -> None:
        self.physics = physics
        self.scene = physics.scene
        self.name = name
        self.settings = self.scene.human_settings
        self.body = HumanBody(physics, name, start)
        self.hand = HumanHand(self.body)
        self.walk = HumanWalk(self.body, navigator, others)
        self.queue = StepQueue()
        self._rng = rng
        self._vacant = vacant
        self._skill: Ticks | None = None
        self._is_waiting = False  # for what somebody else holds
        self._aside: Ticks | None = None  # how they let somebody through meanwhile

    @property
    def x(self) -> float:
        """East, metres."""
        return self.body.x

    @property
    def y(self) -> float:
        """North, metres."""
        return self.body.y

    @property
    def heading(self) -> float:
        """Radians, 0 = +x, counter-clockwise."""
        return self.body.heading

    @property
    def place(self) -> Point:
        """Where it stands."""
        return self.body.place

    @property
    def movement(self) -> str:
        """The true label of this moment: still, walk or transport (moving free-handed or with something), pick, place.

        Who has stopped in front of an object to take it is picking until it is grasped and clear of the ground; who
        has stopped with something in the hand is placing until the hand is back.
        """
        return self.body.movement

    @property
    def holding(self) -> str | None:
        """What is in its hand."""
        return self.body.holding

    def do(self, steps: Iterable[Step]) -> None:
        """Queue steps.

        Raises:
            DomainError: an unknown skill, or an object the scene does not have or that cannot be used so.
        """
        for step in steps:
            if step.skill not in SKILLS:
                raise DomainError(f"there is no skill {step.skill}; there are {', '.join(SKILLS)}")
            check_objects(self.scene, step)
            self.queue.waiting.append(step)

    def leave(self, steps: Iterable[Step]) -> list[Step]:
        """Leave steps not yet begun to somebody else, and stand aside when nothing else is to be done.

        Returns the steps that were really taken out of the queue (one that is under way is finished).
        """
        dropped = self.queue.drop(steps)
        if dropped:
            self.queue.waiting.append(Step("stand_aside"))
        return dropped

    def is_bound_for(self, place: str) -> bool:
        """Whether what they do, or do next, is done at a place."""
        step = self.queue.current or next(iter(self.queue.waiting), None)
        return step is not None and step.destination == place

    @property
    def can_make_way(self) -> bool:
        """Whether there is nothing to do, or nothing to be done as long as somebody else holds what is needed."""
        return self.idle or self._is_waiting

    def make_way(self, spot: Point | None) -> None:
        """Go to a spot, or just aside (None), where they can."""
        aside = self.walk.stand_aside() if spot is None else self.walk.make_way(spot)
        if self.idle:
            self.queue.current, self._skill = Step("stand_aside"), aside
        elif self._is_waiting:
            self._aside = aside

    def tick(self) -> None:
        """One control step."""
        if self._skill is None and self.queue.waiting:
            self.queue.current = self.queue.waiting.popleft()
            self._skill = self._run(self.queue.current)
        if self._skill is None:
            self.body.stand("still")
            self.body.relax_hand()
        else:
            self._advance(self._skill)
        self.body.show()

    def _advance(self, skill: Ticks) -> None:
        try:
            next(skill)
        except StopIteration:
            self._skill = None
            self.queue.finish()
        except StepFailed as reason:
            self._skill = None
            self.queue.finish(str(reason))

    # -- skills -----------------------------------------------------------------------------------------------------

    def _run(self, step: Step) -> Ticks:
        target, destination = str(step.target), str(step.destination)
        skills: dict[str, Callable[[], Ticks]] = {
            "pick_and_place": lambda: self._pick_and_place(target, destination),
            "use": lambda: self._use(target, destination),
            "set_down": lambda: self._set_down(target, step.spot or (0.0, 0.0, 0.0)),
            "handle": lambda: self._handle(target),
            "walk_to": lambda: self.walk.go_to(target),
            "still": lambda: self._wait(step.seconds),
            "step_back": self.walk.step_back,
            "stand_aside": self.walk.stand_aside,
        }
        return skills[step.skill]()

    def _pick_and_place(self, target: str, destination: str) -> Ticks:
        yield from self._until_free(target)
        yield from self._until_vacant(target, destination)
        yield from self._take(target)
        yield from self.walk.go_to(destination)
        yield from self.hand.put(target, destination, self.settings.place_time)

    def _set_down(self, target: str, spot: Spot) -> Ticks:
        """Take something to a spot that is no object's place."""
        yield from self._take(target)
        yield from self.walk.go_near(spot[:2])
        yield from self.hand.lay(target, spot, self.settings.place_time)

    def _handle(self, target: str) -> Ticks:
        """Take something up, and put it back where it was."""
        yield from self._until_free(target)
        yield from self.walk.go_to(target)
        yield from self._pause()
        yield from self._until_free(target)
        yield from self.hand.pick(target, self.settings.use_half)
        yield from self.hand.handle(target, self.settings.use_half)

    def _take(self, target: str) -> Ticks:
        """Go to something, take it and lift it."""
        yield from self._until_free(target)
        yield from self.walk.go_to(target)
        yield from self._pause()
        yield from self._until_free(target)
        yield from self.hand.pick(target, self.settings.pick_time)
        yield from self.hand.lift()

    def _use(self, target: str, destination: str) -> Ticks:
        """Pairs of a pick and a place on the spot, at the destination (or where the target is, if elsewhere)."""
        yield from self._until_free(target)
        there = math.dist(self.body.at(target), self.body.at(destination)) < AT_HAND
        yield from self.walk.go_to(destination if there else target)
        if math.dist(self.place, self.body.at(target)) > REACHABLE:
            yield from self.walk.go_to(target)
        yield from self._pause()
        for _ in range(round(self.settings.use_pairs)):
            yield from self._until_free(target)
            yield from self.hand.pick(target, self.settings.use_half)
            yield from self.hand.handle(target, self.settings.use_half)
        yield from self._wait(0.5)

    def _until_free(self, name: str) -> Ticks:
        """Wait while somebody else holds the object; who let others through meanwhile comes back to it."""
        away = False
        while away or self.physics.holder(name) not in (None, self.name):
            self._is_waiting, aside, self._aside = True, self._aside, None
            if aside is not None:
                yield from aside
                away = True
            elif away and self.physics.holder(name) is None:
                yield from self.walk.go_to(name)
                away = False
            self.body.stand("still")
            yield
        self._is_waiting = False
        if name in self.physics.removed:
            raise StepFailed(f"{name} is no longer there")

    def _until_vacant(self, target: str, place: str) -> Ticks:
        """Wait out of the way while others are at work at a place, or something of theirs lies there; not for ever."""
        since = self.physics.time
        if not self._vacant(target, place):
            yield from self.walk.stand_aside()
        while not self._vacant(target, place) and self.physics.time - since < LONGEST_WAIT:
            self.body.stand("still")
            self.body.relax_hand()
            yield

    def _pause(self) -> Ticks:
        """Standing in front of what it is about to take."""
        yield from self._wait(float(self._rng.uniform(self.settings.pause_min, self.settings.pause_max)), "pick")

    def _wait(self, seconds: float, movement: str = "still") -> Ticks:
        for _ in range(self.body.ticks(seconds)):
            self.body.stand(movement)
            self.body.relax_hand()
            yield
