"""An agent's way: a Kalman filter of constant velocity, and a smoother that looks a little ahead.

The plane's two axes have the same noise, so they share one covariance. A node is a moment at which the estimate is
kept: of a detection, or one that somebody wants to know about.
"""

from __future__ import annotations

from collections import deque
from math import hypot
from typing import NamedTuple

RESTLESS = 0.3  # m²/s³: a walk of .6 m/s begins and ends within a second
START_SPEED = 0.4  # m/s, standard deviation before anything is known


class Motion(NamedTuple):
    """Where and how fast at one moment: metres, m/s, and the covariance of place and speed along one axis."""

    t: float
    x: float
    y: float
    vx: float
    vy: float
    place: float
    both: float
    speed: float

    @property
    def pace(self) -> float:
        """m/s."""
        return hypot(self.vx, self.vy)


def after(motion: Motion, t: float, restless: float = RESTLESS) -> Motion:
    """What is expected at a later moment."""
    dt = t - motion.t
    p, c, v = motion.place, motion.both, motion.speed
    return Motion(
        t,
        motion.x + motion.vx * dt,
        motion.y + motion.vy * dt,
        motion.vx,
        motion.vy,
        p + 2 * dt * c + dt * dt * v + restless * dt**3 / 3,
        c + dt * v + restless * dt * dt / 2,
        v + restless * dt,
    )


def corrected(expected: Motion, x: float, y: float, variance: float) -> Motion:
    """After a detection with that variance (m²)."""
    s = expected.place + variance
    k, kv = expected.place / s, expected.both / s
    dx, dy = x - expected.x, y - expected.y
    return Motion(
        expected.t,
        expected.x + k * dx,
        expected.y + k * dy,
        expected.vx + kv * dx,
        expected.vy + kv * dy,
        (1 - k) * expected.place,
        (1 - k) * expected.both,
        expected.speed - kv * expected.both,
    )


class Gain(NamedTuple):
    """What is expected after a moment, and how much of what the next one turns out to be counts for it, two by two."""

    expected: Motion
    g11: float
    g12: float
    g21: float
    g22: float


def smoothed(filtered: Motion, later: Motion) -> Motion:
    """A filtered moment in the light of the smoothed one that follows (Rauch, Tung and Striebel)."""
    return in_the_light_of(later, filtered, gain(filtered, after(filtered, later.t)))


def gain(filtered: Motion, e: Motion) -> Gain | None:
    """Of a moment, and what was expected of the next; None where both are one."""
    dt = e.t - filtered.t
    if dt <= 0.0:
        return None
    det = e.place * e.speed - e.both * e.both
    # gain = P Fᵀ E⁻¹, all of two by two
    a, b = filtered.place + dt * filtered.both, filtered.both
    c, d = filtered.both + dt * filtered.speed, filtered.speed
    g11, g12 = (a * e.speed - b * e.both) / det, (b * e.place - a * e.both) / det
    return Gain(e, g11, g12, (c * e.speed - d * e.both) / det, (d * e.place - c * e.both) / det)


def in_the_light_of(later: Motion, filtered: Motion, gain: Gain | None) -> Motion:
    """As `smoothed`, with a gain that is known: it does not depend on what is seen later."""
    if gain is None:
        return later
    e, g11, g12, g21, g22 = gain
    dp, db, dv = later.place - e.place, later.both - e.both, later.speed - e.speed
    dx, dy, dvx, dvy = later.x - e.x, later.y - e.y, later.vx - e.vx, later.vy - e.vy
    return Motion(
        filtered.t,
        filtered.x + g11 * dx + g12 * dvx,
        filtered.y + g11 * dy + g12 * dvy,
        filtered.vx + g21 * dx + g22 * dvx,
        filtered.vy + g21 * dy + g22 * dvy,
        filtered.place + g11 * (g11 * dp + g12 * db) + g12 * (g11 * db + g12 * dv),
        filtered.both + g21 * (g11 * dp + g12 * db) + g22 * (g11 * db + g12 * dv),
        filtered.speed + g21 * (g21 * dp + g22 * db) + g22 * (g21 * db + g22 * dv),
    )


class Way:
    """The nodes of one agent, over the last ``kept`` moments."""

    def __init__(self, kept: int = 400) -> None:
        self.nodes: deque[Motion] = deque(maxlen=kept)
        self._gains: deque[Gain | None] = deque(maxlen=kept)  # by node, of the one before it

    @property
    def last(self) -> Motion | None:
        """The filtered estimate of the last node."""
        return self.nodes[-1] if self.nodes else None

    def seen(self, t: float, x: float, y: float, variance: float) -> None:
        """A detection."""
        if not self.nodes:
            self.nodes.append(Motion(t, x, y, 0.0, 0.0, variance, 0.0, START_SPEED**2))
            self._gains.append(None)
        else:
            self.nodes.append(corrected(self._expected(t), x, y, variance))

    def mark(self, t: float) -> None:
        """A moment that will be asked about."""
        if self.nodes:
            self.nodes.append(self._expected(t))

    def _expected(self, t: float) -> Motion:
        """What the next node is expected to be, which is kept with its gain."""
        before = self.nodes[-1]
        expected = after(before, t)
        self._gains.append(gain(before, expected))
        return expected

    def at(self, t: float) -> Motion | None:
        """The smoothed estimate of a moment that was marked, from all that was seen by now."""
        found: Motion | None = None
        known: Gain | None = None
        for node, before in zip(reversed(self.nodes), reversed(self._gains)):
            if node.t < t:
                break
            found = node if found is None else in_the_light_of(found, node, known)
            known = before
        return found if found is not None and found.t == t else None
