"""The robot's part in the simulation: what it announced is done when its turn has come, what was withdrawn is not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.events.telling import sentence
from casper.engine.mind import Mind
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.sim_adapter.room.making_way import HELD_UP
from casper.sim_adapter.script import step_for
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step, step_of


@dataclass(frozen=True, slots=True)
class Task:
    """An action that the robot was asked for, whose part it belongs to, and of which mind.

    One that is ``again`` is no action of the part: it brings back what was moved away after it had been brought.
    """

    action: Compound
    step: Step
    supervisor: Supervisor
    mind: Mind
    again: bool = False

    @property
    def is_wanted(self) -> bool:
        """Whether it is still announced."""
        left = self.supervisor.left
        return bool(left) if self.again else self.action in left


class Helper:
    """Sends the robot off when its turn has come, tells what it does, and calls it back when its part is withdrawn."""

    def __init__(self, domain: Domain, simulation: Simulation) -> None:
        self.domain, self.simulation = domain, simulation
        self.tasks: list[Task] = []  # asked for and not over yet, in the order in which the robot does them
        self.asked: list[Compound] = []  # all that was ever asked for and not withdrawn
        self.asked_for: list[tuple[str, Compound]] = []  # the same, with the partner whose goal it is for
        self.finished: list[Compound] = []  # all that was done, in order
        self.reasons: list[str] = []  # why a part was given up, one for each
        self.is_good = True  # whether all of it was done and came to rest where it belongs, as far as it is over
        self._to_check: list[Compound] = []
        self._done = self._failed = 0
        self._tries: dict[str, int] = {}  # how often each thing was brought back
        self._begs = False  # somebody was asked to let the robot through

    @property
    def things(self) -> set[str]:
        """The objects of what is yet to be done."""
        return {name for task in self.tasks for name in (task.step.target, task.step.destination) if name is not None}

    def update(self, minds: Sequence[Mind], t: float) -> Iterator[Event]:
        """One step: what became of what the robot was asked for, what it is asked for now."""
        yield from self._done_by_now(t)
        yield from self._failed_by_now(t)
        yield from self._called_back(t)
        for mind in minds:
            for supervisor in mind.course.supervisors:
                if supervisor.ready and not any(task.supervisor is supervisor for task in self.tasks):
                    yield from self._ask(supervisor, mind, t)
        yield from self._held_up(t)

    def _ask(self, supervisor: Supervisor, mind: Mind, t: float) -> Iterator[Event]:
        new = [Task(action, step_for(self.domain, action), supervisor, mind) for action in supervisor.left]
        self.simulation.robot.do([task.step for task in new])
        self.tasks += new
        self.asked += [task.action for task in new]
        self.asked_for += [(mind.partner, task.action) for task in new]
        for task in new:
            yield self._told(t, task, "asked")

    def _done_by_now(self, t: float) -> Iterator[Event]:
        queue = self.simulation.robot.queue
        for step in queue.done[self._done :]:
            found = self._done in queue.found
            self._done += 1
            task = next((task for task in self.tasks if task.step == step), None)
            if task is None:
                continue
            self.tasks.remove(task)
            self._to_check.append(task.action)
            if not task.again:
                self.finished.append(task.action)
            yield self._told(t, task, "done", "it was there already" if found else "")
            yield from task.mind.did(task.action, t)

    def _failed_by_now(self, t: float) -> Iterator[Event]:
        """What failed, and all that was to come after it in its part. Parts of others are asked for again."""
        new = self.simulation.robot.failed[self._failed :]
        self._failed += len(new)
        failed = [(task, why) for step, why in new for task in self.tasks if task.step == step]
        if not failed:
            return
        first, reason = failed[0]
        part = [task for task in self.tasks if task.supervisor is first.supervisor]
        others = [task for task, _ in failed if task.supervisor is not first.supervisor]
        self.simulation.robot.do([task.step for task in others])
        if self._was_moved_away(first):
            yield from self._bring_back(first, part, t)
            return
        self.tasks = [task for task in self.tasks if task.supervisor is not first.supervisor]
        self.is_good = False
        self.reasons.append(f"{_text(first.action)}: {reason}")
        whys = {id(task): why for task, why in failed}
        for task in part:
            yield self._told(t, task, "failed", whys.get(id(task), reason))
        tell = first.supervisor.reading.tell
        yield self._says(t, first, tell.phrase("gives up", tell.name(self.domain.robot), reason))
        yield from first.mind.failed(first.action, t)

    def _was_moved_away(self, task: Task) -> bool:
        """Whether what is to be used was at its place when its turn came, and the robot may bring it back once more."""
        step, robot = task.step, self.simulation.robot
        if step.skill != "use" or robot.holding is not None or self.simulation.is_at(step.target, step.destination):
            return False
        if step.target in self.simulation.physics.removed or not task.is_wanted:
            return False
        tried = self._tries.get(str(step.target), 0)
        return tried < robot.settings.retries and self._may_bring(step)

    def _may_bring(self, step: Step) -> bool:
        """Whether the robot can bring the thing of a step to its place, as far as the rules know."""
        brought = step_of("pick_and_place", step)
        if any(step_for(self.domain, action) == brought for action in self.finished):
            return True
        statement = Compound((brought.skill, self.domain.robot, str(step.target), str(step.destination)))
        return self.domain.verifies and self.domain.kb.verify(statement).valid is True

    def _bring_back(self, task: Task, part: Sequence[Task], t: float) -> Iterator[Event]:
        """Somebody moved away what had been brought: bring it back, then go on with the part."""
        step = step_of("pick_and_place", task.step)
        self._tries[str(step.target)] = self._tries.get(str(step.target), 0) + 1
        action = Compound((step.skill, str(step.target), str(step.destination)))
        extra = Task(action, step, task.supervisor, task.mind, again=True)
        self.tasks = [other for other in self.tasks if other not in part] + [extra, *part]
        self.simulation.robot.do([other.step for other in (extra, *part)])
        yield self._told(t, extra, "asked", f"{step.target} is no longer at {step.destination}")

    def _called_back(self, t: float) -> Iterator[Event]:
        """What is announced no more is not done; the step that the robot is in the middle of is ended safely.

        A step that the partner took over is left to them, unless the robot has the thing in its gripper: then nobody
        else can have done it, whatever was seen, and it is finished.
        """
        robot = self.simulation.robot
        gone = [task for task in self.tasks if not task.is_wanted]
        in_hand = [t for t in gone if t.step == robot.current and robot.holding == t.step.target is not None]
        gone = [task for task in gone if task not in in_hand or task.supervisor.is_withdrawn]
        if not gone:
            return
        current = robot.current
        robot.leave([task.step for task in gone])
        for task in gone:
            self.tasks.remove(task)
            if not task.again:
                self.asked.remove(task.action)
                self.asked_for.remove((task.mind.partner, task.action))
            if task.step == current or not task.supervisor.is_withdrawn:
                yield self._told(t, task, "stopped", self._why_gone(task))

    def _why_gone(self, task: Task) -> str:
        """Why a step is not the robot's any more."""
        if task.supervisor.is_withdrawn:
            return "it was withdrawn"
        name, partner, rest = task.action.functor, task.mind.partner, task.action.args
        taken_over = any(done == Compound((name, partner, *rest)) for done, _ in task.mind.history)
        return f"{partner} did it" if taken_over else "it is announced no more"

    def _held_up(self, t: float) -> Iterator[Event]:
        """Somebody is asked, once, to let the robot through."""
        waits = self.simulation.robot.base.held_up >= HELD_UP
        if waits and not self._begs and self.tasks:
            tell = self.tasks[0].supervisor.reading.tell
            yield self._says(t, self.tasks[0], tell.phrase("let through", tell.name(self.domain.robot)))
        self._begs = waits

    def settle(self) -> None:
        """See that what was done came to rest where it belongs: before others move it again, and at the end."""
        last = {action[1]: action for action in self._to_check}  # what the robot moves on is where it was put last
        for action in last.values():
            self.is_good = self.is_good and self.simulation.rests_in(str(action[1]), str(action[2]))
        self._to_check = []

    @property
    def robot_done(self) -> bool:
        """Whether the robot's part is physically finished: every action done, every object resting where it belongs."""
        self.settle()
        return bool(self.asked) and not self.tasks and self.is_good

    def part_of(self, partner: str) -> dict[str, Any]:
        """What the robot was asked for of one partner's goals, and whether it is finished."""
        asked = [_text(action) for who, action in self.asked_for if who == partner]
        open_ = any(task.mind.partner == partner for task in self.tasks)
        return {"actions": asked, "done": bool(asked) and not open_ and self.robot_done}

    def _told(self, t: float, task: Task, status: str, reason: str = "") -> Event:
        told = {"agent": self.domain.robot, "partner": task.mind.partner, "action": _text(task.action)}
        return Event("robot", t, {**told, "status": status, **({"reason": reason} if reason else {})})

    def _says(self, t: float, task: Task, text: str) -> Event:
        return Event("says", t, {"agent": self.domain.robot, "partner": task.mind.partner, "text": sentence(text)})


def _text(action: Compound) -> str:
    return term_text(as_term(action))
