"""One agent whose places are noisy: where they were at a moment, whether they walked, and what they looked at."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.engine.perception.filters.handling import Near
from casper.engine.perception.filters.walking import Motion, Way
from casper.engine.perception.world import AgentState, Doubt

SLOWEST, SURE = 0.12, 0.3  # m/s: below it nobody walks, above it everybody does
CREEP = 0.03  # metres a step by which the place of one who stands is mended
STRIDE = 0.4  # m/s, standard deviation along an axis of how fast walkers go
STEADIER = 0.25  # share of its variance with which a speed is really off, of who stands
SLACK = 1.0  # of the noise, by which what is within a band seems beyond it all along: means settle slowly
AVERAGED = 3  # steps that somebody stands through which are as good as one
LOOKS = 0.3  # seconds around a moment whose headings count
AROUND = 8 * LOOKS  # what is farther away counts for nothing
KEPT = 400  # looks

Look: TypeAlias = tuple[float, float, float]
"""When a heading was sensed, its sine and its cosine."""


@dataclass
class Person:
    """What is kept of one agent: the way, what was sensed of heading by time, and what was told last.

    ``poses`` are what was sensed by time, of the one who looks alone.
    """

    way: Way = field(default_factory=Way)
    looks: deque[Look] = field(default_factory=lambda: deque(maxlen=KEPT))
    poses: deque[tuple[float, AgentState]] = field(default_factory=lambda: deque(maxlen=KEPT))
    told: AgentState | None = None
    stood: int = 0
    middle: tuple[float, float] = (0.0, 0.0)
    last: tuple[Motion, Near] | None = None

    def sense(self, t: float, agent: AgentState, variance: float, looks: bool) -> None:
        """Take in a detection with that variance (m²) of somebody, or (``looks``) of the one who looks."""
        self.way.seen(t, agent.x, agent.y, variance)
        self.looks.append((t, math.sin(agent.heading), math.cos(agent.heading)))
        if looks:
            self.poses.append((t, agent))

    def near(self, name: str) -> Near:
        """Where somebody is, and how fast they go if they do; kept until there is more to know."""
        motion = self.way.nodes[-1]
        if self.last is None or self.last[0] is not motion:
            walks = motion.pace > _walks_from(motion)
            speed = (motion.vx, motion.vy) if walks else (0.0, 0.0)
            self.last = motion, Near(name, motion.x, motion.y, *speed)
        return self.last[1]

    def at(
        self, moment: float, bridge: float, noise: float, weights: dict[float, float], grasp: float, holding: str | None
    ) -> AgentState | None:
        """What is told of a moment that was marked; None for who was not seen around it.

        Args:
            moment, bridge: seconds; for so long one who is not seen is thought to go on.
            noise: metres.
            weights: of the looks of each time, kept for the next person.
            grasp: the evidence that the hand holds something. holding: what.
        """
        motion = self.way.at(moment)
        if motion is None or not self._is_known(moment, bridge):
            self.told, self.stood = None, 0
            return None
        x, y = motion.x, motion.y
        if motion.pace > _walks_from(motion) or (self.stood and self._left(motion)):
            self.stood = 0
        else:
            x, y = self._stands(x, y)
        spread = math.sqrt(motion.place / max(self.stood / AVERAGED, 1.0))
        doubt = Doubt(grasp, _walks(motion), spread, SLACK * noise)
        self.told = AgentState(x, y, self._heading(moment, weights), holding, doubt)
        return self.told

    def as_sensed(self, moment: float, bridge: float, holding: str | None) -> AgentState | None:
        """Where the one who looks was last at a moment."""
        for t, pose in reversed(self.poses):
            if t <= moment:
                here = AgentState(pose.x, pose.y, pose.heading, holding)
                return here if moment - t <= bridge else None
        return None

    def _is_known(self, moment: float, bridge: float) -> bool:
        """Seen not long before, or at both ends of a gap."""
        before, after = -math.inf, math.inf
        for t, _, _ in reversed(self.looks):
            if t <= moment:
                before = t
                break
            after = t
        return moment - before <= bridge or after - before <= 2 * bridge

    def _stands(self, x: float, y: float) -> tuple[float, float]:
        """The mean of where it was since it stands; it is brought there slowly, so that it does not seem to walk."""
        self.stood = n = self.stood + 1
        mx, my = self.middle if n > 1 else (x, y)
        mx, my = mx + (x - mx) / n, my + (y - my) / n
        self.middle = mx, my
        if self.told is None or n == 1:
            return mx, my
        dx, dy = mx - self.told.x, my - self.told.y
        gap = math.hypot(dx, dy)
        share = 1.0 if gap <= CREEP else CREEP / gap
        return self.told.x + dx * share, self.told.y + dy * share

    def _left(self, motion: Motion) -> bool:
        """Whether somebody is no longer where they were thought to stand."""
        gap = math.hypot(motion.x - self.middle[0], motion.y - self.middle[1])
        return gap > max(3 * math.sqrt(motion.place), 0.15)

    def _heading(self, moment: float, weights: dict[float, float]) -> float:
        """The mean of the headings around a moment."""
        s, c, first = 0.0, 0.0, moment - AROUND
        for t, sine, cosine in reversed(self.looks):
            if t < first and (s or c):
                break
            weight = weights.get(t)
            if weight is None:
                weight = weights[t] = math.exp(-abs(t - moment) / LOOKS)
            s, c = s + weight * sine, c + weight * cosine
        return math.atan2(s, c)


def _walks_from(motion: Motion) -> float:
    """m/s above which somebody walks: more than chance would have it."""
    return min(max(2.5 * math.sqrt(motion.speed), SLOWEST), SURE)


def _walks(motion: Motion) -> float:
    """The probability that somebody walks who seems that fast; speeds, and errors of who stands, are normal."""
    still = STEADIER * motion.speed
    moving = still + STRIDE * STRIDE
    odds = still / moving * math.exp(min(0.5 * motion.pace**2 * (1.0 / still - 1.0 / moving), 50.0))
    return odds / (1.0 + odds)
