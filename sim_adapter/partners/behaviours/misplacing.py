"""Puts a thing elsewhere than planned: what is to be moved lies somewhere else first, or what it is brought to does."""

from __future__ import annotations

import random

from casper.kb.errors import DomainError
from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings
from casper.sim_adapter.steps import Step


def misplacing(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """Before something is brought to a place the first time, they set it down elsewhere, or move the place."""
    for at, stretch in enumerate(conduct.stretches):
        found = _chances(stretch, surroundings)
        if not found:
            raise DomainError(f"nothing of {' and '.join(stretch.goals)} can be put elsewhere: there is no free spot")
        before, thing = draw.choice(found)
        step = Step("set_down", thing, spot=draw.choice(surroundings.spots(thing)))
        told = f"puts {thing} elsewhere before step {before + 1}"
        conduct = conduct.changed(at, stretch.with_asides(before, step), told)
    return conduct


def _chances(stretch: Stretch, surroundings: Surroundings) -> list[tuple[int, str]]:
    """Before which step which thing, nothing having been done with it yet."""
    found: list[tuple[int, str]] = []
    touched: set[str] = set()
    for number, scripted in enumerate(stretch.script[: surroundings.own(stretch)]):
        names = {name for name in (scripted.step.target, scripted.step.destination) if name is not None}
        if scripted.step.skill == "pick_and_place":
            fresh = sorted((names - touched) & set(surroundings.scene.movables))
            found += [(number, name) for name in fresh if surroundings.spots(name)]
        touched |= names
    return found
