"""A trial of the paper's experiment (section V-E): a partner pursues a goal, the mind watches, the robot helps.

    partner (script) -> physics -> sensor -> world state -> mind -> events -> robot (physics)
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.mind import Mind
from casper.engine.settings import check_seed, require
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.sim_adapter.room.scene import scene_from
from casper.sim_adapter.script import ScriptedAction, script_for, step_for
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step

LONGEST = 600.0  # simulated seconds after which a trial is given up
AFTERWARDS = 6.0  # simulated seconds watched after the partner is done, so that the last action can be recognised


@dataclass(frozen=True, slots=True)
class TrialSettings:
    """What a trial is about; the goal is drawn from the seed when None."""

    goal: str | None = None
    seed: int = 0
    verification: bool = True
    robot: bool = True
    policy: str = "strict"
    noise: float | None = None
    goals: int = 1


@dataclass
class Trial:
    """One run of the experiment; iterate over ``events()`` to carry it out.

    Raises:
        DomainError, PlanError: the domain lacks a scene or goals, the goal is unknown or cannot be acted out, or the
            seed is no whole number from 0.
    """

    domain: Domain
    settings: TrialSettings
    simulation: Simulation = field(init=False)
    mind: Mind = field(init=False)

    def __post_init__(self) -> None:
        goals = self.domain.library.goals
        check_seed(self.settings.seed)
        require(bool(goals), f"the domain {self.domain.name} has no goals, so nobody can pursue one; write a plans.pl")
        self.goal = self.settings.goal or random.Random(self.settings.seed).choice(list(goals))
        self.script = script_for(self.domain, self.goal)
        self.simulation = Simulation(scene_from(self.domain.kb.rows), seed=self.settings.seed)
        chosen = self.settings
        self.mind = Mind(
            self.domain,
            verification=chosen.verification,
            policy=chosen.policy,
            helps=chosen.robot,
            noise=chosen.noise,
            goals=chosen.goals,
        )
        self.left_to_robot: list[ScriptedAction] = []
        self.last_action_done: float | None = None  # when the partner finished the last action of their own
        self._reported = 0
        self._robot_asked: list[tuple[Compound, Step]] = []
        self._human_done = 0
        self._consuming = set(self.domain.kb.rows("consumes", 1))

    def events(self) -> Iterator[Event]:
        """Everything that happens, as it happens; the last event is the ``summary``."""
        self.simulation.human.do([scripted.step for scripted in self.script])
        period, idle_since = self.simulation.scene.sim.period, None
        while self.simulation.time < LONGEST:
            self.simulation.advance(period)
            now = self.simulation.time
            for event in self.mind.update(self.simulation.observe()):
                yield event
                if event.type == "plan":
                    self._delegate()
            yield from self._help(now)
            self._notice_partner(now)
            if not self._is_over():
                idle_since = None
            elif idle_since is None:
                idle_since = now
            elif now - idle_since >= AFTERWARDS:
                break
        yield self._summary()

    # --- the partner -----------------------------------------------------------------------------------------------

    def _delegate(self) -> None:
        """The robot has announced its part: the partner leaves what they have not begun to it."""
        announced = set(self.mind.supervisor.actions)
        offered = [s for s in self.script if s.action in announced]
        dropped = self.simulation.human.leave([s.step for s in offered])
        self.left_to_robot += [s for s in offered if s.step in dropped]

    def _notice_partner(self, now: float) -> None:
        """Take note of what the partner has finished; what was eaten up is gone (``consumes(Action)``)."""
        finished = self.simulation.human.done[self._human_done :]
        self._human_done += len(finished)
        for scripted in (s for s in self.script if s.step in finished):
            self.last_action_done = now
            if (scripted.action.functor,) in self._consuming:
                self.simulation.remove(scripted.step.target or "")

    # --- the robot -------------------------------------------------------------------------------------------------

    def _help(self, now: float) -> Iterator[Event]:
        """Send the robot off when its turn has come, and report what it does."""
        supervisor, robot = self.mind.supervisor, self.simulation.robot
        if supervisor.ready and not self._robot_asked:
            self._robot_asked = [(action, step_for(self.domain, action)) for action in supervisor.actions]
            robot.do([step for _, step in self._robot_asked])
            for action, _ in self._robot_asked:
                yield _robot_event(now, action, "asked")
        for action, _ in self._robot_asked[self._reported : len(robot.done)]:
            self._reported += 1
            yield _robot_event(now, action, "done")
        if robot.failed and self._reported < len(self._robot_asked):
            step, reason = robot.failed[-1]
            action = next(a for a, s in self._robot_asked if s == step)
            self._reported = len(self._robot_asked)
            yield _robot_event(now, action, "failed", reason)

    @property
    def robot_done(self) -> bool:
        """Whether the robot's part is physically finished: every action done, every object resting where it belongs."""
        asked, robot = self._robot_asked, self.simulation.robot
        if not asked or robot.failed or len(robot.done) < len(asked):
            return False
        return all(self.simulation.rests_in(str(action[1]), str(action[2])) for action, _ in asked)

    def _is_over(self) -> bool:
        human, robot = self.simulation.human, self.simulation.robot
        if not human.idle or not robot.idle:
            return False
        return not self.mind.supervisor.ready or bool(self._robot_asked)

    # --- the end ---------------------------------------------------------------------------------------------------

    def _summary(self) -> Event:
        asked = [term_text(as_term(action)) for action, _ in self._robot_asked]
        data = self.mind.summary(self.goal, self.settings.seed)
        data["robot"] = {"actions": asked, "done": self.robot_done}
        return Event("summary", self.simulation.time, {**data, "partner_finished": self.last_action_done})


def _robot_event(t: float, action: Compound, status: str, reason: str = "") -> Event:
    data = {"action": term_text(as_term(action)), "status": status}
    return Event("robot", t, {**data, "reason": reason} if reason else data)
