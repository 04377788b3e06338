"""The robot's part in the simulation: what it announced is done when its turn has come, what was withdrawn is not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.mind import Mind
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.sim_adapter.script import step_for
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step


@dataclass(frozen=True, slots=True)
class Task:
    """An action that the robot was asked for, whose part it belongs to, and of which mind."""

    action: Compound
    step: Step
    supervisor: Supervisor
    mind: Mind

    @property
    def is_wanted(self) -> bool:
        """Whether it is still announced."""
        return self.action in self.supervisor.left


class Helper:
    """Sends the robot off when its turn has come, tells what it does, and calls it back when its part is withdrawn."""

    def __init__(self, domain: Domain, simulation: Simulation) -> None:
        self.domain, self.simulation = domain, simulation
        self.tasks: list[Task] = []  # asked for and not over yet, in the order in which the robot does them
        self.asked: list[Compound] = []  # all that was ever asked for and not withdrawn
        self.asked_for: list[tuple[str, Compound]] = []  # the same, with the partner whose goal it is for
        self.finished: list[Compound] = []  # all that was done, in order
        self.is_good = True  # whether all of it was done and came to rest where it belongs, as far as it is over
        self._to_check: list[Compound] = []
        self._done = self._failed = 0

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

    def _ask(self, supervisor: Supervisor, mind: Mind, t: float) -> Iterator[Event]:
        new = [Task(action, step_for(self.domain, action), supervisor, mind) for action in supervisor.left]
        self.simulation.robot.do([task.step for task in new])
        self.tasks += new
        self.asked += [task.action for task in new]
        self.asked_for += [(mind.partner, task.action) for task in new]
        for task in new:
            yield self._told(t, task, "asked")

    def _done_by_now(self, t: float) -> Iterator[Event]:
        for step in self.simulation.robot.done[self._done :]:
            self._done += 1
            task = next((task for task in self.tasks if task.step == step), None)
            if task is None:
                continue
            self.tasks.remove(task)
            self._to_check.append(task.action)
            self.finished.append(task.action)
            yield self._told(t, task, "done")
            yield from task.mind.did(task.action, t)

    def _failed_by_now(self, t: float) -> Iterator[Event]:
        for step, reason in self.simulation.robot.failed[self._failed :]:
            self._failed += 1
            task = next((task for task in self.tasks if task.step == step), None)
            if task is None:
                continue  # of the same part as one that failed before
            self.tasks = [other for other in self.tasks if other.supervisor is not task.supervisor]
            self.is_good = False
            yield self._told(t, task, "failed", reason)
            yield from task.mind.failed(task.action, t)

    def _called_back(self, t: float) -> Iterator[Event]:
        """What is announced no more is not done; the step that the robot is in the middle of is ended safely."""
        gone = [task for task in self.tasks if not task.is_wanted]
        if not gone:
            return
        current = self.simulation.robot.current
        self.simulation.robot.leave([task.step for task in gone])
        for task in gone:
            self.tasks.remove(task)
            self.asked.remove(task.action)
            self.asked_for.remove((task.mind.partner, task.action))
            if task.step == current:
                yield self._told(t, task, "stopped", "it was withdrawn")

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


def _text(action: Compound) -> str:
    return term_text(as_term(action))
