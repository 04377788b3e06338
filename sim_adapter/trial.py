"""A trial of the paper's experiment (section V-E), or a whole day: a partner pursues goals, the mind watches, the robot
helps.

    partner (script) -> physics -> sensor -> world state -> mind -> events -> robot (physics)
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.mind import Mind
from casper.engine.settings import check_seed
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.sim_adapter.helping import Helper
from casper.sim_adapter.partner import Partner, check_bodies, goals_of_a_day
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.script import ScriptedAction
from casper.sim_adapter.simulation import Simulation

LONGEST = 600.0  # simulated seconds a goal after which a trial is given up
AFTERWARDS = 6.0  # simulated seconds watched after the partner is done, so that the last action can be recognised


@dataclass(frozen=True, slots=True)
class TrialSettings:
    """What a trial is about.

    ``goal`` is a goal's label, or several with commas, pursued one after the other; what is not named is drawn from the
    seed. ``goals_in_a_row`` is how many there are in all (None: as many as are named, at least one), ``goals``
    how many the mind takes to be pursued at once. Who ``changes_mind`` gives the first up for the second after one
    action.
    """

    goal: str | None = None
    seed: int = 0
    verification: bool = True
    robot: bool = True
    policy: str = "strict"
    noise: float | None = None
    goals: int = 1
    goals_in_a_row: int | None = None
    changes_mind: bool = False

    @property
    def wanted(self) -> list[str]:
        """The goals that are named."""
        return [name.strip() for name in (self.goal or "").split(",") if name.strip()]


@dataclass
class Trial:
    """One run of the experiment; iterate over ``events()`` to carry it out.

    Raises:
        DomainError, PlanError: the domain lacks a scene or goals, a goal is unknown or cannot be acted out, or the
            seed or the number of goals is none.
    """

    domain: Domain
    settings: TrialSettings
    simulation: Simulation = field(init=False)
    mind: Mind = field(init=False)
    partner: Partner = field(init=False)
    helper: Helper = field(init=False)

    def __post_init__(self) -> None:
        chosen = self.settings
        check_seed(chosen.seed)
        goals = goals_of_a_day(self.domain, chosen.wanted, chosen.goals_in_a_row, chosen.changes_mind, chosen.seed)
        scene = scene_of(self.domain)
        check_bodies(self.domain, scene)
        self.simulation = Simulation(scene, seed=chosen.seed)
        self.partner = Partner(self.domain, self.simulation, goals, chosen.changes_mind)
        self.helper = Helper(self.domain, self.simulation)
        self.mind = Mind(
            self.domain,
            verification=chosen.verification,
            policy=chosen.policy,
            helps=chosen.robot,
            noise=chosen.noise,
            goals=chosen.goals,
        )

    @property
    def goal(self) -> str:
        """The partner's goal, the first of several."""
        return self.partner.pursuits[0].goal

    @property
    def script(self) -> list[ScriptedAction]:
        """What they would do for it on their own."""
        return self.partner.pursuits[0].script

    def events(self) -> Iterator[Event]:
        """Everything that happens, as it happens; the last event is the ``summary``."""
        self.partner.begin()
        period, idle_since = self.simulation.scene.sim.period, None
        while self.simulation.time < LONGEST * len(self.partner.pursuits):
            self.simulation.advance(period)
            now = self.simulation.time
            yield from self._watched()
            yield from self.helper.update([self.mind], now)
            self.partner.notice(now)
            self._go_on()
            if not self._is_over():
                idle_since = None
            elif idle_since is None:
                idle_since = now
            elif now - idle_since >= AFTERWARDS:
                break
        yield from self.mind.end(self.simulation.time)
        yield self._summary()

    def _watched(self) -> Iterator[Event]:
        """One world state; the partner hears what the robot announces and withdraws."""
        told = self.mind.update(self.simulation.observe())
        yield from told
        types = {event.type for event in told}
        announced = set(self.mind.supervisor.actions)
        if "plan" in types:
            self.partner.heed(announced)
        if "withdrawn" in types:
            self.partner.take_back(announced)

    def _go_on(self) -> None:
        """The partner goes on to the next goal, once the robot needs none of what it is about."""
        if self.partner.waits and not self.partner.needs(self.helper.things):
            self.helper.settle()
            self.partner.begin()

    def _is_over(self) -> bool:
        if not self.partner.idle or not self.simulation.robot.idle:
            return False
        return not any(supervisor.ready and supervisor.left for supervisor in self.mind.course.supervisors)

    # --- the end ---------------------------------------------------------------------------------------------------

    def _summary(self) -> Event:
        last = self.partner.pursuits[-1].goal
        data = self.mind.summary(last, self.settings.seed)
        asked = [term_text(as_term(action)) for action in self.helper.asked]
        data["robot"] = {"actions": asked, "done": self.helper.robot_done}
        data |= {**self._day(data), "partner_finished": self.partner.last_action_done}
        return Event("summary", self.simulation.time, data).about(self.mind.partner)

    def _day(self, data: dict[str, Any]) -> dict[str, Any]:
        """Of several goals: which they were, and whether those that were finished, and no others, were read as such."""
        pursuits = self.partner.pursuits
        if len(pursuits) == 1:
            return {}
        wanted = [pursuit.goal for pursuit in pursuits if not pursuit.given_up]
        read = [row["goal"] for row in data["episodes"] if row["outcome"] == "finished"]
        return {"goals": [pursuit.goal for pursuit in pursuits], "correct": sorted(read) == sorted(wanted)}
