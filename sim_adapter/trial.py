"""A trial of the paper's experiment (section V-E), or a whole day: partners pursue goals, minds watch, the robot helps.

partner (script) -> physics -> sensor -> world state -> mind -> events -> robot (physics)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.perception.world import WorldState
from casper.engine.settings import check_seed
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term
from casper.sim_adapter.helping import Helper
from casper.sim_adapter.partners.behaviours.table import PLAIN, behaving, check_behaviours
from casper.sim_adapter.partners.conduct import Conduct, Surroundings, plain
from casper.sim_adapter.partners.goals import goals_of_partners
from casper.sim_adapter.partners.partner import Partner, check_bodies
from casper.sim_adapter.physics.stability import PhysicsFailed
from casper.sim_adapter.room.facts import scene_of
from casper.sim_adapter.room.scene import BODY, Scene
from casper.sim_adapter.script import ScriptedAction
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.truth import Truth

LONGEST = 600.0  # simulated seconds a goal after which a trial is given up
FIGURES = ("goal", "correct", "predicted", "prediction_time", "observed", "missed", "waiting", "planned")
VISITOR = "visitor"  # a third person, whose goals nobody reads
AFTERWARDS = 6.0  # simulated seconds watched after the partner is done, so that the last action can be recognised


@dataclass(frozen=True, slots=True)
class TrialSettings:
    """What a trial is about.

    ``goal`` is a goal's label, or several with commas, pursued one after the other, or dealt out in turn where there
    are several partners; what is not named is drawn from the seed. ``goals_in_a_row`` is how many there are in all, of
    each partner (None: as many as are named, at least one), ``goals`` how many the mind takes to be pursued at once.
    Who ``changes_mind`` gives the first up for the second after one action. ``certainty`` is how sure a goal must be
    before the robot acts on it (None: as the domain says).
    ``partner`` is how they behave besides
    (`casper.sim_adapter.partners.behaviours.table`): plain, one of the behaviours or several with commas, or mixed.
    ``body`` is the robot's (`casper.sim_adapter.physics.bodies.table`).
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
    certainty: float | None = None
    partner: str = PLAIN
    body: str = BODY

    @property
    def wanted(self) -> list[str]:
        """The goals that are named."""
        return [name.strip() for name in (self.goal or "").split(",") if name.strip()]


@dataclass
class Trial:
    """One run of the experiment; iterate over ``events()`` to carry it out.

    Raises:
        CasperError: what the robot's body is made of is missing.
        DomainError, PlanError: the domain lacks a scene or goals, a goal is unknown or cannot be acted out, or the
            seed or the number of goals is none, there is no such behaviour or body, or nobody can behave so there.
    """

    domain: Domain
    settings: TrialSettings
    simulation: Simulation = field(init=False)
    minds: Partners = field(init=False)
    partners: dict[str, Partner] = field(init=False)
    helper: Helper = field(init=False)
    truth: Truth = field(init=False)
    behaviours: tuple[str, ...] = field(init=False)  # of the partners; none of plain ones
    each_step: Callable[[], object] = field(default=bool, init=False)  # called at the start and after every period
    sensed: Callable[[WorldState], object] = field(default=bool, init=False)  # handed what the minds are about to see

    def __post_init__(self) -> None:
        chosen = self.settings
        check_seed(chosen.seed)
        scene = replace(scene_of(self.domain), body=chosen.body)
        check_bodies(self.domain, scene)
        day = (chosen.wanted, chosen.goals_in_a_row, chosen.changes_mind, chosen.seed)
        goals = goals_of_partners(self.domain, scene, *day)
        conducts = self._conducts(scene, goals)
        visit = [step for conduct in conducts.values() for step in conduct.visit]
        self.simulation = Simulation(_with_visitor(scene) if visit else scene, seed=chosen.seed)
        how: dict[str, Any] = {"seed": chosen.seed, "helped": chosen.robot}
        self.partners = {
            name: Partner(self.domain, self.simulation, goals[name], conduct=conduct, name=name, **how)
            for name, conduct in conducts.items()
        }
        for step in visit:
            self.simulation.people[VISITOR].do([step])
        self.helper = Helper(self.domain, self.simulation)
        self.truth = Truth(self.simulation, self.partners, self.helper)
        self.minds = Partners(
            self.domain,
            verification=chosen.verification,
            policy=chosen.policy,
            helps=chosen.robot,
            noise=chosen.noise,
            goals=chosen.goals,
            certainty=chosen.certainty,
        )

    def _conducts(self, scene: Scene, goals: Mapping[str, Sequence[str]]) -> dict[str, Conduct]:
        """What each partner sets out to do, in the way that is asked for."""
        chosen, found = self.settings, {}
        surroundings = Surroundings(self.domain, scene, chosen.seed)
        self.behaviours = check_behaviours(chosen.partner)
        for name, theirs in goals.items():
            conduct = plain(surroundings, theirs, chosen.changes_mind)
            found[name], self.behaviours = behaving(conduct, chosen.partner, surroundings)
        return found

    @property
    def mind(self) -> Mind:
        """The mind that watches the first partner."""
        return self.minds.first

    @property
    def partner(self) -> Partner:
        """The first partner."""
        return self.partners[self.mind.partner]

    @property
    def goal(self) -> str:
        """The partner's goal, the first of several."""
        return self.partner.pursuits[0].goal

    @property
    def script(self) -> list[ScriptedAction]:
        """What they would do for it on their own."""
        return list(self.partner.pursuits[0].script)

    def events(self) -> Iterator[Event]:
        """Everything that happens, as it happens; the last event is the ``summary``.

        Where the simulated physics became unstable the trial ends there, and the summary says so (``ended``).
        """
        now, ended = 0.0, None
        try:
            for event in self._happens():
                now = event.t
                yield event
        except PhysicsFailed as reason:
            ended = str(reason)
        now = now if ended else self.simulation.time
        last = list(self.minds.end(now))
        self.truth.see(last, is_end=True)
        yield from last
        yield self._summary(now, ended)

    def _happens(self) -> Iterator[Event]:
        for partner in self.partners.values():
            partner.begin()
        self.each_step()
        period, idle_since = self.simulation.scene.sim.period, None
        longest = LONGEST * max(len(partner.pursuits) for partner in self.partners.values())
        while self.simulation.time < longest:
            self.simulation.advance(period)
            self.each_step()
            now = self.simulation.time
            world = self.simulation.observe()
            self.sensed(world)
            told = self.minds.update(world)
            yield from told
            self._heard(told)
            did = list(self.helper.update(list(self.minds.minds.values()), now))
            yield from did
            self._heard(did)
            for partner in self.partners.values():
                partner.notice(now, self.helper.finished)
                partner.wait(now)
                self._go_on(partner)
            self.truth.see((*told, *did))
            if not self._is_over():
                idle_since = None
            elif idle_since is None:
                idle_since = now
            elif now - idle_since >= AFTERWARDS:
                break

    def _heard(self, told: Sequence[Event]) -> None:
        """The partners hear what the robot announces and withdraws."""
        for name, partner in self.partners.items():
            theirs = [event for event in told if name in (event.data.get("partner"), event.data.get("agent"))]
            types = {event.data["status"] if event.type == "robot" else event.type for event in theirs}
            mind = self.minds.minds.get(name)
            if mind is None:  # not in view yet
                continue
            announced = {action for supervisor in mind.course.supervisors for action in supervisor.actions}
            if "plan" in types:
                partner.heed(announced)
            if "withdrawn" in types or "failed" in types:
                partner.take_back(announced)

    def _go_on(self, partner: Partner) -> None:
        """A partner goes on to the next goal, once the robot needs none of what it is about."""
        if partner.waits and not partner.needs(self.helper.things):
            self.helper.settle()
            partner.begin()

    def _is_over(self) -> bool:
        if not self.simulation.robot.idle or not all(partner.idle for partner in self.partners.values()):
            return False
        supervisors = (s for mind in self.minds.minds.values() for s in mind.course.supervisors)
        return not any(supervisor.ready and supervisor.left for supervisor in supervisors)

    # --- the end ---------------------------------------------------------------------------------------------------

    def _summary(self, t: float, ended: str | None) -> Event:
        rows = [self._row(name) for name in self.partners]
        data = {**self.minds.summary(seed=self.settings.seed), **rows[0]}
        asked = [term_text(as_term(action)) for action in self.helper.asked]
        data["behaviour"] = {"names": list(self.behaviours), "told": list(self.partner.conduct.told)}
        data["truth"] = self.truth.summary(self.mind.partner)
        done = ended is None and self.helper.robot_done
        data["robot"] = {"actions": asked, "done": done, **self._kept(), "gave_up": self.helper.reasons}
        data |= {} if ended is None else {"ended": ended}
        if len(rows) > 1:
            parts = [self.helper.part_of(name) for name in self.partners]
            data["correct"] = all(row["correct"] for row in rows)
            data["robot"]["done"] = ended is None and all(part["done"] for part in parts)
            each = zip(self.partners, rows, parts)
            data["partners"] = [{"agent": name, **row, "robot": part} for name, row, part in each]
        return Event("summary", t, data).about(self.mind.partner)

    def _kept(self) -> dict[str, float | None]:
        """The least distance to people while the robot moved (m), and its speed then (m/s); None: it never did."""
        space = self.simulation.robot.space
        if space.least == math.inf:
            return {"least_distance": None, "speed_at_least_distance": None}
        return {"least_distance": round(space.least, 3), "speed_at_least_distance": round(space.speed, 3)}

    def _row(self, name: str) -> dict[str, Any]:
        """What became of one partner's goals: which they were, and whether they, and no others, were read as such."""
        partner, mind = self.partners[name], self.minds.minds.get(name)
        last = partner.pursuits[-1].goal
        told = (mind or self.mind).summary(last)
        figures = {key: told[key] for key in FIGURES} | {"partner_finished": partner.last_action_done}
        if mind is None:
            figures |= {"predicted": None, "correct": False, "prediction_time": None}
        if self.behaviours:
            truth = self.truth.records[name]
            return {**figures, "goals": truth.goals, "correct": truth.is_right}
        if len(partner.pursuits) == 1 or mind is None:
            return figures
        wanted = [pursuit.goal for pursuit in partner.pursuits if not pursuit.given_up]
        read = [row["goal"] for row in told["episodes"] if row["outcome"] == "finished"]
        goals = [pursuit.goal for pursuit in partner.pursuits]
        return {**figures, "goals": goals, "correct": sorted(read) == sorted(wanted)}


def _with_visitor(scene: Scene) -> Scene:
    """The scene with one more person in it."""
    return replace(scene, people=(*scene.people, VISITOR))
