"""World states in, qualitative relations of one agent out: a step at a time (paper, section Perception)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from operator import itemgetter

from casper.engine.events.records import setters
from casper.engine.perception.world import Doubt, WorldState
from casper.engine.settings import Rows, number, read_settings, require
from casper.kb.errors import WorldStateError
from casper.qsr.calculi.distances import Qdc
from casper.qsr.calculi.motion import VARIANTS, Mos, QtcB11
from casper.qsr.plain.points import BANDS, LARGEST
from casper.qsr.thresholds import Speed
from casper.qsr.watching import Watcher


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
        require(self.qtc in VARIANTS, f"qtc is projection or distance, not {self.qtc}")
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


@dataclass(frozen=True, slots=True, init=False)
class Relations:
    """The qualitative relations of one agent at one moment; every mapping is by object.

    moving: MOS, None at the first step. holding: HOLD. qdc: a band's label. qtc: ``-`` towards, ``0``,
    ``+`` away, None while the pair has no earlier step. angle: radians from 0 to pi between the heading and
    the line to the object, 0 for a held one. doubt: as in `AgentState`; then ``gaps`` are the distances in metres, too.
    """

    t: float
    agent: str
    moving: bool | None
    holding: str | None
    qdc: Mapping[str, str]
    qtc: Mapping[str, str | None]
    angle: Mapping[str, float]
    doubt: Doubt | None = None
    gaps: Mapping[str, float] | None = None

    def __init__(
        self,
        t: float,
        agent: str,
        moving: bool | None,
        holding: str | None,
        qdc: Mapping[str, str],
        qtc: Mapping[str, str | None],
        angle: Mapping[str, float],
        doubt: Doubt | None = None,
        gaps: Mapping[str, float] | None = None,
    ) -> None:
        _t(self, t)
        _agent(self, agent)
        _moving(self, moving)
        _holding(self, holding)
        _qdc(self, qdc)
        _qtc(self, qtc)
        _angle(self, angle)
        _doubt(self, doubt)
        _gaps(self, gaps)


_t, _agent, _moving, _holding, _qdc, _qtc, _angle, _doubt, _gaps = setters(Relations)


def calculi(settings: PerceptionSettings) -> tuple[Qdc, QtcB11, Mos]:
    """What is measured, by `casper.qsr`: in the plane, since an agent has no height."""
    return (
        Qdc(settings.bands, settings.qdc_margin, heights=False),
        QtcB11(Speed(settings.qtc_speed), settings.qtc, Speed(settings.qtc_margin)),
        Mos(Speed(settings.moving_speed), Speed(settings.moving_margin)),
    )


class Perception:
    """Relations of one agent, from world states in the order of time."""

    def __init__(self, settings: PerceptionSettings, agent: str) -> None:
        self.settings = settings
        self.agent = agent
        self._watcher = Watcher(*calculi(settings))
        self._t: float | None = None

    def reset(self) -> None:
        """Forget every earlier step."""
        self._watcher.reset()
        self._t = None

    def update(self, world: WorldState, tracked: bool = False) -> Relations | None:
        """The relations at this moment, or None when the agent is absent.

        What a tracker (``tracked``) has been through has things where they can be; agents are looked at all the same.

        After an absence the next step is a first step again: MOS and QTC are not taken across the gap
        (bridging one is the tracker's work). Distances are in the plane, since an agent has no height.

        Raises:
            WorldStateError: time that does not advance, or a coordinate that is not finite.
        """
        check_time(self._t, world.t)
        check_agents(world)
        if not tracked:
            check_things(world)
        dt, self._t = world.t - (self._t or 0.0), world.t
        agent = world.agents.get(self.agent)
        if agent is None:
            self._watcher.reset()
            return None
        held, snaps = agent.holding, self.settings.snap_held
        places = {name: (thing.x, thing.y) for name, thing in world.objects.items()}
        if snaps and held is not None:
            places[held] = (agent.x, agent.y)
        lay = held is not None and self._watcher.seen_before(held)
        moving, qdc, qtc, angle = self._watcher.update(dt, (agent.x, agent.y), agent.heading, places)
        if held is not None and held in angle:
            angle[held] = 0.0
            if snaps and lay:
                qtc[held] = "0"  # also at the step of the grasp, when it was still lying somewhere else
        if agent.doubt is None:
            return Relations(world.t, self.agent, moving, held, qdc, qtc, angle)
        gaps = {name: math.hypot(x - agent.x, y - agent.y) for name, (x, y) in places.items()}
        return Relations(world.t, self.agent, moving, held, qdc, qtc, angle, agent.doubt, gaps)


def check_world(before: float | None, world: WorldState) -> None:
    """A world state can follow one at time ``before``, and all of its numbers are finite.

    It is checked as a whole and first, so that one that is refused leaves no trace.

    Raises:
        WorldStateError: time that is not finite or does not advance (the sentence names both times), or a
            coordinate that is not finite (it names the object or agent, and the time).
    """
    check_time(before, world.t)
    check_agents(world)
    check_things(world)


def check_time(before: float | None, t: float) -> None:
    """The first part of `check_world`."""
    if not math.isfinite(t):
        raise WorldStateError(f"the time of a world state must be finite, not {t}")
    if before is not None and t <= before:
        raise WorldStateError(f"time must advance from one world state to the next: t={t:g} came after t={before:g}")


def check_agents(world: WorldState) -> None:
    """The second part of `check_world`."""
    large = LARGEST
    for name, agent in world.agents.items():
        if not (-large < agent.x < large and -large < agent.y < large and -large < agent.heading < large):
            raise WorldStateError(f"agent {name} has {_unusable(agent.x, agent.y, agent.heading)} at t={world.t:g}")


def check_things(world: WorldState) -> None:
    """The third part of `check_world`."""
    large = LARGEST
    for name, thing in world.objects.items():
        z = thing.z
        if not (-large < thing.x < large and -large < thing.y < large and (z is None or -large < z < large)):
            raise WorldStateError(f"{name} has {_unusable(thing.x, thing.y, z or 0.0)} at t={world.t:g}")


def _unusable(*numbers: float) -> str:
    """NaN and infinities, and what is so large that its square is none."""
    finite = all(map(math.isfinite, numbers))
    return f"a coordinate {f'beyond {LARGEST:g} m' if finite else 'that is not finite'}"
