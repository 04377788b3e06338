"""Relations a step at a time: what is seen now in, what holds now out; the same answers as for the whole trace."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from casper.kb.errors import TraceError
from casper.qsr.calculi.calculus import Body, Calculus, Names, Step
from casper.qsr.calculi.table import calculi
from casper.qsr.plain.points import LARGEST
from casper.qsr.tuples import Related

if TYPE_CHECKING:
    from casper.qsr.steps import ArraySteps

MOST_NAMES = 100_000
"""Names of things that are gone which are remembered, so that memory does not grow."""
FEW, FEW_QUICK = 64, 500
"""Tuples up to which plain Python is faster than numpy; the second where each calculus has a loop of its own."""
KERNELS = ("plain", "arrays")

Seen = Mapping[str, "Body | Sequence[float]"]
"""Things by name: a `Body`, or (x, y) or (x, y, z) in metres."""
Holds = dict[str, dict[Names, str]]
"""By calculus, by tuple: the label. What is undefined is not there."""


class Stream:
    """Keeps the step before, and nothing older: memory does not grow.

    Args:
        named: calculi, by name or with settings of their own.
        observer, things, pairs, triples: who is related, as in `casper.qsr.relations`; who is not there at a step is
            left out of it, so things may come and go.
        longest_step: seconds; motion is not taken across a longer step.
        kernel: ``plain`` or ``arrays``; None: by the number of tuples, at each step.

    Raises:
        TraceError: a calculus or a kernel that does not exist.
    """

    def __init__(
        self,
        *named: str | Calculus,
        observer: str | None = None,
        things: Iterable[str] | None = None,
        pairs: Iterable[Sequence[str]] | None = None,
        triples: Iterable[Sequence[str]] | None = None,
        longest_step: float = math.inf,
        kernel: str | None = None,
    ) -> None:
        self.calculi = calculi(named)
        self._few = FEW_QUICK if all(each.quick for each in self.calculi) else FEW
        self._needy = tuple(each for each in self.calculi if each.needs)
        self.related = Related.of(observer, things, pairs, triples)
        if not longest_step > 0.0:
            raise TraceError(f"the longest step is a number of seconds above 0, not {longest_step}")
        if kernel is not None and kernel not in KERNELS:
            raise TraceError(f"a kernel is plain or arrays, not {kernel!r:.40}")
        self.longest_step, self.kernel = longest_step, kernel
        self._arrays: ArraySteps | None = None
        self._tuples: dict[int, tuple[Names, ...]] = {}
        self._names: tuple[str, ...] | None = None
        self.reset()

    def reset(self) -> None:
        """Forget the step before; time may start again."""
        self._t: float | None = None
        self._seen: dict[str, Body] = {}
        self._held: Holds = {}
        self._high: set[str] = set()
        self._low: set[str] = set()

    def update(self, t: float, things: Seen) -> Holds:
        """What holds at this step.

        Args:
            t: seconds.
            things: what is seen now; what is not there is absent.

        Raises:
            TraceError: time does not advance, a coordinate is no usable number, or what a calculus needs is missing;
                the step is not taken in, and the next one may be.
        """
        bodies = self._checked(t, things)
        dt = 1.0 if self._t is None else t - self._t
        was = self._seen if self._t is not None and dt <= self.longest_step else {}
        names = tuple(bodies)
        if names != self._names:
            self._names = names
            self._tuples = {arity: self.related.tuples(arity, names) for arity in {c.arity for c in self.calculi}}
        if self._needy:
            self._check_needs(t, bodies)
        self._learn_heights(bodies)
        count = max(map(len, self._tuples.values()))
        if self.kernel == "arrays" or (self.kernel is None and count > self._few):
            holds = self._on_arrays().step(self._tuples, bodies, was, dt, self._held)
        else:
            holds = {c.name: self._plain(c, bodies, was, dt) for c in self.calculi}
        self._t, self._seen, self._held = t, bodies, holds
        return holds

    def _plain(self, calculus: Calculus, bodies: dict[str, Body], was: dict[str, Body], dt: float) -> dict[Names, str]:
        rows = self._tuples[calculus.arity]
        told = calculus.many(Step(rows, bodies, was, dt), self._held.get(calculus.name, {}))
        return {row: label for row, label in zip(rows, told, strict=True) if label is not None}

    def _on_arrays(self) -> ArraySteps:
        if self._arrays is None:
            from casper.qsr.steps import ArraySteps

            self._arrays = ArraySteps(self.calculi)
        return self._arrays

    def _checked(self, t: float, things: Seen) -> dict[str, Body]:
        if not (isinstance(t, (int, float)) and math.isfinite(t)):
            raise TraceError(f"the time of a step is a finite number, not {t!r:.40}")
        if self._t is not None and t <= self._t:
            raise TraceError(f"time must advance from one step to the next: t={t:g} came after t={self._t:g}")
        bodies, high, low, largest = {}, self._high, self._low, LARGEST
        for name, given in things.items():
            body = given if isinstance(given, Body) else _body(name, given, t)
            z = body[2]
            if not (
                -largest < body[0] < largest and -largest < body[1] < largest and (z is None or -largest < z < largest)
            ):
                raise TraceError(_unusable(name, body, t))
            if name in (high if z is None else low):
                raise TraceError(f"{name} has a height at some steps and none at others (t={t:g})")
            bodies[name] = body
        return bodies

    def _learn_heights(self, bodies: dict[str, Body]) -> None:
        for name in bodies.keys() - self._high - self._low:
            (self._low if bodies[name][2] is None else self._high).add(name)
        if len(self._high) + len(self._low) > MOST_NAMES:
            self._high, self._low = self._high & bodies.keys(), self._low & bodies.keys()

    def _check_needs(self, t: float, bodies: dict[str, Body]) -> None:
        for calculus in self._needy:
            for need in calculus.needs:
                rows = self._tuples[calculus.arity]
                for name in {row[0] for row in rows} if need == "heading" else {name for row in rows for name in row}:
                    if not _has(bodies[name], need):
                        word = {"z": "height"}.get(need, need)
                        above = " (above 0)" if need == "size" else ""
                        raise TraceError(f"{name} has no {word} at t={t:g}, which {calculus.name} needs{above}")


def _body(name: str, given: Sequence[float], t: float) -> Body:
    if isinstance(given, str) or not isinstance(given, Sequence) or len(given) not in (2, 3):
        raise TraceError(f"{name} should be a Body, (x, y) or (x, y, z) at t={t:g}, not {given!r:.40}")
    return Body(*given)  # type: ignore[arg-type]


def _unusable(name: str, body: Body, t: float) -> str:
    letter, value = next((a, v) for a, v in zip("xyz", body) if v is not None and not -LARGEST < v < LARGEST)  # type: ignore[operator]
    return f"{name} has {value} as its {letter} at t={t:g}; coordinates are finite numbers"


def _has(body: Body, need: str) -> bool:
    if need == "size":
        return body.size is not None and all(0.0 < extent < math.inf for extent in body.size)
    value = getattr(body, need)
    return value is not None and math.isfinite(value)
