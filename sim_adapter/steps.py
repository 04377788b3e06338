"""What an agent is asked to do: steps of skills, the queue both agents work through, and how a step fails."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterable
from dataclasses import dataclass, field

from casper.kb.errors import DomainError
from casper.sim_adapter.room.scene import Scene

HANDLING = ("pick_and_place", "use")  # what a plan's step may be
ASIDE = ("set_down", "handle")  # besides plans: put at a spot that no plan knows, take up and put back
SKILLS = (*HANDLING, *ASIDE, "walk_to", "still", "stand_aside", "step_back")

Ticks = Generator[None, None, None]
"""A skill under way: each ``yield`` hands the clock back until the next control step."""


@dataclass(frozen=True, slots=True)
class Step:
    """One skill: the object it is for, the one it ends at, how long (``still``, seconds), where (``set_down``)."""

    skill: str
    target: str | None = None
    destination: str | None = None
    seconds: float = 0.0
    spot: tuple[float, float, float] | None = None

    def __str__(self) -> str:
        names = [name for name in (self.target, self.destination) if name is not None]
        return f"{self.skill}({', '.join(names)})"


def step_of(skill: str, step: Step) -> Step:
    """Another skill with the objects of a step."""
    return Step(skill, step.target, step.destination)


def check_objects(scene: Scene, step: Step) -> None:
    """See that the objects of a step exist and can be used so.

    Raises:
        DomainError: an object is unknown, the target is fixed, nothing can be put at the destination, or it is not
            said where.
    """
    if step.skill in (*HANDLING, *ASIDE, "walk_to"):
        scene.thing(step.target)
    if step.skill in (*HANDLING, *ASIDE) and not scene.thing(step.target).movable:
        raise DomainError(f"{step} cannot be done: {step.target} is fixed")
    if step.skill == "set_down" and step.spot is None:
        raise DomainError(f"{step} cannot be done: it is not said where")
    if step.skill in HANDLING:
        place = scene.thing(step.destination)
        if place.placing is None:
            raise DomainError(f"{step} cannot be done: the scene has no placing({place.name}, How)")


class StepFailed(Exception):
    """Raised inside a skill that cannot be finished; the sentence says why. Agents catch and report it."""


class Missed(StepFailed):
    """What may well work when it is tried again: fingers beside the object, say."""


class OutOfReach(Missed):
    """What may work from nearer by."""


@dataclass(slots=True)
class StepQueue:
    """Steps waiting, the one under way, those finished, those that failed (with the reason), those ended undone.

    ``found`` are the numbers of those among the finished ones that somebody else had done when their turn came.
    """

    waiting: deque[Step] = field(default_factory=deque)
    current: Step | None = None
    done: list[Step] = field(default_factory=list)
    failed: list[tuple[Step, str]] = field(default_factory=list)
    ended: list[Step] = field(default_factory=list)
    found: set[int] = field(default_factory=set)

    @property
    def idle(self) -> bool:
        """Nothing under way and nothing waiting."""
        return self.current is None and not self.waiting

    def drop(self, steps: Iterable[Step]) -> list[Step]:
        """Take steps not yet begun out of the queue, each asked for once; returns those that were there."""
        dropped = []
        for step in steps:
            if step in self.waiting:
                self.waiting.remove(step)
                dropped.append(step)
        return dropped

    def finish(self, reason: str | None = None) -> None:
        """End the current step: done, or failed for a reason."""
        if self.current is None:
            return
        if reason is None:
            self.done.append(self.current)
        else:
            self.failed.append((self.current, reason))
        self.current = None

    def end(self) -> None:
        """The current step was ended before it was done."""
        if self.current is not None:
            self.ended.append(self.current)
        self.current = None


class Worker:
    """Somebody who works through a queue of steps: what there is to say about how far they are."""

    queue: StepQueue

    @property
    def current(self) -> Step | None:
        """The step under way."""
        return self.queue.current

    @property
    def done(self) -> list[Step]:
        """Steps finished, in order."""
        return self.queue.done

    @property
    def failed(self) -> list[tuple[Step, str]]:
        """Steps that could not be finished, with the reason."""
        return self.queue.failed

    @property
    def idle(self) -> bool:
        """Nothing to do."""
        return self.queue.idle
