"""World states in a row: an agent walks about a room, turns, takes things and puts them down; some are not seen."""

from __future__ import annotations

import math
from collections.abc import Sequence

from hypothesis import strategies as st

from casper.engine.domain.domain import Domain
from casper.engine.perception.world import AgentState, ObjectState, WorldState

PERIOD = 0.5  # seconds between two states
STEP = 0.6  # metres, at most


@st.composite
def world_traces(
    draw: st.DrawFn, domain: Domain, *, length: int = 10, gaps: bool = True, hands: bool = True
) -> list[WorldState]:
    """World states of a domain's partner among its objects, time advancing.

    Args:
        draw: hypothesis'.
        domain: its partner is the agent, the things with a place in its scene (``start/4``) are the objects; without a
            scene there are three, ``a``, ``b`` and ``c``.
        length: how many states at most; at least 1.
        gaps: things and the agent may go unseen in some states.
        hands: the agent may take things along.
    """
    names = _objects(domain)
    places = {name: draw(_places()) for name in names}
    x, y, heading, held = 0.0, 0.0, 0.0, None
    states: list[WorldState] = []
    for number in range(draw(st.integers(1, length))):
        x, y = x + draw(_steps()), y + draw(_steps())
        heading = draw(st.sampled_from([heading, 0.0, math.pi / 2, math.pi, -math.pi / 2]))
        if hands:
            held = draw(st.sampled_from([held, None, *names]))
        if held is not None:
            places[held] = (x, y)
        seen = _seen(draw, names) if gaps else list(names)
        agents = {domain.partner: AgentState(x, y, heading, held)} if not gaps or not draw(st.booleans()) else {}
        objects = {name: ObjectState(*places[name]) for name in seen}
        states.append(WorldState(number * PERIOD, agents, objects))
    return states


def _objects(domain: Domain) -> tuple[str, ...]:
    placed = [str(row[0]) for row in domain.kb.rows("start", 4)]
    others = (domain.partner, domain.robot)
    return tuple(name for name in dict.fromkeys(placed) if name not in others) or ("a", "b", "c")


def _places() -> st.SearchStrategy[tuple[float, float]]:
    metres = st.integers(-40, 40).map(lambda tenths: tenths / 10)
    return st.tuples(metres, metres)


def _steps() -> st.SearchStrategy[float]:
    return st.sampled_from([0.0, STEP, -STEP, STEP / 2, -STEP / 2])


def _seen(draw: st.DrawFn, names: Sequence[str]) -> list[str]:
    hidden = draw(st.sets(st.sampled_from(list(names)), max_size=len(names)))
    return [name for name in names if name not in hidden]
