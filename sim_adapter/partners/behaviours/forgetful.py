"""Forgets a step and comes back to it: notices when at the next one, or when the next one is done already."""

from __future__ import annotations

import random
from itertools import pairwise

from casper.kb.errors import DomainError
from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings
from casper.sim_adapter.steps import Step

SHORTEST, LONGEST = 2.0, 4.0  # seconds until they notice


def forgetful(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """Of each goal one step of their own is forgotten, and done after all.

    What was to be done with a thing at a place, where the next step takes the thing away: the next step is done, the
    thing brought back, and both are done. Any other: they go where the next step is to be done, stand there, go back.
    """
    for at, stretch in enumerate(conduct.stretches):
        lapses = _lapses(stretch, surroundings.own(stretch), round(draw.uniform(SHORTEST, LONGEST), 1))
        if not lapses:
            goals = " and ".join(stretch.goals)
            raise DomainError(f"no step of {goals} can be forgotten: each is done where the next one is")
        number, steps = draw.choice(lapses)
        told = f"forgets {stretch.script[number].step} and comes back to it"
        conduct = conduct.changed(at, stretch.with_asides(number, *steps), told)
    return conduct


def _lapses(stretch: Stretch, own: int, pause: float) -> list[tuple[int, tuple[Step, ...]]]:
    """Which steps can be forgotten, and what is done in their stead at first."""
    found: list[tuple[int, tuple[Step, ...]]] = []
    script = [scripted.step for scripted in stretch.script]
    for number, (step, coming) in enumerate(pairwise(script[: own + 1])):
        before = script[number - 1] if number else None
        if coming.skill == "pick_and_place" and step.skill == "use" and coming.target == step.target:
            if before == Step("pick_and_place", step.target, step.destination):
                found.append((number, (coming, before)))
        elif _place(coming) not in (None, step.target if number == 0 else _place(step)):
            found.append((number, (Step("walk_to", _place(coming)), Step("still", seconds=pause))))
    return found


def _place(step: Step) -> str | None:
    """Where a step begins."""
    return step.destination if step.skill == "use" else step.target
