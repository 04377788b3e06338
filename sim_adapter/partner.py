"""The simulated partner's day: one goal after the other, a change of mind, and what is left to the robot."""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from casper.engine.domain.domain import Domain
from casper.engine.settings import require
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.script import ScriptedAction, script_for
from casper.sim_adapter.simulation import Simulation


@dataclass
class Pursuit:
    """A goal that the partner goes after: its steps, how many of them they do, and which are left to the robot."""

    goal: str
    script: list[ScriptedAction]
    given_up: bool = False
    left: list[ScriptedAction] = field(default_factory=list)

    @property
    def things(self) -> set[str]:
        """The objects it is about."""
        return {name for s in self.script for name in (s.step.target, s.step.destination) if name is not None}


def goals_of_a_day(
    domain: Domain, wanted: Sequence[str], in_a_row: int | None, changes_mind: bool, seed: int
) -> list[str]:
    """The goals that the partner goes after: those asked for, the others drawn from the seed.

    Args:
        domain: whose goals.
        wanted: labels of goals, in order; the first few, when more are asked for.
        in_a_row: how many; None: as many as are wanted, at least one, and another one for a change of mind.
        changes_mind: whether the first is given up for the second.
        seed: of those that are drawn.

    Raises:
        DomainError: no such goal, none at all, fewer in a row than are wanted, or no other goal to change to.
    """
    known = list(domain.library.goals)
    require(bool(known), f"the domain {domain.name} has no goals, so nobody can pursue one; write a plans.pl")
    for goal in wanted:
        require(goal in known, f"there is no goal {goal!r}: choose {', '.join(known)}")
    least = 2 if changes_mind else 1
    count = max(len(wanted), least) if in_a_row is None else in_a_row
    require(count >= least, f"{count} goals in a row are too few: it takes {least} or more")
    require(count >= len(wanted), f"{len(wanted)} goals are asked for, so it takes as many in a row, not {count}")
    chosen, draw = list(wanted), random.Random(seed)
    while len(chosen) < count:
        others = [g for g in known if g != chosen[0]] if changes_mind and len(chosen) == 1 else known
        require(bool(others), f"there is no goal but {chosen[0]} to change to" if chosen else "there is no goal")
        chosen.append(draw.choice(others))
    if changes_mind and chosen[0] == chosen[1]:
        raise DomainError(f"a change of mind needs another goal: it is {chosen[0]} before and after")
    return chosen


def check_bodies(domain: Domain, scene: Scene) -> None:
    """See that those whom the domain watches and who helps have the scene's bodies.

    Raises:
        DomainError: one has none, with the place of the body that the scene has, and what to do.
    """
    for role, name, body, kind in (
        ("partner", domain.partner, scene.human, "person"),
        ("robot", domain.robot, scene.robot, "mobile_manipulator"),
    ):
        if name != body:
            place = next((c.place for c in domain.kb.clauses_of(("body", 2)) if c.head.args == (body, kind)), None)
            sentence = f"the {role} {name} has no body in the scene: state body({name}, {kind}) instead of"
            raise DomainError(f"{sentence} body({body}, {kind}), or setting(agents, {role}, {body})", place)


class Partner:
    """Carries out goals in the simulation.

    Between two goals everything the next one is about is put back where it was at the start (what was eaten is there
    anew), and the partner waits until the robot needs none of it.

    Args:
        domain: whose plans.
        simulation: where.
        goals: labels, in order.
        changes_mind: the first goal is given up for the second after its first action; the world is as it was left.

    Raises:
        DomainError, PlanError: there is no such goal, or it cannot be acted out.
    """

    def __init__(
        self, domain: Domain, simulation: Simulation, goals: Sequence[str], changes_mind: bool = False
    ) -> None:
        self.simulation = simulation
        self.pursuits = [Pursuit(goal, script_for(domain, goal)) for goal in goals]
        if changes_mind:
            first = self.pursuits[0]
            first.script, first.given_up = first.script[:1], True
        self.last_action_done: float | None = None  # when the last action of their own was finished
        self._consuming = set(domain.kb.rows("consumes", 1))
        self._at = -1
        self._seen = 0  # finished steps that were taken note of

    @property
    def now(self) -> Pursuit:
        """What they are after, or were last."""
        return self.pursuits[max(self._at, 0)]

    @property
    def idle(self) -> bool:
        """Whether nothing of their own is left to be done."""
        return self.simulation.human.idle and self._at == len(self.pursuits) - 1

    @property
    def waits(self) -> bool:
        """Whether they are done with one goal and the next has not begun."""
        return self.simulation.human.idle and not self.idle

    def begin(self) -> None:
        """Go after the next goal."""
        changed = self._at >= 0 and self.now.given_up
        self._at += 1
        if self._at and not changed:
            for thing in sorted(self.now.things):
                if self.simulation.scene.thing(thing).movable:
                    self.simulation.put_back(thing)
        self.simulation.human.do([scripted.step for scripted in self.now.script])

    def needs(self, things: Collection[str]) -> bool:
        """Whether the next goal is about one of the things."""
        return not self.pursuits[self._at + 1].things.isdisjoint(things)

    def heed(self, announced: Collection[Compound]) -> None:
        """The robot has announced its part: what they have not begun of it is left to the robot."""
        offered = [scripted for scripted in self.now.script if scripted.action in announced]
        dropped = self.simulation.human.leave([scripted.step for scripted in offered])
        self.now.left += [scripted for scripted in offered if scripted.step in dropped]

    def take_back(self, announced: Collection[Compound]) -> None:
        """The robot does no more than that: they do the rest of what they had left to it."""
        again = [scripted for scripted in self.now.left if scripted.action not in announced]
        self.now.left = [scripted for scripted in self.now.left if scripted.action in announced]
        self.simulation.human.do([scripted.step for scripted in again])

    def notice(self, t: float) -> None:
        """Take note of what they have finished; what was eaten up is gone (``consumes(Action)``)."""
        finished = self.simulation.human.done[self._seen :]
        self._seen += len(finished)
        for scripted in (s for s in self.now.script if s.step in finished):
            self.last_action_done = t
            if (scripted.action.functor,) in self._consuming:
                self.simulation.remove(scripted.step.target or "")
