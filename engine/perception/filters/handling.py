"""A thing that rests or is in somebody's hand: two Kalman filters, and how likely each of them is.

The one of rest stays where it is; that of being carried goes along with the carrier and wanders. They are mixed at each
step (interacting multiple models, Blom and Bar-Shalom 1988), and what follows within the lag is looked at, too.

It runs for each thing in each world state, so beliefs are plain tuples; `engine.perception.filters.specification` says
the same in plainer words.
"""

from __future__ import annotations

from collections import deque
from math import exp, pi
from typing import NamedTuple, TypeAlias

from casper.engine.perception.world import ObjectState

WANDERS = 0.03  # m²/s: a hand lifts and lowers what it holds
STEADY = 0.0004  # m²/s: or keeps it where it is, before the body
ARM = 0.16  # m²: or has it anywhere within an arm's reach
LIFTED, LIFT = 0.12, 0.005  # metres above where it lay, and m²: what is handled on the spot
KEEPS, WANDERING, LIFTS, REACHES = 0.3, 0.15, 0.5, 0.05  # how often each
SETTLES = 1e-6  # m²/s: a thing at rest
TAKEN, PUT = 0.1, 0.4  # a second, within reach
NEVER = 1e-5  # out of everybody's reach
STAYS, BACK, ANEW = 0.85, 0.1, 0.05  # how often what may have been in a hand lies as before, is put back, or elsewhere
SURE_FREE = 0.1  # share of being carried below which a thing lies where it seems to
LEAST = 1e-4  # share that a model keeps
QUIET = 5 * LEAST  # share of being carried below which nobody near means that a thing lies
AS_USUAL = 9.0  # squared deviations from where it lies within which a detection is no news
ELSEWHERE = 1e-7  # density (m⁻³) at or below which neither model expects a detection
JUMPS = 3  # detections in a row where nobody could have brought it
TWO_PI = 2 * pi

Belief: TypeAlias = tuple[float, float, float, float]
"""A place, x, y and z in metres, and the variance of a coordinate (m²)."""
Moment: TypeAlias = tuple[float, float, float, float, float, float, Belief, Belief, str | None]
"""What was known at one moment: the time, how likely what was seen since the one before is at rest and in a hand, the
chances of having been taken and put down since, the share of being carried, both beliefs, and who was near."""


class Near(NamedTuple):
    """Who is near: where they are (metres), and how fast they go (m/s along both axes, 0 for one who stands)."""

    name: str
    x: float
    y: float
    vx: float
    vy: float


class Handling:
    """One thing."""

    __slots__ = ("carried", "flat", "hand", "home", "moments", "news", "outside", "rest")

    def __init__(self, t: float, seen: ObjectState, noise: float, carried: float = 0.02, kept: int = 400) -> None:
        here = (seen.x, seen.y, seen.z or 0.0, noise)
        self.flat = seen.z is None
        self.rest: Belief = here
        self.hand: Belief = here
        self.home: Belief = here  # where it lay for sure
        self.carried = carried
        self.outside = 0
        self.news = t  # since then nothing was learned but that it lies
        self.moments: deque[Moment] = deque([(t, 1.0, 1.0, 0.0, 0.0, carried, here, here, None)], maxlen=kept)

    def lies(self, t: float, seen: ObjectState | None, noise: float) -> bool:
        """Take in a moment at which nobody is near and it lies where it lay, if it does; the whole of `update` else.

        Which of both models holds is no question then, so one of them is enough: most things, most of the time.
        """
        if self.carried > QUIET or self.outside:
            return False
        x, y, z, variance = self.rest
        variance += SETTLES * (t - self.moments[-1][0])
        if seen is not None:
            dx, dy, dz = seen.x - x, seen.y - y, (seen.z or 0.0) - z
            s = variance + noise
            if dx * dx + dy * dy + dz * dz > AS_USUAL * s:
                return False
            k = variance / s
            x, y, z, variance = x + k * dx, y + k * dy, z + k * dz, (1 - k) * variance
        self.rest = self.hand = self.home = here = (x, y, z, variance)
        self.moments.append((t, 1.0, 1.0, 0.0, 0.0, self.carried, here, here, None))
        return True

    def update(
        self, t: float, near: Near | None, seen: ObjectState | None, noise: float, told: tuple[float, float]
    ) -> bool:
        """Time goes by until a detection, or none; whether the thing jumped.

        Args:
            t: when. near: who is within reach.
            seen: the detection. noise: its variance (m²).
            told: how likely what is told of the hand is when the thing rests, and when it is carried.
        """
        dt = t - self.moments[-1][0]
        taken, put = self._expect(dt, near)
        rest, hand = told
        jumped = False
        if seen is not None:
            x, y, z = seen.x, seen.y, seen.z or 0.0
            at_rest, rest_now = self._at_rest(x, y, z, noise, near)
            in_hand, hand_now = self._in_hand(x, y, z, noise, dt, near)
            if at_rest > ELSEWHERE or in_hand > ELSEWHERE:
                self.outside = 0
            else:
                self.outside += 1
            jumped = self.outside >= JUMPS
            if jumped:
                self.outside = 0
                self.rest = self.hand = (x, y, z, noise)
                self.carried = 0.5
            elif self.outside == 0:
                rest, hand = rest * at_rest, hand * in_hand
                self.rest, self.hand = rest_now, hand_now
        carried = self.carried
        total = (1 - carried) * rest + carried * hand
        if total > 0.0:
            self.carried = carried = min(max(carried * hand / total, LEAST), 1 - LEAST)
        if carried < SURE_FREE:
            self.home = self.rest
        by = None if near is None else near.name
        self.moments.append((t, rest, hand, taken, put, carried, self.rest, self.hand, by))
        self.news = t
        return jumped

    def _expect(self, dt: float, near: Near | None) -> tuple[float, float]:
        """Time goes by, somebody within reach has moved; the chances of being taken and put down in it."""
        rest_x, rest_y, rest_z, rest_v = self.rest
        hand_x, hand_y, hand_z, hand_v = self.hand
        put, hand = 1 - exp(-PUT * dt), self.carried
        rest, gone_x, gone_y, taken = 1 - hand, 0.0, 0.0, NEVER
        if near is not None:
            gone_x, gone_y, taken = near.vx * dt, near.vy * dt, 1 - exp(-TAKEN * dt)
        now = hand * (1 - put) + rest * taken
        a, b = rest * taken / now, hand * put / (1 - now)  # of what is in a hand, or rests, so much did not before
        dx, dy, dz = hand_x - rest_x, hand_y - rest_y, hand_z - rest_z
        apart = dx * dx + dy * dy + dz * dz
        variance = (1 - b) * rest_v + b * hand_v + b * (1 - b) * apart / 3
        self.rest = (rest_x + b * dx, rest_y + b * dy, rest_z + b * dz, variance + SETTLES * dt)
        variance = (1 - a) * hand_v + a * rest_v + a * (1 - a) * apart / 3
        self.hand = (hand_x - a * dx + gone_x, hand_y - a * dy + gone_y, hand_z - a * dz, variance + STEADY * dt)
        self.carried = now
        return taken, put

    def _at_rest(self, x: float, y: float, z: float, noise: float, near: Near | None) -> tuple[float, Belief]:
        """How likely the detection is when it rests, and where it then is: as before, put back, or put down anew."""
        rest = self.rest
        if self.carried < SURE_FREE or near is None:  # `density` and `corrected` at once, as nearly always
            own_x, own_y, own_z, variance = rest
            dx, dy, dz, s = x - own_x, y - own_y, z - own_z, variance + noise
            k = variance / s
            found = own_x + k * dx, own_y + k * dy, own_z + k * dz, (1 - k) * variance
            return exp(-0.5 * (dx * dx + dy * dy + dz * dz) / s) * (TWO_PI * s) ** -1.5, found
        places = rest, self.home, (near.x, near.y, self.hand[2], ARM)
        weights = [share * density(each, x, y, z, noise) for share, each in zip((STAYS, BACK, ANEW), places)]
        stays, back, anew = weights
        return stays + back + anew, corrected(places[weights.index(max(weights))], x, y, z, noise)

    def _in_hand(
        self, x: float, y: float, z: float, noise: float, dt: float, near: Near | None
    ) -> tuple[float, Belief]:
        """How likely the detection is when it is carried, and where it then is."""
        hand_x, hand_y, hand_z, hand_v = found = self.hand
        dx, dy, dz, s = x - hand_x, y - hand_y, z - hand_z, hand_v + noise
        half = -0.5 * (dx * dx + dy * dy + dz * dz)
        most = total = KEEPS * (exp(half / s) * (TWO_PI * s) ** -1.5)
        wide = hand_v + WANDERS * dt
        s = wide + noise
        weight = WANDERING * (exp(half / s) * (TWO_PI * s) ** -1.5)
        total += weight
        if weight > most:
            most, found = weight, (hand_x, hand_y, hand_z, wide)
        rest_x, rest_y, rest_z, rest_v = self.rest
        if not self.flat:
            lifted, wide = rest_z + LIFTED, rest_v + LIFT
            dx, dy, dz, s = x - rest_x, y - rest_y, z - lifted, wide + noise
            weight = LIFTS * (exp(-0.5 * (dx * dx + dy * dy + dz * dz) / s) * (TWO_PI * s) ** -1.5)
            total += weight
            if weight > most:
                most, found = weight, (rest_x, rest_y, lifted, wide)
        if near is not None:
            dx, dy, dz, s = x - near.x, y - near.y, z - rest_z, ARM + noise
            weight = REACHES * (exp(-0.5 * (dx * dx + dy * dy + dz * dz) / s) * (TWO_PI * s) ** -1.5)
            total += weight
            if weight > most:
                found = (near.x, near.y, rest_z, ARM)
        own_x, own_y, own_z, variance = found
        k = variance / (variance + noise)
        return total, (own_x + k * (x - own_x), own_y + k * (y - own_y), own_z + k * (z - own_z), (1 - k) * variance)

    def at(self, t: float) -> tuple[float, ObjectState, str | None] | None:
        """How likely it was carried at a moment, where it was, and in whose hand, from all that was seen by now.

        None: it was not known yet.
        """
        return self._lying(t) if t >= self.news else self._weighed(t)

    def _lying(self, t: float) -> tuple[float, ObjectState, str | None] | None:
        """The same of a moment after which it only lay: what came later says nothing of it."""
        for moment in reversed(self.moments):
            if moment[0] <= t:
                share = moment[5]
                x, y, z, _ = self.rest if share < 0.5 else moment[7]
                return share / (share + (1 - share)), ObjectState(x, y, None if self.flat else z), moment[8]
        return None

    def _weighed(self, t: float) -> tuple[float, ObjectState, str | None] | None:
        """The same of any moment."""
        rest = hand = 1.0  # likelihoods of what came later
        lies = True  # from then on
        for at, at_rest, in_hand, taken, put, carried, resting, held, by in reversed(self.moments):
            lies = lies and carried < 0.5
            if at <= t:
                share = carried * hand / (carried * hand + (1 - carried) * rest)
                x, y, z, _ = self.rest if lies else resting if share < 0.5 else held
                return share, ObjectState(x, y, None if self.flat else z), by
            at_rest, in_hand = at_rest * rest, in_hand * hand
            rest, hand = (1 - taken) * at_rest + taken * in_hand, put * at_rest + (1 - put) * in_hand
            top = rest if rest >= hand else hand
            rest, hand = (rest / top, hand / top) if top > 0.0 else (1.0, 1.0)
        return None


def density(belief: Belief, x: float, y: float, z: float, noise: float) -> float:
    """How likely a detection there is (m⁻³)."""
    own_x, own_y, own_z, variance = belief
    dx, dy, dz, s = x - own_x, y - own_y, z - own_z, variance + noise
    return float(exp(-0.5 * (dx * dx + dy * dy + dz * dz) / s) * (TWO_PI * s) ** -1.5)


def corrected(belief: Belief, x: float, y: float, z: float, noise: float) -> Belief:
    """After a detection."""
    own_x, own_y, own_z, variance = belief
    k = variance / (variance + noise)
    return own_x + k * (x - own_x), own_y + k * (y - own_y), own_z + k * (z - own_z), (1 - k) * variance
