"""How a world state is shown to a person: the time, then who and what is where."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Protocol

from casper.kb.text.lines import Line, Span, line


class Stands(Protocol):
    """An agent."""

    @property
    def x(self) -> float:
        """Metres."""

    @property
    def y(self) -> float:
        """Metres."""

    @property
    def heading(self) -> float:
        """Radians."""

    @property
    def holding(self) -> str | None:
        """What it has in its hand."""


class Lies(Protocol):
    """An object."""

    @property
    def x(self) -> float:
        """Metres."""

    @property
    def y(self) -> float:
        """Metres."""

    @property
    def z(self) -> float | None:
        """Metres; None where the sensor gives a plane only."""


def world_lines(t: float, agents: Mapping[str, Stands], objects: Mapping[str, Lies]) -> Iterator[Line]:
    """The time (seconds), then a line for everybody and everything: metres, radians."""
    width = max(map(len, (*agents, *objects)), default=0)
    yield line(Span(f"at {t:g} s", "strong"))
    for name, agent in agents.items():
        holds = f", holds {agent.holding}" if agent.holding is not None else ""
        yield line(f"  {name:<{width}}  ({agent.x:.2f}, {agent.y:.2f}), heading {agent.heading:.2f}{holds}")
    for name, thing in objects.items():
        height = "" if thing.z is None else f", {thing.z:.2f}"
        yield line(f"  {name:<{width}}  ({thing.x:.2f}, {thing.y:.2f}{height})")
