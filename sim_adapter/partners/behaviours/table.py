"""All behaviours by name, and how they are asked for: one, several together, or one that is drawn for each seed."""

from __future__ import annotations

import random
from difflib import get_close_matches

from casper.engine.settings import require
from casper.kb.errors import DomainError
from casper.sim_adapter.partners.behaviours.alone import alone
from casper.sim_adapter.partners.behaviours.blocking import blocking
from casper.sim_adapter.partners.behaviours.eager import eager
from casper.sim_adapter.partners.behaviours.fickle import fickle
from casper.sim_adapter.partners.behaviours.forgetful import forgetful
from casper.sim_adapter.partners.behaviours.juggling import juggling
from casper.sim_adapter.partners.behaviours.misplacing import misplacing
from casper.sim_adapter.partners.behaviours.pausing import pausing
from casper.sim_adapter.partners.behaviours.visited import visited
from casper.sim_adapter.partners.behaviours.wandering import wandering
from casper.sim_adapter.partners.conduct import Behaviour, Conduct, Surroundings

PLAIN, MIXED = "plain", "mixed"
BEHAVIOURS: dict[str, Behaviour] = {
    "juggling": juggling,  # these two say which goals there are, so they come first
    "fickle": fickle,
    "forgetful": forgetful,
    "misplacing": misplacing,
    "wandering": wandering,
    "pausing": pausing,
    "blocking": blocking,
    "eager": eager,
    "alone": alone,
    "visited": visited,
}
NAMES = (PLAIN, *sorted(BEHAVIOURS), MIXED)
CHANGES_GOALS = ("fickle", "juggling")


def check_behaviours(wanted: str) -> tuple[str, ...]:
    """The names in a setting, in the order in which they change a conduct; ``plain`` is none.

    Args:
        wanted: ``plain``, ``mixed``, a behaviour, or several with commas.

    Raises:
        DomainError: there is no such behaviour, or two of them do not go together.
    """
    names = [name.strip() for name in wanted.split(",")]
    for name in names:
        if name not in NAMES:
            close = get_close_matches(name, NAMES, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            raise DomainError(f"there is no partner {name!r}: choose {', '.join(NAMES)}{hint}")
    require(len(names) == 1 or not {PLAIN, MIXED} & set(names), f"{PLAIN} and {MIXED} stand alone, not in {wanted!r}")
    both = " and ".join(CHANGES_GOALS)
    require(not set(CHANGES_GOALS) <= set(names), f"{both} do not go together: each says which goals there are")
    return (MIXED,) if names == [MIXED] else tuple(name for name in BEHAVIOURS if name in names)


def behaving(conduct: Conduct, wanted: str, surroundings: Surroundings) -> tuple[Conduct, tuple[str, ...]]:
    """The conduct of somebody who behaves as a setting says, and the names of the ways; the same seed gives the same.

    ``mixed`` is plain or one of the behaviours, drawn from the seed among those that the goals and the room allow.

    Raises:
        DomainError: as `check_behaviours`; or the goals, or the room, leave no way to behave so.
    """
    names = check_behaviours(wanted)
    if names == (MIXED,):
        return _mixed(conduct, surroundings)
    for name in names:
        conduct = BEHAVIOURS[name](conduct, surroundings, random.Random(f"{name} {surroundings.seed}"))
    return conduct, names


def _mixed(conduct: Conduct, surroundings: Surroundings) -> tuple[Conduct, tuple[str, ...]]:
    names = [PLAIN, *BEHAVIOURS]
    random.Random(f"{MIXED} {surroundings.seed}").shuffle(names)
    for name in names:
        try:
            return behaving(conduct, name, surroundings)
        except DomainError:
            continue  # nobody can behave so here
    return conduct, ()
