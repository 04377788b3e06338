"""Which thing a detection is of, where the sensor's numbers say nothing: the nearest of its kind.

Detectors number what they see (``cup_1``, ``cup_2``), and give a thing another number when they lost it for a moment,
or swap two. With ``setting(tracking, association, nearest)`` a number is not believed: of all things of a kind (the
name without its number) each is taken for what lay nearest, such that as many as can be are something known and the
squared distances are least together. By default (``name``) things are what they are called.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import count
from typing import TypeAlias

from casper.engine.perception.filters.settings import TrackerSettings
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.base import KnowledgeBase

NUMBERED = re.compile(r"(.+?)[_#-]?\d+")
NEAR, FASTEST = 0.5, 1.5  # metres, and m/s since it was seen, that it may be from where it was
MOST = 1_000  # names that are kept

Spot: TypeAlias = tuple[float, float, float]
"""When something was seen last, and where: seconds, x and y in metres."""
Known: TypeAlias = dict[str, dict[str, Spot]]
"""By kind and name where things were."""


@lru_cache(maxsize=4 * MOST)
def kind_of(name: str) -> str:
    """The name without its number."""
    found = NUMBERED.fullmatch(name)
    return name if found is None else found[1]


def associator_of(settings: TrackerSettings, kb: KnowledgeBase) -> Associator | None:
    """What a domain's settings ask for; None where things are what they are called."""
    if not settings.enabled or settings.association == "name":
        return None
    return Associator(lambda name: not kb.unmentioned((name,)))


class Associator:
    """Gives what is seen the names by which it was known; a world state at a time.

    Args:
        is_named: whether a name is one that the domain knows. What is seen for the first time under another gets the
            name of its kind, if the domain knows that and nothing has it yet.
    """

    def __init__(self, is_named: Callable[[str], bool]) -> None:
        self._is_named = is_named
        self.reset()

    def reset(self) -> None:
        """Forget everything that was seen."""
        self._agents: Known = {}
        self._objects: Known = {}
        self._said: dict[str, str] = {}  # what a thing that is held and not in view was called last

    def update(self, world: WorldState) -> WorldState:
        """The same under the names by which things were known."""
        agents = self._named(world.t, world.agents, self._agents)
        objects = self._named(world.t, world.objects, self._objects)
        self._said = {**self._said, **objects} if len(self._said) < MOST else objects
        seen = {}
        for name, agent in world.agents.items():
            held = agent.holding if agent.holding is None else self._said.get(agent.holding, agent.holding)
            seen[agents[name]] = agent if held == agent.holding else replace(agent, holding=held)
        return WorldState(world.t, seen, {objects[name]: thing for name, thing in world.objects.items()})

    def _named(self, t: float, seen: Mapping[str, AgentState | ObjectState], known: Known) -> dict[str, str]:
        """By its name in the state the name by which each was known; they are seen there now."""
        kinds: dict[str, list[str]] = {}
        for name in seen:
            kinds.setdefault(kind_of(name), []).append(name)
        found: dict[str, str] = {}
        for kind, names in kinds.items():
            were = known.setdefault(kind, {}) if kind in known or len(known) < MOST else {}
            costs = {(a, b): cost for a in names for b in were if (cost := _cost(t, seen[a], were[b])) is not None}
            same = matched(costs)
            taken = set(same.values())
            for name in names:
                found[name] = as_known = same.get(name) or self._new(name, kind, taken, were)
                taken.add(as_known)
            for name in names:
                if found[name] in were or len(were) < MOST:
                    were[found[name]] = t, seen[name].x, seen[name].y
        return found

    def _new(self, name: str, kind: str, taken: Collection[str], known: Mapping[str, Spot]) -> str:
        """The name of what is near nothing known: its kind's if nothing has it, its own, or another number."""
        if not (name in known or kind in known or self._is_named(name)) and self._is_named(kind) and kind not in taken:
            return kind
        if name not in taken:
            return name
        return next(fresh for n in count(1) if (fresh := f"{kind}_{n}") not in taken and fresh not in known)


def matched(costs: Mapping[tuple[str, str], float]) -> dict[str, str]:
    """As many pairs as can be, each name and each known one in one of them, of the least cost together.

    Args:
        costs: of a name and a known one that may be the same; others are not.
    """
    nearest: dict[str, str] = {}
    for (name, known), cost in costs.items():
        if name not in nearest or cost < costs[name, nearest[name]]:
            nearest[name] = known
    if len(set(nearest.values())) == len(nearest):  # each has its own: as nearly always
        return nearest
    import networkx as nx  # only where things are in each other's way

    worst, graph = 1.0 + max(costs.values()), nx.Graph()
    for (name, known), cost in costs.items():
        graph.add_edge((0, name), (1, known), weight=worst - cost)
    pairs = (sorted(pair) for pair in nx.max_weight_matching(graph, maxcardinality=True))
    return {name: known for (_, name), (_, known) in pairs}


def _cost(t: float, now: AgentState | ObjectState, before: Spot) -> float | None:
    """The squared distance (m²); None where it is too far for the time that went by."""
    was, x, y = before
    apart = (now.x - x) ** 2 + (now.y - y) ** 2
    return apart if apart <= (NEAR + FASTEST * max(t - was, 0.0)) ** 2 else None
