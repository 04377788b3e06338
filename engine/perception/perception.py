"""World states in, qualitative relations of one agent out: a step at a time (paper, section Perception)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from operator import itemgetter

from casper.engine.perception import qsr
from casper.engine.perception.world import AgentState, WorldState
from casper.engine.settings import Rows, number, read_settings, require
from casper.kb.errors import WorldStateError

BANDS = (("touch", 0.6), ("near", 2.0), ("medium", 3.0), ("far", 5.0), ("ignore", math.inf))
_VARIANTS = {"projection": qsr.approach_by_projection, "distance": qsr.approach_by_distance}


@dataclass(frozen=True, slots=True)
class PerceptionSettings:
    """What the relations are measured with.

    bands: QDC labels with their upper ends in metres, in order. moving_speed, qtc_speed: m/s at or below
    which the agent stands still, or does so with respect to an object. qtc: ``projection`` (QSRlib's) or
    ``distance`` (the textbook's). snap_held: a held object is where its holder is. The margins are
    hysteresis: metres for QDC, m/s for the others; 0 is none.
    """

    bands: tuple[tuple[str, float], ...] = BANDS
    moving_speed: float = 0.09
    qtc_speed: float = 0.09
    qtc: str = "projection"
    snap_held: bool = True
    qdc_margin: float = 0.0
    moving_margin: float = 0.0
    qtc_margin: float = 0.0

    def __post_init__(self) -> None:
        ends = [end for _, end in self.bands]
        require(bool(ends) and ends == sorted(set(ends)), "QDC bands need ends that grow from band to band")
        require(len({label for label, _ in self.bands}) == len(ends), "a QDC band is named twice")
        require(self.qtc in _VARIANTS, f"qtc is projection or distance, not {self.qtc}")
        for name in ("moving_speed", "qtc_speed", "qdc_margin", "moving_margin", "qtc_margin"):
            require(getattr(self, name) >= 0.0, f"{name} of the perception must not be negative")


def perception_settings(rows: Rows) -> PerceptionSettings:
    """Settings from facts ``setting(perception, Name, Value)`` and ``band(Label, Metres)``.

    The end ``infinite`` is allowed; without one, a band ``ignore`` is added behind the last.

    Raises:
        DomainError: an unknown setting, a value of the wrong kind, two bands with one end.
    """
    bands = tuple(
        sorted(
            ((label, number(end, f"band({label}, {end})")) for label, end in rows("band", 2)),
            key=itemgetter(1),
        )
    )
    if bands and bands[-1][1] != math.inf:
        bands += (("ignore", math.inf),)
    return read_settings(PerceptionSettings, rows, "perception", bands=bands or BANDS)


@dataclass(frozen=True, slots=True)
class Relations:
    """The qualitative relations of one agent at one moment; every mapping is by object.

    moving: MOS, None at the first step. holding: HOLD. qdc: a band's label. qtc: ``-`` towards, ``0``,
    ``+`` away, None while the pair has no earlier step. angle: radians from 0 to pi between the heading and
    the line to the object, 0 for a held one.
    """

    t: float
    agent: str
    moving: bool | None
    holding: str | None
    qdc: Mapping[str, str]
    qtc: Mapping[str, str | None]
    angle: Mapping[str, float]


@dataclass(slots=True)
class _Step:
    """What the next step needs of this one."""

    t: float
    place: qsr.Point
    places: dict[str, qsr.Point]
    moving: bool | None = None
    qdc: dict[str, str] = field(default_factory=dict)
    qtc: dict[str, str | None] = field(default_factory=dict)


class Perception:
    """Relations of one agent, from world states in the order of time."""

    def __init__(self, settings: PerceptionSettings, agent: str) -> None:
        self.settings = settings
        self.agent = agent
        self._approach = _VARIANTS[settings.qtc]
        self.reset()

    def reset(self) -> None:
        """Forget every earlier step."""
        self._before: _Step | None = None
        self._t: float | None = None

    def update(self, world: WorldState) -> Relations | None:
        """The relations at this moment, or None when the agent is absent.

        After an absence the next step is a first step again: MOS and QTC are not taken across the gap
        (bridging one is the tracker's work). Distances are in the plane, since an agent has no height.

        Raises:
            WorldStateError: time that does not advance, or a coordinate that is not finite.
        """
        check_world(self._t, world)
        self._t = world.t
        agent = world.agents.get(self.agent)
        if agent is None:
            self._before = None
            return None
        step = _Step(world.t, (agent.x, agent.y), self._places(world, agent))
        step.moving = self._moving(step)
        angle = self._towards_objects(step, agent)
        self._before = step
        return Relations(world.t, self.agent, step.moving, agent.holding, step.qdc, step.qtc, angle)

    def _places(self, world: WorldState, agent: AgentState) -> dict[str, qsr.Point]:
        places = {name: (thing.x, thing.y) for name, thing in world.objects.items()}
        if self.settings.snap_held and agent.holding is not None:
            places[agent.holding] = (agent.x, agent.y)
        return places

    def _moving(self, step: _Step) -> bool | None:
        before, settings = self._before, self.settings
        if before is None:
            return None
        dt = step.t - before.t
        displacement = math.hypot(step.place[0] - before.place[0], step.place[1] - before.place[1])
        return qsr.moving(displacement, settings.moving_speed * dt, before.moving, settings.moving_margin * dt)

    def _towards_objects(self, step: _Step, agent: AgentState) -> dict[str, float]:
        """Fill QDC and QTC of the step; return the angles."""
        x, y, heading, held = agent.x, agent.y, agent.heading, agent.holding
        before, bands, margin = self._before, self.settings.bands, self.settings.qdc_margin
        labels = {} if before is None else before.qdc
        angle = {}
        for name, place in step.places.items():
            dx, dy = place[0] - x, place[1] - y
            step.qdc[name] = qsr.qdc(math.hypot(dx, dy), bands, labels.get(name), margin)
            step.qtc[name] = None if before is None else self._qtc(name, step, before, name == held)
            aligned = name == held or (dx == 0.0 and dy == 0.0)
            angle[name] = 0.0 if aligned else abs(math.remainder(math.atan2(dy, dx) - heading, math.tau))
        return angle

    def _qtc(self, name: str, step: _Step, before: _Step, held: bool) -> str | None:
        towards = before.places.get(name)
        if towards is None:
            return None
        if held and self.settings.snap_held:
            return "0"  # also at the step of the grasp, when it was still lying somewhere else
        dt, settings = step.t - before.t, self.settings
        approach = self._approach(before.place, step.place, towards)
        return qsr.qtc(approach, settings.qtc_speed * dt, before.qtc.get(name), settings.qtc_margin * dt)


def check_world(before: float | None, world: WorldState) -> None:
    """A world state can follow one at time ``before``, and all of its numbers are finite.

    It is checked as a whole and first, so that one that is refused leaves no trace.

    Raises:
        WorldStateError: time that is not finite or does not advance (the sentence names both times), or a
            coordinate that is not finite (it names the object or agent, and the time).
    """
    isfinite, t = math.isfinite, world.t
    if not isfinite(t):
        raise WorldStateError(f"the time of a world state must be finite, not {t}")
    if before is not None and t <= before:
        raise WorldStateError(f"time must advance from one world state to the next: t={t:g} came after t={before:g}")
    for name, agent in world.agents.items():
        if not (isfinite(agent.x) and isfinite(agent.y) and isfinite(agent.heading)):
            raise WorldStateError(f"agent {name} has a coordinate that is not finite at t={t:g}")
    for name, thing in world.objects.items():
        if not (isfinite(thing.x) and isfinite(thing.y) and (thing.z is None or isfinite(thing.z))):
            raise WorldStateError(f"{name} has a coordinate that is not finite at t={t:g}")
