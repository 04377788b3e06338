"""The simulated partner's day: one goal after the other, a change of mind, and what is left to the robot."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field

from casper.engine.domain.domain import Domain
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound
from casper.sim_adapter.human.human import Human
from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings, plain
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.script import ScriptedAction
from casper.sim_adapter.simulation import Simulation
from casper.sim_adapter.steps import Step

PATIENCE = 20.0  # seconds they wait for an idle robot before they do themselves what was left to it


@dataclass
class Pursuit:
    """A stretch that the partner goes through: which steps of it are left to the robot, and which they insist on."""

    stretch: Stretch
    left: list[ScriptedAction] = field(default_factory=list)
    kept: list[ScriptedAction] = field(default_factory=list)

    @property
    def goal(self) -> str:
        """What they are after, the first of several at once."""
        return self.stretch.goals[0]

    @property
    def given_up(self) -> bool:
        """Whether they give it up before it is reached."""
        return self.stretch.stops is not None

    @property
    def script(self) -> tuple[ScriptedAction, ...]:
        """The steps that they go through."""
        return self.stretch.script[: self.stretch.stops]


def check_bodies(domain: Domain, scene: Scene) -> None:
    """See that those whom the domain watches and who helps have the scene's bodies.

    Raises:
        DomainError: one has none, with the place of the body that the scene has, and what to do.
    """
    for role, name, bodies, kind in (
        ("partner", domain.partner, scene.people, "person"),
        ("robot", domain.robot, (scene.robot,), "mobile_manipulator"),
    ):
        if name not in bodies:
            body = bodies[0]
            place = next((c.place for c in domain.kb.clauses_of(("body", 2)) if c.head.args == (body, kind)), None)
            sentence = f"the {role} {name} has no body in the scene: state body({name}, {kind}) instead of"
            raise DomainError(f"{sentence} body({body}, {kind}), or setting(agents, {role}, {body})", place)


class Partner:
    """Carries out goals in the simulation.

    Between two goals everything the next one is about is put back where it was at the start (what was eaten is there
    anew), and the partner waits until the robot needs none of it. A step that is somebody else's, by(robot, …) or
    by(otto, …), they wait for, out of the way.

    Args:
        domain: whose plans.
        simulation: where.
        goals: labels, in order; of none is made use where there is a ``conduct``.
        changes_mind: the first goal is given up for the second after its first action; the world is as it was left.
        conduct: what they do for the goals, where it is not the plain thing.
        name: who they are; None: the first of the people.
        seed: of the way they take, where the plans allow several.
        helped: whether there is a robot that helps; without one they stop before a step that only it could do.

    Raises:
        DomainError, PlanError: there is no such goal, or it cannot be acted out.
    """

    def __init__(
        self,
        domain: Domain,
        simulation: Simulation,
        goals: Sequence[str],
        changes_mind: bool = False,
        *,
        conduct: Conduct | None = None,
        name: str | None = None,
        seed: int = 0,
        helped: bool = True,
    ) -> None:
        self.simulation = simulation
        self.name = name or simulation.scene.human
        self.human: Human = simulation.people[self.name]
        self.helped = helped
        self.conduct = conduct or plain(Surroundings(domain, simulation.scene, seed), goals, changes_mind)
        self.pursuits = [Pursuit(stretch) for stretch in self.conduct.stretches]
        self.last_action_done: float | None = None  # when the last action of their own was finished
        self.did: list[ScriptedAction] = []  # all of their own that is finished, in order
        self._consuming = set(domain.kb.rows("consumes", 1))
        self.at = -1  # the number of the stretch that they are at
        self._heard = 0  # actions of the robot that were taken note of
        self._waits_since: float | None = None
        self._undone: list[ScriptedAction] = []  # of that stretch
        self._seen = 0  # finished steps that were taken note of
        self._rest: deque[ScriptedAction] = deque()  # from the next step on that is somebody else's
        self._asked = False  # whether that somebody was asked
        self._robot = simulation.scene.robot

    @property
    def now(self) -> Pursuit:
        """What they are after, or were last."""
        return self.pursuits[max(self.at, 0)]

    def wait(self, t: float) -> None:
        """Wait for what is left to the robot; when nothing comes of it for a while, they do it themselves."""
        if not (self.now.left and self.human.idle and self.simulation.robot.idle):
            self._waits_since = None
        elif self._waits_since is None:
            self._waits_since = t
        elif t - self._waits_since >= PATIENCE:
            self.take_back(())

    @property
    def finished(self) -> bool:
        """Whether nothing of their own is left to be done for what they are after."""
        own = any(self._is_own(scripted) for scripted in self._rest) and (self.helped or not self._waits_for_robot)
        return self.human.idle and not own

    @property
    def idle(self) -> bool:
        """Whether nothing of their own is left to be done."""
        return self.finished and self.at == len(self.pursuits) - 1 and not (self.helped and self.now.left)

    @property
    def waits(self) -> bool:
        """Whether they are done with one goal and the next has not begun."""
        return self.finished and self.at < len(self.pursuits) - 1

    @property
    def busy_with(self) -> list[ScriptedAction]:
        """What they did last, and what they do."""
        current = next((scripted for scripted in self._undone if scripted.step == self.human.current), None)
        return [*self.did[-1:], *([] if current is None else [current])]

    def begin(self) -> None:
        """Go after the next goal."""
        changed = self.at >= 0 and self.now.given_up
        self.at += 1
        if self.at and not changed:
            for thing in sorted(self.now.stretch.things):
                if self.simulation.scene.thing(thing).movable:
                    self.simulation.put_back(thing)
        self._rest, self._undone = deque(self.now.script), list(self.now.script)
        self._go_on()

    def needs(self, things: Collection[str]) -> bool:
        """Whether the next goal is about one of the things."""
        return not self.pursuits[self.at + 1].stretch.things.isdisjoint(things)

    def heed(self, announced: Collection[Compound]) -> None:
        """The robot has announced its part: what they have not begun of it is left to the robot, but what they keep."""
        if self.conduct.keeps is None:
            return
        offered = [scripted for scripted in self.now.script if scripted.action in announced]
        if not self.now.kept:
            self.now.kept = offered[: self.conduct.keeps]
        offered = [scripted for scripted in offered if scripted not in self.now.kept]
        dropped = self.human.leave([scripted.step for scripted in offered])
        left = [s for s in offered if s.step in dropped or (s in self._rest and self._is_own(s))]
        self._rest = deque(s for s in self._rest if s not in left)
        self.now.left += left

    def take_back(self, announced: Collection[Compound]) -> None:
        """The robot does no more than that: they do the rest of what they had left to it."""
        again = [scripted for scripted in self.now.left if scripted.action not in announced]
        self.now.left = [scripted for scripted in self.now.left if scripted.action in announced]
        if self._rest:
            self._rest += again
        else:
            self.human.do([scripted.step for scripted in again])

    def notice(self, t: float, robot_did: Iterable[Compound] = ()) -> None:
        """Take note of what was finished; what was eaten up is gone (``consumes(Action)``).

        Args:
            t: when, in seconds.
            robot_did: all that the robot has done so far.
        """
        robot_did = list(robot_did)
        for action in robot_did[self._heard :]:
            self.now.left = [scripted for scripted in self.now.left if scripted.action != action]
        self._heard = len(robot_did)
        finished = self.human.done[self._seen :]
        self._seen += len(finished)
        for step in finished:
            scripted = next((s for s in self._undone if s.step == step and self._is_own(s)), None)
            if scripted is None:
                continue
            self._undone.remove(scripted)
            self.did.append(scripted)
            self.last_action_done = t
            if scripted.action is not None and (scripted.action.functor,) in self._consuming:
                self.simulation.remove(scripted.step.target or "")
        if self._rest and self._was_done(self._rest[0], robot_did):
            self._rest.popleft()
            self._asked = False
            self._go_on()

    # --- steps of others -------------------------------------------------------------------------------------------

    def _is_own(self, scripted: ScriptedAction) -> bool:
        return scripted.by in (None, self.name)

    @property
    def _waits_for_robot(self) -> bool:
        return bool(self._rest) and self._rest[0].by == self._robot

    def _go_on(self) -> None:
        """Do all up to the next step of somebody else, then stand aside; at the end, too, where others must get by."""
        own = []
        while self._rest and self._is_own(self._rest[0]):
            own.append(self._rest.popleft().step)
        aside = own and (self._rest or self.now.left or len(self.simulation.people) > 1)
        self.human.do([*own, Step("stand_aside")] if aside else own)

    def _was_done(self, scripted: ScriptedAction, robot_did: Iterable[Compound]) -> bool:
        """Whether somebody else has done their step; a person is asked when its time has come."""
        if scripted.by == self._robot:
            return any(scripted.action == action for action in robot_did)
        other = self.simulation.people.get(scripted.by or "")
        if other is None or not self.human.idle:
            return False
        if not self._asked:
            self._asked = True
            other.do([scripted.step])
        return scripted.step in other.done
