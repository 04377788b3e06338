"""What a partner sets out to do, as data: stretches of steps, what they leave to the robot, what a visitor does."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from casper.engine.domain.domain import Domain
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.room.spots import free_spots
from casper.sim_adapter.script import ScriptedAction, script_for
from casper.sim_adapter.steps import Step


@dataclass(frozen=True, slots=True)
class Stretch:
    """What a partner does between two times that the room is tidied up.

    ``goals`` are pursued together, in the order in which they are begun; ``script`` has the steps of all, and those
    that serve none (their ``action`` is None). What is given up ``stops`` after that many steps.
    """

    goals: tuple[str, ...]
    script: tuple[ScriptedAction, ...]
    stops: int | None = None

    @property
    def things(self) -> set[str]:
        """The objects its goals are about."""
        steps = [scripted.step for scripted in self.script if scripted.action is not None]
        return {name for step in steps for name in (step.target, step.destination) if name is not None}

    def with_asides(self, at: int, *steps: Step) -> Stretch:
        """The same with steps that serve no goal before the script's step of that number."""
        asides = tuple(ScriptedAction(None, step) for step in steps)
        later = self.stops is not None and at < self.stops
        stops = (self.stops or 0) + len(steps) if later else self.stops
        return replace(self, script=(*self.script[:at], *asides, *self.script[at:]), stops=stops)


@dataclass(frozen=True, slots=True)
class Conduct:
    """Stretch after stretch of one partner.

    ``keeps`` is how many steps of what the robot announces they do all the same (None: every one). ``visit`` is what a
    third person does meanwhile. ``told`` says what is out of the ordinary, in sentences.
    """

    stretches: tuple[Stretch, ...]
    keeps: int | None = 0
    visit: tuple[Step, ...] = ()
    told: tuple[str, ...] = ()

    def changed(self, at: int, stretch: Stretch, told: str) -> Conduct:
        """The same with another stretch of that number, and what is told of it."""
        stretches = (*self.stretches[:at], stretch, *self.stretches[at + 1 :])
        return replace(self, stretches=stretches, told=(*self.told, told))


@dataclass(frozen=True)
class Surroundings:
    """Where a conduct takes place: the domain, its scene, and the seed of the ways that are taken to do things."""

    domain: Domain
    scene: Scene
    seed: int = 0

    def stretch(self, goal: str, number: int = 0) -> Stretch:
        """A goal as it is pursued from beginning to end.

        Raises:
            DomainError, PlanError: there is no such goal, or it cannot be acted out.
        """
        return Stretch((goal,), tuple(script_for(self.domain, goal, self.seed + number)))

    @cached_property
    def goals(self) -> tuple[str, ...]:
        """Labels of all goals."""
        return tuple(self.domain.library.goals)

    def own(self, stretch: Stretch) -> int:
        """How many steps a partner goes through whatever the robot does: up to the last that the robot cannot do."""
        theirs = [at for at, scripted in enumerate(stretch.script) if not self._robot_can(scripted)]
        whole = len(stretch.script) if stretch.stops is None else stretch.stops
        return min(whole, theirs[-1] + 1 if theirs else whole)

    def _robot_can(self, scripted: ScriptedAction) -> bool:
        if scripted.action is None or scripted.by not in (None, self.domain.robot):
            return False
        statement = Compound((scripted.action.functor, self.domain.robot, *scripted.action.args))
        return any(True for _ in self.domain.kb.instances(Compound(("valid", statement))))

    def another(self, stretch: Stretch, conduct: Conduct, draw: random.Random, apart: bool = False) -> Stretch:
        """The stretch after the first, where it has another goal, or one with a goal that is drawn.

        Args:
            stretch: the first.
            conduct: whose; the second of its stretches, where there is one, is what was asked for.
            draw: of the goal.
            apart: whether it must move none of the things that the first moves.

        Raises:
            DomainError: there is no such goal.
        """
        asked = conduct.stretches[1:2]
        found = asked or [self.stretch(goal, 1) for goal in self.goals if goal not in stretch.goals]
        fit = [s for s in found if not apart or self.moved(s).isdisjoint(self.moved(stretch))]
        if not fit or fit[0].goals == stretch.goals:
            sentence = f"there is no goal that can be pursued beside {stretch.goals[0]}"
            advice = "two goals at once must move different things" if apart else "it takes two different goals"
            raise DomainError(f"{sentence}: {advice}")
        return draw.choice(fit)

    def moved(self, stretch: Stretch) -> set[str]:
        """The movable things a stretch is about."""
        return stretch.things & set(self.scene.movables)

    def spots(self, thing: str) -> list[tuple[float, float, float]]:
        """Where a thing may be set down so that it is at none of the places that plans know."""
        return free_spots(self.scene, thing)


Behaviour: TypeAlias = Callable[[Conduct, Surroundings, random.Random], Conduct]
"""Makes of a conduct that of somebody who behaves in a certain way; the same draws give the same.

Raises DomainError where nobody can behave so: the goals, or the room, leave no way.
"""


def plain(surroundings: Surroundings, goals: Sequence[str], changes_mind: bool = False) -> Conduct:
    """One goal after the other, each from beginning to end.

    Args:
        surroundings: where.
        goals: labels, in order.
        changes_mind: the first is given up for the second after its first action.

    Raises:
        DomainError, PlanError: there is no such goal, or it cannot be acted out.
    """
    stretches = [surroundings.stretch(goal, at) for at, goal in enumerate(goals)]
    if changes_mind:
        stretches[0] = replace(stretches[0], stops=1)
    return Conduct(tuple(stretches))
