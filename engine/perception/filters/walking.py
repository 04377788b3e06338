"""An agent's way: a Kalman filter of constant velocity, and a smoother that looks a little ahead.

The plane's two axes have the same noise, so they share one covariance. A node is a moment at which the estimate is
kept: of a detection, or one that somebody wants to know about.
"""

from __future__ import annotations

from collections import deque
from math import hypot
from typing import NamedTuple, TypeAlias

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


def smoothed(filtered: Motion, later: Motion) -> Motion:
    """A filtered moment in the light of the smoothed one that follows (Rauch, Tung and Striebel)."""
    dt = later.t - filtered.t
    if dt <= 0.0:
        return later
    e = after(filtered, later.t)
    det = e.place * e.speed - e.both * e.both
    # gain = P Fᵀ E⁻¹, all of two by two
    a, b = filtered.place + dt * filtered.both, filtered.both
    c, d = filtered.both + dt * filtered.speed, filtered.speed
    g11, g12 = (a * e.speed - b * e.both) / det, (b * e.place - a * e.both) / det
    g21, g22 = (c * e.speed - d * e.both) / det, (d * e.place - c * e.both) / det
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


Gain: TypeAlias = tuple[float, float, float, float, float, float, float, float, float, float, float]
"""What was expected of a node (its place, its speed and their covariance, as in `Motion`), and how much of what it is
found to be counts for the node before it, two by two (`smoothed`): neither depends on what is seen later."""


class Way:
    """The nodes of one agent, over the last ``kept`` moments.

    Worked out on plain numbers, each gain once: `after`, `corrected` and `smoothed` say the same.
    """

    __slots__ = ("_gains", "nodes")

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
            return
        ex, ey, vx, vy, place, both, speed = self._expected(t)
        s = place + variance
        k, kv = place / s, both / s
        dx, dy = x - ex, y - ey
        still = 1 - k
        self.nodes.append(
            Motion(
                t, ex + k * dx, ey + k * dy, vx + kv * dx, vy + kv * dy, still * place, still * both, speed - kv * both
            )
        )

    def mark(self, t: float) -> None:
        """A moment that will be asked about."""
        if self.nodes:
            self.nodes.append(Motion(t, *self._expected(t)))

    def _expected(self, t: float) -> tuple[float, float, float, float, float, float, float]:
        """What the next node is expected to be, which is kept with its gain."""
        before, x, y, vx, vy, p, c, v = self.nodes[-1]
        dt = t - before
        x, y = x + vx * dt, y + vy * dt
        place = p + 2 * dt * c + dt * dt * v + RESTLESS * dt**3 / 3
        both, speed = c + dt * v + RESTLESS * dt * dt / 2, v + RESTLESS * dt
        if dt <= 0.0:
            self._gains.append(None)
        else:
            det = place * speed - both * both
            a, b = p + dt * c, c + dt * v
            g11, g12 = (a * speed - c * both) / det, (c * place - a * both) / det
            g21, g22 = (b * speed - v * both) / det, (v * place - b * both) / det
            self._gains.append((x, y, vx, vy, place, both, speed, g11, g12, g21, g22))
        return x, y, vx, vy, place, both, speed

    def at(self, t: float) -> Motion | None:
        """The smoothed estimate of a moment that was marked, from all that was seen by now."""
        if not self.nodes or self.nodes[-1].t < t:
            return None
        gain: Gain | None = None
        found, x, y, vx, vy, p, c, v = self.nodes[-1]
        for node, before in zip(reversed(self.nodes), reversed(self._gains)):
            if node[0] < t:
                break
            if gain is not None:
                ex, ey, evx, evy, ep, ec, ev, g11, g12, g21, g22 = gain
                dx, dy, dvx, dvy, dp, dc, dv = x - ex, y - ey, vx - evx, vy - evy, p - ep, c - ec, v - ev
                found, x, y, vx, vy, p, c, v = node
                x, y = x + g11 * dx + g12 * dvx, y + g11 * dy + g12 * dvy
                vx, vy = vx + g21 * dx + g22 * dvx, vy + g21 * dy + g22 * dvy
                one, two = g11 * dp + g12 * dc, g11 * dc + g12 * dv
                p, c = p + g11 * one + g12 * two, c + g21 * one + g22 * two
                v = v + g21 * (g21 * dp + g22 * dc) + g22 * (g21 * dc + g22 * dv)
            gain = before
        return Motion(found, x, y, vx, vy, p, c, v) if found == t else None
