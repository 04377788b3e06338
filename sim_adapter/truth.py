"""The truth of a trial, from what the simulation did and what partners set out to do, never from what a mind believes.

* **right at the end**: the goals that were read, in episodes that are finished or still open at the end, are just those
  that the partner pursued and did not give up, each as often as it was pursued;
* **wrong intervention**: the robot took hold of something for a step that was left to be done of no goal the partner
  had at that time, nor was announced when it was (and not withdrawn since);
* **help has ended** when every step that was ever announced was done by the robot, or by the partner, or is given up
  for a reason that is true: what failed says why, what was withdrawn is of a goal the partner no longer has, or was
  not busy with.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from casper.engine.events import Event
from casper.engine.reading.underway import FINISHED, UNCLEAR
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.sim_adapter.helping import Helper, Task
from casper.sim_adapter.partners.partner import Partner
from casper.sim_adapter.simulation import Simulation

OPEN = ("announced", "asked")  # what became of a step of which nothing came yet


@dataclass
class Help:
    """What became of a step that was announced for a goal, and whether the reason for that is true."""

    goal: str
    action: str
    promised: bool  # whether it was left to be done of a goal the partner had when it was announced
    outcome: str = "announced"
    because: str = ""
    is_true: bool = True

    @property
    def has_ended(self) -> bool:
        """Whether it was done, or given up for a true reason."""
        return self.outcome not in OPEN and self.is_true

    def to_json(self) -> dict[str, Any]:
        """``{"goal", "action", "outcome", "because", "true"}``."""
        told = {"goal": self.goal, "action": self.action, "outcome": self.outcome}
        return {**told, "because": self.because, "true": self.is_true}


@dataclass
class Record:
    """What is true of one partner: which steps of which stretch are left to be done, and what was made of them."""

    partner: Partner
    left: list[Counter[str]] = field(default_factory=list)
    help: dict[tuple[str, str], Help] = field(default_factory=dict)
    predicted: set[str] = field(default_factory=set)
    believed: list[str] = field(default_factory=list)
    counted: int = 0  # how much of what the partner did is taken into account

    @property
    def goals(self) -> list[str]:
        """What was pursued, without what was given up."""
        return [goal for pursuit in self.partner.pursuits if not pursuit.given_up for goal in pursuit.stretch.goals]

    @property
    def is_right(self) -> bool:
        """Whether just these were read."""
        return sorted(self.goals) == sorted(self.believed)

    def needs(self, action: str, goal: str | None = None) -> bool:
        """Whether a step is left to be done of a goal (None: any) that they have."""
        having = zip(self.partner.pursuits, self.left)
        return any(left[action] > 0 and goal in (None, *pursuit.stretch.goals) for pursuit, left in having)

    def has(self, goal: str) -> bool:
        """Whether something is left to be done for a goal that they have."""
        return any(+left and goal in pursuit.stretch.goals for pursuit, left in zip(self.partner.pursuits, self.left))

    def is_elsewhere(self, goal: str) -> bool:
        """Whether what they did last, or do, serves another goal."""
        return any(scripted.goal not in (None, goal) for scripted in self.partner.busy_with)

    def notice(self) -> list[str]:
        """Take into account which stretch they are at, and what they have done; returns the steps done since."""
        while len(self.left) <= self.partner.at:
            if self.left and self.partner.pursuits[len(self.left) - 1].given_up:
                self.left[-1].clear()
            script = self.partner.pursuits[len(self.left)].stretch.script
            self.left.append(Counter(_text(s.action) for s in script if s.action is not None))
        done = [_text(s.action) for s in self.partner.did[self.counted :] if s.action is not None]
        self.counted = len(self.partner.did)
        for action in done:
            self.left[-1][action] -= 1
        return done

    def was_done(self, action: str) -> None:
        """The robot has done a step."""
        for left in self.left:
            if left[action] > 0:
                left[action] -= 1
                return


class Truth:
    """Follows a trial; `see` is called after every period, with what was told in it."""

    def __init__(self, simulation: Simulation, partners: Mapping[str, Partner], helper: Helper) -> None:
        self.simulation, self.helper = simulation, helper
        self.records = {name: Record(partner) for name, partner in partners.items()}
        self.wrong_interventions: list[str] = []
        self._grasped: tuple[int, str | None] = (0, None)
        self._tasks: list[Task] = []  # a period ago: one may have been withdrawn just after it was begun

    def see(self, told: Iterable[Event], is_end: bool = False) -> None:
        """One period more, or what was told when nobody watched any more."""
        read = (FINISHED, UNCLEAR) if is_end else (FINISHED,)
        for record in self.records.values():
            done = record.notice()
            for help_ in record.help.values():
                if help_.action in done and help_.outcome in (*OPEN, "dropped", "withdrawn"):
                    help_.outcome, help_.because, help_.is_true = "taken over", "", True
        for event in told:
            whose = self.records.get(str(event.data.get("partner") or event.data.get("agent")))
            if whose is not None:
                self._hear(whose, event, read)
        self._look()

    def _hear(self, record: Record, event: Event, read: tuple[str, ...]) -> None:
        data = event.data
        if event.type == "prediction":
            record.predicted.add(data["goal"])
        elif event.type == "episode" and data["goal"] in record.predicted and data["outcome"] in read:
            record.believed.append(data["goal"])
        elif event.type == "plan":
            _announced(record, data["goal"], data["actions"])
        elif event.type == "withdrawn":
            for help_ in record.help.values():
                if help_.goal == data["goal"] and help_.outcome in OPEN:
                    help_.outcome, help_.because = "withdrawn", data["because"]
                    help_.is_true = not record.needs(help_.action, help_.goal) or record.is_elsewhere(help_.goal)
        elif event.type == "robot":
            _reported(record, data)

    def _look(self) -> None:
        """Whether the robot has taken hold of something, and whether it should have."""
        robot, tasks = self.simulation.robot, [*self.helper.tasks, *self._tasks]
        holding, self._tasks = robot.holding, list(self.helper.tasks)
        grasped = (len(robot.done) + len(robot.failed), holding)
        if holding is None or grasped == self._grasped:
            self._grasped = grasped if holding is None else self._grasped
            return
        self._grasped = grasped
        task = next((task for task in tasks if task.step == robot.current), None)
        if task is None:
            told = f"{robot.current}, which nobody asked for any more, at {self.simulation.time:.1f} s"
            self.wrong_interventions.append(told)
            return
        record, action = self.records[task.mind.partner], _text(task.action)
        made = record.help.get((_goal(task), action))
        kept = made is not None and made.promised and made.outcome in OPEN
        if not record.needs(action) and not kept:
            self.wrong_interventions.append(f"{action} for {_goal(task)} at {self.simulation.time:.1f} s")

    def summary(self, name: str) -> dict[str, Any]:
        """What is true of one partner: see the module."""
        record = self.records[name]
        return {
            "goals": record.goals,
            "believed": record.believed,
            "right": record.is_right,
            "wrong_interventions": self.wrong_interventions,
            "help": [help_.to_json() for help_ in record.help.values()],
            "help_ended": all(help_.has_ended for help_ in record.help.values()),
        }


def _announced(record: Record, goal: str, actions: list[str]) -> None:
    """A plan says what the robot will do for a goal now, and with that what it will not do any more."""
    for action in actions:
        before = record.help.get((goal, action))
        if before is None or before.outcome not in OPEN:
            record.help[goal, action] = Help(goal, action, promised=record.needs(action))
    for help_ in record.help.values():
        if help_.goal == goal and help_.action not in actions and help_.outcome in OPEN:
            help_.outcome, help_.because = "dropped", "it is not planned any more"
            help_.is_true = not record.needs(help_.action, goal)


def _reported(record: Record, data: Mapping[str, Any]) -> None:
    """What the robot says it did, or why not."""
    status, action = data["status"], data["action"]
    if status == "done":
        record.was_done(action)
    for help_ in record.help.values():
        if help_.action == action and help_.outcome in OPEN:
            help_.outcome, help_.because = status, data.get("reason", "")
            help_.is_true = status in ("asked", "done") or bool(help_.because)
        elif status == "failed" and help_.outcome == "asked":
            help_.outcome, help_.because = status, f"{action} was not done before: {data.get('reason', '')}"


def _goal(task: Task) -> str:
    made = task.supervisor.commitment
    return "" if made is None else str(made.goal)


def _text(action: Compound) -> str:
    return term_text(as_term(action))
