"""What `engine.perception.filters.handling` works out, in plain words: the beliefs as objects, mixed and corrected.

Nothing uses it but the test that both say the same.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from math import exp, pi
from typing import NamedTuple

from casper.engine.perception.filters.handling import (
    ANEW,
    ARM,
    AS_USUAL,
    BACK,
    ELSEWHERE,
    JUMPS,
    KEEPS,
    LEAST,
    LIFT,
    LIFTED,
    LIFTS,
    NEVER,
    PUT,
    QUIET,
    REACHES,
    SETTLES,
    STAYS,
    STEADY,
    SURE_FREE,
    TAKEN,
    WANDERING,
    WANDERS,
)
from casper.engine.perception.world import ObjectState


class Belief(NamedTuple):
    """A place, metres, and the variance of a coordinate."""

    x: float
    y: float
    z: float
    variance: float

    def moved(self, dx: float, dy: float, spread: float) -> Belief:
        """Elsewhere, and less sure."""
        x, y, z, variance = self
        return Belief(x + dx, y + dy, z, variance + spread)

    def density(self, x: float, y: float, z: float, noise: float) -> float:
        """How likely a detection there is."""
        own_x, own_y, own_z, variance = self
        dx, dy, dz, s = x - own_x, y - own_y, z - own_z, variance + noise
        return float(exp(-0.5 * (dx * dx + dy * dy + dz * dz) / s) * (2 * pi * s) ** -1.5)

    def corrected(self, x: float, y: float, z: float, noise: float) -> Belief:
        """After a detection."""
        own_x, own_y, own_z, variance = self
        k = variance / (variance + noise)
        return Belief(own_x + k * (x - own_x), own_y + k * (y - own_y), own_z + k * (z - own_z), (1 - k) * variance)

    def mixed(self, other: Belief, share: float, gone: tuple[float, float] = (0.0, 0.0), wide: float = 0.0) -> Belief:
        """One belief for two, of which the other has that share; then moved, and less sure."""
        x, y, z, variance = self
        other_x, other_y, other_z, other_variance = other
        dx, dy, dz = other_x - x, other_y - y, other_z - z
        spread = share * (1 - share) * (dx * dx + dy * dy + dz * dz) / 3
        variance = (1 - share) * variance + share * other_variance + spread
        return Belief(x + share * dx + gone[0], y + share * dy + gone[1], z + share * dz, variance + wide)


class Moment(NamedTuple):
    """What was known at one moment: likelihoods of both models since the one before, and their shares after it."""

    t: float
    likelihoods: tuple[float, float]
    change: tuple[float, float]
    carried: float
    rest: Belief
    hand: Belief
    by: str | None


class PlainHandling:
    """One thing."""

    def __init__(self, t: float, seen: ObjectState, noise: float, carried: float = 0.02) -> None:
        here = Belief(seen.x, seen.y, seen.z or 0.0, noise)
        self.flat = seen.z is None
        self.rest = self.hand = self.home = here  # home: where it lay for sure
        self.carried = carried
        self.outside = 0
        self.moments: deque[Moment] = deque([Moment(t, (1.0, 1.0), (0.0, 0.0), carried, here, here, None)])

    def expect(self, dt: float, by: str | None, gone: tuple[float, float]) -> tuple[float, float]:
        """Time goes by, somebody within reach has moved; the chances of being taken and put down in it."""
        near = by is not None
        taken, put = 1 - exp(-TAKEN * dt) if near else NEVER, 1 - exp(-PUT * dt)
        rest, hand = 1 - self.carried, self.carried
        now = hand * (1 - put) + rest * taken
        to_hand, to_rest = rest * taken / now, hand * put / (1 - now)
        before = self.rest
        self.rest = before.mixed(self.hand, to_rest, wide=SETTLES * dt)
        self.hand = self.hand.mixed(before, to_hand, gone, STEADY * dt)
        self.carried = now
        return taken, put

    def lies(self, t: float, seen: ObjectState | None, noise: float) -> bool:
        """Take in a moment at which nobody is near and it lies where it lay, if it does; the whole of `update` else."""
        if self.carried > QUIET or self.outside:
            return False
        here = self.rest
        x, y, z, variance = here
        variance += SETTLES * (t - self.moments[-1].t)
        if seen is not None:
            dx, dy, dz = seen.x - x, seen.y - y, (seen.z or 0.0) - z
            s = variance + noise
            if dx * dx + dy * dy + dz * dz > AS_USUAL * s:
                return False
            k = variance / s
            x, y, z, variance = x + k * dx, y + k * dy, z + k * dz, (1 - k) * variance
        here = Belief(x, y, z, variance)
        self.rest = self.hand = self.home = here
        self.moments.append(Moment(t, (1.0, 1.0), (0.0, 0.0), self.carried, here, here, None))
        return True

    def update(
        self,
        t: float,
        change: tuple[float, float],
        by: str | None,
        seen: ObjectState | None,
        noise: float,
        told: tuple[float, float],
        carrier: tuple[float, float] | None = None,
    ) -> bool:
        """A detection, or none; whether the thing jumped.

        Args:
            t: when. change: what `expect` said. by: who is within reach, standing at ``carrier``.
            seen: the detection. noise: its variance (m²).
            told: how likely what is told of the hand is when the thing rests, and when it is carried.
        """
        rest, hand = told
        jumped = False
        if seen is not None:
            x, y, z = seen.x, seen.y, seen.z or 0.0
            at_rest, rest_now = self._at_rest(x, y, z, noise, carrier)
            in_hand, hand_now = self._in_hand(x, y, z, noise, t - self.moments[-1].t, carrier)
            jumped = self._jumps(max(at_rest, in_hand))
            if jumped:
                self.rest = self.hand = Belief(x, y, z, noise)
                self.carried, at_rest, in_hand = 0.5, 1.0, 1.0
            elif self.outside == 0:
                rest, hand = rest * at_rest, hand * in_hand
                self.rest = rest_now
                self.hand = hand_now
        total = (1 - self.carried) * rest + self.carried * hand
        if total > 0.0:
            self.carried = min(max(self.carried * hand / total, LEAST), 1 - LEAST)
        if self.carried < SURE_FREE:
            self.home = self.rest
        self.moments.append(Moment(t, (rest, hand), change, self.carried, self.rest, self.hand, by))
        return jumped

    def _at_rest(
        self, x: float, y: float, z: float, noise: float, carrier: tuple[float, float] | None
    ) -> tuple[float, Belief]:
        """How likely the detection is when it rests, and where it then is: as before, put back, or put down anew."""
        if self.carried < SURE_FREE or carrier is None:
            return self.rest.density(x, y, z, noise), self.rest.corrected(x, y, z, noise)
        anew = Belief(*carrier, self.hand.z, ARM)
        return _likeliest(((STAYS, self.rest), (BACK, self.home), (ANEW, anew)), x, y, z, noise)

    def _in_hand(
        self, x: float, y: float, z: float, noise: float, dt: float, carrier: tuple[float, float] | None
    ) -> tuple[float, Belief]:
        """How likely the detection is when it is carried, and where it then is."""
        ways = [(KEEPS, self.hand), (WANDERING, self.hand.moved(0, 0, WANDERS * dt))]
        if not self.flat:
            ways.append((LIFTS, Belief(self.rest.x, self.rest.y, self.rest.z + LIFTED, self.rest.variance + LIFT)))
        if carrier is not None:
            ways.append((REACHES, Belief(*carrier, self.rest.z, ARM)))
        return _likeliest(ways, x, y, z, noise)

    def _jumps(self, best: float) -> bool:
        self.outside = self.outside + 1 if best <= ELSEWHERE else 0
        if self.outside >= JUMPS:
            self.outside = 0
            return True
        return False

    def at(self, t: float) -> tuple[float, ObjectState, str | None] | None:
        """How likely it was carried at a moment, where it was, and in whose hand, from all that was seen by now.

        None: it was not known yet.
        """
        rest = hand = 1.0  # likelihoods of what came later
        lies = True  # from then on
        ahead: Moment | None = None
        for moment in reversed(self.moments):
            if ahead is not None:
                (at_rest, in_hand), (taken, put) = ahead.likelihoods, ahead.change
                r, h = at_rest * rest, in_hand * hand
                rest, hand = (1 - taken) * r + taken * h, put * r + (1 - put) * h
                top = max(rest, hand)
                rest, hand = (rest / top, hand / top) if top > 0.0 else (1.0, 1.0)
            lies = lies and moment.carried < 0.5
            if moment.t <= t:
                share = moment.carried * hand / (moment.carried * hand + (1 - moment.carried) * rest)
                spot = self.moments[-1].rest if lies else moment.rest if share < 0.5 else moment.hand
                return share, ObjectState(spot.x, spot.y, None if self.flat else spot.z), moment.by
            ahead = moment
        return None


def _likeliest(
    ways: Iterable[tuple[float, Belief]], x: float, y: float, z: float, noise: float
) -> tuple[float, Belief]:
    """The density of a detection over weighed beliefs, and the likeliest of them corrected by it."""
    total, most, likeliest = 0.0, -1.0, None
    for share, way in ways:
        weight = share * way.density(x, y, z, noise)
        total += weight
        if weight > most:
            most, likeliest = weight, way
    assert likeliest is not None
    return total, likeliest.corrected(x, y, z, noise)
