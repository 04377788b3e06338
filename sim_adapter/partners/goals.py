"""Which goals the simulated partners go after: those that were asked for, and others drawn from the seed."""

from __future__ import annotations

import random
from collections.abc import Sequence

from casper.engine.domain.domain import Domain
from casper.engine.settings import require
from casper.kb.errors import DomainError
from casper.sim_adapter.room.scene import Scene
from casper.sim_adapter.script import script_for

APART = 1_000_003  # between the seeds of two partners


def goals_of_partners(
    domain: Domain, scene: Scene, wanted: Sequence[str], in_a_row: int | None, changes_mind: bool, seed: int
) -> dict[str, list[str]]:
    """The goals of everybody who is watched, in order. Those that are asked for are dealt out in turn.

    Nobody goes after what needs a thing that somebody else moves about.

    Args:
        domain, scene: whose goals, and who is there.
        wanted, in_a_row, changes_mind, seed: as for `goals_of_a_day`, of each partner.

    Raises:
        DomainError: as `goals_of_a_day`; or there is no goal left for somebody that is not in another one's way.
    """
    known = _known(domain)
    for goal in wanted:
        require(goal in known, f"there is no goal {goal!r}: choose {', '.join(known)}")
    partners = [name for name in domain.partners if name in scene.people]
    dealt = {name: list(wanted[at :: len(partners)]) for at, name in enumerate(partners)}
    moved = {goal: _moved(domain, scene, goal, seed) for goal in known} if len(partners) > 1 else {}
    chosen: dict[str, list[str]] = {}
    for at, (name, theirs) in enumerate(dealt.items()):
        others = [goal for who, goals in {**dealt, **chosen}.items() if who != name for goal in goals]
        among = [goal for goal in known if all(moved[goal].isdisjoint(moved[other]) for other in others)]
        clash = next((goal for goal in theirs if goal not in among), None)
        if clash is not None or not among:
            raise DomainError(f"{clash or 'no goal'} can be pursued by {name} beside {', '.join(others)}: {_ADVICE}")
        chosen[name] = goals_of_a_day(domain, theirs, in_a_row, changes_mind, seed + APART * at, among)
    return chosen


def _known(domain: Domain) -> list[str]:
    known = list(domain.library.goals)
    require(bool(known), f"the domain {domain.name} has no goals, so nobody can pursue one; write a plans.pl")
    return known


_ADVICE = "two people cannot both move the same things; name goals that need others"


def _moved(domain: Domain, scene: Scene, goal: str, seed: int) -> set[str]:
    """What is moved about for a goal."""
    named = {part for s in script_for(domain, goal, seed) for part in (s.step.target, s.step.destination)}
    return {name for name in named if name in scene.movables}


def goals_of_a_day(
    domain: Domain,
    wanted: Sequence[str],
    in_a_row: int | None,
    changes_mind: bool,
    seed: int,
    among: Sequence[str] | None = None,
) -> list[str]:
    """The goals that the partner goes after: those asked for, the others drawn from the seed.

    Args:
        domain: whose goals.
        wanted: labels of goals, in order; the first few, when more are asked for.
        in_a_row: how many; None: as many as are wanted, at least one, and another one for a change of mind.
        changes_mind: whether the first is given up for the second.
        seed: of those that are drawn.
        among: from which they are drawn; None: from all.

    Raises:
        DomainError: no such goal, none at all, fewer in a row than are wanted, or no other goal to change to.
    """
    known = _known(domain) if among is None else list(among)
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
