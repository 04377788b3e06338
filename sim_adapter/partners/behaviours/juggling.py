"""Pursues two goals at once: the steps of both in turn, each goal's own in their order."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

from casper.kb.errors import DomainError
from casper.sim_adapter.partners.conduct import Conduct, Stretch, Surroundings

MOST_TRIED = 1000  # ways to mix two scripts


def juggling(conduct: Conduct, surroundings: Surroundings, draw: random.Random) -> Conduct:
    """The second goal is begun before the first is reached, and the first is gone on with after that.

    The two move different things; where only one was asked for the second is drawn.
    """
    first = conduct.stretches[0]
    second = surroundings.another(first, conduct, draw, apart=True)
    own = surroundings.own(first), surroundings.own(second)
    both = _mixed(first, second, own, draw)
    told = f"pursues {both.goals[0]} and {both.goals[1]} at once"
    return replace(conduct, stretches=(both, *conduct.stretches[2:]), told=(*conduct.told, told))


def _mixed(first: Stretch, second: Stretch, own: tuple[int, int], draw: random.Random) -> Stretch:
    for _ in range(MOST_TRIED if min(own) > 0 and max(own) > 1 else 0):
        turns = [0] * len(first.script) + [1] * len(second.script)
        draw.shuffle(turns)
        whose = _own_turns(turns, own)
        if len(whose) > 2 and sum(a != b for a, b in pairwise(whose)) > 1:
            scripts = iter(first.script), iter(second.script)
            goals = first.goals + second.goals if turns[0] == 0 else second.goals + first.goals
            return Stretch(goals, tuple(next(scripts[turn]) for turn in turns))
    raise DomainError(f"{first.goals[0]} and {second.goals[0]} are too short to be pursued at once")


def _own_turns(turns: list[int], own: tuple[int, int]) -> list[int]:
    """The turns at which they do a step that they do in any case."""
    seen, found = [0, 0], []
    for turn in turns:
        seen[turn] += 1
        if seen[turn] <= own[turn]:
            found.append(turn)
    return found
