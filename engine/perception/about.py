"""What an action is about, where things lie on one another: what was in the hand, at a place that is attended to."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations
from casper.engine.perception.world import AgentState, WorldState

TOGETHER = 0.15  # metres within which two things are in one place, as the eye has it
KEPT = 6.0  # seconds for which what was in the hand is what an action is about
KEPT_UNSURE = 30.0  # the same where a tracker is not sure: within arm's reach of it, and unless something else was
REACH = 0.9  # metres
BESIDE = 0.3  # metres farther than the nearest place that another may be which comes into question
ARM = 0.3  # metres, standard deviation of how far from a place something is put that is put there
FARTHEST = 0.9  # metres from where the target is
STEPS = 2  # in a row for which something must be in the hand: one may be misread


@dataclass(frozen=True, slots=True)
class About:
    """The target of an action, and where it may have happened, likeliest first; None is unknown."""

    target: str | None
    places: tuple[str | None, ...]


class Handled:
    """What was in the agent's hand last."""

    def __init__(self) -> None:
        self._name: str | None = None
        self._t = -math.inf
        self._run: tuple[str | None, int] = (None, 0)

    def lately(self, t: float) -> str | None:
        """What it was not long ago, for those who are not sure of every moment."""
        return self._name if t - self._t <= KEPT_UNSURE else None

    def update(self, relations: Relations) -> str | None:
        """What it is at this moment; None when nothing was for a while."""
        holding, (name, steps) = relations.holding, self._run
        self._run = (holding, steps + 1 if holding == name else 1)
        if holding is not None and self._run[1] >= STEPS:
            self._name, self._t = holding, relations.t
        return self._name if relations.t - self._t <= KEPT else None


def about(focus: Focus, handled: str | None, world: WorldState) -> About:
    """What an action of this moment is about.

    With a place that is attended to comes what is in the same place; what lies on something else is likelier than that.

    Args:
        focus: what is attended to.
        handled: what was in the hand last (`Handled`).
        world: where everything is.
    """
    target, things = handled or focus.target, world.objects
    there = [things[name] for name in focus.attended if name in things]
    places = [
        name
        for name, thing in things.items()
        if name != target and any(math.hypot(thing.x - at.x, thing.y - at.y) < TOGETHER for at in there)
    ]
    places.sort(key=lambda name: -(things[name].z or 0.0))
    return About(target, tuple(places))


def about_nearby(
    focus: Focus, handled: str | None, agent: AgentState, world: WorldState
) -> Mapping[tuple[str | None, str | None], float]:
    """What an action is about where noise makes the direction of a look unsure, and where things stand is known better.

    The target is what was in the hand lately, within reach, else what is attended to; the places are the things nearest
    to it. Shares of (target, place) that add up to 1.

    Args:
        focus: what is attended to.
        handled: what was in the hand lately (`Handled.lately`).
        agent: who acts.
        world: where everything is.
    """
    things = world.objects
    spot = None if handled is None else things.get(handled)
    is_near = spot is not None and math.hypot(spot.x - agent.x, spot.y - agent.y) <= REACH
    target = handled if is_near else focus.target
    if target is None or target not in things:
        return {(target, focus.destination): 1.0}
    at = things[target]
    gaps = sorted((math.hypot(o.x - at.x, o.y - at.y), name) for name, o in things.items() if name != target)
    most = min(gaps[0][0] + BESIDE, FARTHEST) if gaps else 0.0
    near = {(target, name): math.exp(-0.5 * (gap / ARM) ** 2) for gap, name in gaps if gap <= most}
    total = math.fsum(near.values())
    return {spot: share / total for spot, share in near.items()} if near else {(target, None): 1.0}


def beside(world: WorldState, about: About) -> list[str]:
    """What is in one place with the likeliest place of an action, and is neither that nor its target."""
    first = about.places[0] if about.places else None
    known = {about.target, *about.places}
    return [] if first is None else [n for n in world.objects if n not in known and are_together(world, first, n)]


def are_together(world: WorldState, thing: str, other: str) -> bool:
    """Whether two things are seen in one place."""
    one, two = world.objects.get(thing), world.objects.get(other)
    return one is not None and two is not None and math.hypot(one.x - two.x, one.y - two.y) < TOGETHER


def is_in_reach(world: WorldState, agent: str, thing: str | None) -> bool:
    """Whether somebody can handle a thing from where they are, as far as both are seen."""
    who, what = world.agents.get(agent), world.objects.get(thing or "")
    return who is None or what is None or math.hypot(what.x - who.x, what.y - who.y) <= REACH
