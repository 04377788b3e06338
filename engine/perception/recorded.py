"""Whole recordings at once: relations and focus of one agent on arrays, as `Perception` and `FocusEstimator` tell them.

In: a `casper.qsr.Trace`. Out: codes and scores, things by steps. Relations are worked out by `casper.qsr`, scores by
the same elementary operations in the same order as a step at a time, votes by the votes themselves (`ballots`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from casper.engine.perception.ballots import Counted, Elections
from casper.engine.perception.focus import DEGREES, RADIANS, FocusSettings, weigh, windows
from casper.engine.perception.perception import PerceptionSettings, calculi
from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Frames, Scene
from casper.qsr.batch import CELLS, chunks
from casper.qsr.traces.trace import Trace

Array = NDArray[Any]
_SYMBOLS = ("-", "0", "+", None)


@dataclass(frozen=True, eq=False)
class Recorded:
    """What was seen and attended to in a recording; the agent itself is none of the objects.

    t: (T,) seconds. objects: N names. seen: (T,) whether the agent was there. moving: (T,) 1, 0, or -1 at a first step.
    qdc: (N, T) the number of the band, -1 for what is absent. qtc: (N, T) 0 for ``-``, 1 for ``0``, 2 for ``+``, -1
    without a step before. scores: (N, T) shares that add up to 1, or all 0. target, destination: (T,) the row of an
    object, -1 for none. attended: (N, T) whether it is attended to as a destination (`Focus.attended`).
    """

    t: Array
    objects: tuple[str, ...]
    seen: Array
    moving: Array
    qdc: Array
    qtc: Array
    scores: Array
    target: Array
    destination: Array
    attended: Array


def recorded(trace: Trace, agent: str, perception: PerceptionSettings, focus: FocusSettings) -> Recorded:
    """The relations and the focus of an agent, who has a heading, at all steps of a trace.

    Raises:
        TraceError: the agent is not in the trace, or has no heading.
    """
    me = trace.index(agent)
    require_heading(trace, me)
    rows = [i for i in range(len(trace.names)) if i != me]
    work = _Work(trace, me, np.array(rows, dtype=np.intp), perception, focus)
    if rows:
        for start, frames in chunks(trace, max(1, CELLS // len(rows))):
            work.chunk(start, frames)
    return work.result


def require_heading(trace: Trace, me: int) -> None:
    """Refuse an agent of whom it is not known where it looks."""
    heading = None if trace.heading is None else trace.heading[me]
    there = np.ones(len(trace), dtype=bool) if trace.present is None else trace.present[me]
    if heading is None or np.isnan(heading[there]).any():
        at = "" if heading is None else f" at t={trace.t[np.flatnonzero(there & np.isnan(heading))[0]]:g}"
        raise TraceError(f"{trace.names[me]} has no heading{at}, which the focus needs")


class _Work:
    """One recording, chunk after chunk; each goes through everything while it is in the processor's cache."""

    def __init__(
        self, trace: Trace, me: int, rows: Array, perception: PerceptionSettings, focus: FocusSettings
    ) -> None:
        self.me, self.rows, self.perception, self.focus = me, rows, perception, focus
        self.calculi = calculi(perception)
        objects, steps = tuple(trace.names[i] for i in rows), len(trace)
        self.of = (np.full(len(rows), me, dtype=np.intp), rows)
        self.elections = Elections(objects, windows(focus), focus.destination_minimum, focus.tie_tolerance)
        bands = [label for label, _ in perception.bands]
        self.weights = np.array([weigh(focus, label, symbol) for label in bands for symbol in _SYMBOLS])
        shape = (len(rows), steps)
        self.result = Recorded(
            trace.t,
            objects,
            np.ones(steps, dtype=bool) if trace.present is None else trace.present[me],
            np.full(steps, -1, dtype=np.int8),
            np.full(shape, -1, dtype=np.int8),
            np.full(shape, -1, dtype=np.int8),
            np.zeros(shape),
            np.full(steps, -1, dtype=np.int32),
            np.full(steps, -1, dtype=np.int32),
            np.zeros(shape, dtype=bool),
        )

    def chunk(self, start: int, frames: Frames) -> None:
        """Fill in the steps of one chunk."""
        into, now = self.result, slice(start, start + len(frames.dt))
        held = None if frames.held is None else frames.held[self.me]
        if held is not None and self.perception.snap_held and (held >= 0).any():
            frames = _snapped(frames, self.me, held)
        scene, lone = Scene(frames, self.of), Scene(frames, (self.of[0][:1],))
        qdc, qtc, mos = self.calculi
        earlier = start - 1
        nothing = np.full(len(self.rows), -1, dtype=np.int8)
        with np.errstate(invalid="ignore"):
            before = nothing if start == 0 else into.qdc[:, earlier]
            bands = into.qdc[:, now] = scene.told(qdc.codes(scene, before), False)
            symbols = scene.told(qtc.codes(scene, nothing if start == 0 else into.qtc[:, earlier]), True)
            mine = nothing[:1] if start == 0 else into.moving[earlier : earlier + 1]
            into.moving[now] = lone.told(mos.codes(lone, mine), True)[0]
            angles = self._angles(scene, frames)
        if held is not None:
            symbols = self._in_hand(symbols, angles, held[1:])
        into.qtc[:, now] = symbols
        scores = into.scores[:, now] = self._scores(bands, symbols, angles)
        told = None if scene.present is None else scene.present[:, 1:]
        self._vote(now, scores, told, into.seen[now])

    def _in_hand(self, symbols: Array, angles: Array, held: Array) -> Array:
        """What is held is straight ahead and, snapped to the hand, neither approached nor left."""
        mine = self.rows[:, None] == held[None, :]
        angles[mine] = 0.0
        return np.where(mine & (symbols >= 0), 1, symbols).astype(np.int8) if self.perception.snap_held else symbols

    def _angles(self, scene: Scene, frames: Frames) -> Array:
        """Degrees, rounded as the settings say."""
        assert frames.heading is not None
        heading = frames.heading[self.me, 1:]
        dx, dy = (offset[:, 1:] for offset in scene.offsets[:2])
        step = self.focus.angle_resolution
        if step == 0.0:
            return _exactly(dx, dy, heading)
        degrees = _nearly(dx, dy, heading)
        quotient = degrees / step
        whole = np.rint(quotient)
        doubtful = np.abs(np.abs(quotient - whole) - 0.5) < 1e-6
        if doubtful.any():
            things, steps = np.nonzero(doubtful)
            exact = _exactly(dx[things, steps], dy[things, steps], heading[steps])
            whole[things, steps] = np.rint(exact / step)
        return np.asarray(whole * step)

    def _scores(self, bands: Array, symbols: Array, angles: Array) -> Array:
        """Equation focus, normalised; 0 for what is absent."""
        unit = 1.0 if self.focus.angle_unit == "degrees" else RADIANS
        index = bands * np.int16(4) + (symbols & 3)  # -1, no symbol, is the fourth
        missing = bands < 0
        some = missing.any()
        raw = self.weights.take(np.where(missing, 0, index) if some else index) / (1.0 + angles * unit)
        if some:
            raw[missing] = 0.0
        total = np.add.reduce(raw, axis=0)
        return np.asarray(raw / np.where(total > 0.0, total, 1.0))

    def _vote(self, now: slice, scores: Array, told: Array | None, seen: Array) -> None:
        if told is not None:
            scores = np.where(told, scores, -np.inf)
        settings = self.focus
        counted = Counted.of(scores, settings.threshold, settings.destination_minimum, settings.tie_tolerance)
        into = self.result
        into.target[now], into.destination[now], into.attended[:, now] = self.elections.hold(counted, scores, seen)


def _snapped(frames: Frames, me: int, held: Array) -> Frames:
    """What is in the agent's hand is where the agent is, seen or not."""
    steps = np.flatnonzero((held >= 0) if frames.present is None else (held >= 0) & frames.present[me])
    where = tuple(rows.copy() for rows in frames.where)
    for rows in where:
        rows[held[steps], steps] = rows[me, steps]
    present = frames.present
    if present is not None:
        present = present.copy()
        present[held[steps], steps] = True
    return replace(frames, where=where, present=present)


def _nearly(dx: Array, dy: Array, heading: Array) -> Array:
    """Degrees between headings and displacements by numpy, whose last digit may be another than Python's."""
    turn = np.abs(np.arctan2(dy, dx) - heading)
    if not (turn < math.tau).all():
        turn = np.fmod(turn, math.tau)
    degrees = np.where(turn > math.pi, math.tau - turn, turn)
    degrees *= DEGREES
    here = (dx == 0.0) & (dy == 0.0)
    if here.any():
        degrees[here] = 0.0
    return np.asarray(degrees)


@np.vectorize
def _angle(dx: float, dy: float, heading: float) -> float:
    if dx != dx or heading != heading or (dx == 0.0 and dy == 0.0):
        return 0.0
    return abs(math.remainder(math.atan2(dy, dx) - heading, math.tau)) * DEGREES


def _exactly(dx: Array, dy: Array, heading: Array) -> Array:
    """The same to the last digit."""
    return np.asarray(_angle(dx, dy, heading), dtype=np.float64) if dx.size else np.zeros(dx.shape)
