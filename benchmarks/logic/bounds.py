"""Promises: each is a number from the run beside its bound, kept or not kept.

A family of benchmarks states its own in ``promises``; what stands behind one is a task and an engine of its figures.
"""

from dataclasses import dataclass
from math import inf
from typing import TypeAlias

from .figures import OURS, Amounts

Key: TypeAlias = tuple[str, str]  # task, engine


@dataclass(frozen=True, slots=True)
class Bound:
    """A promise; ``value`` is None when something it needs was not measured, or the answers differed."""

    promise: str
    value: float | None
    bound: float
    unit: str
    at_least: bool = False

    @property
    def held(self) -> bool | None:
        """Whether the promise is kept; None when that is not known."""
        if self.value is None:
            return None
        return self.value >= self.bound if self.at_least else self.value <= self.bound


def quotient(amounts: Amounts, one: Key, other: Key) -> float | None:
    """How many times the other the one is, where both were measured."""
    return amounts[one] / amounts[other] if one in amounts and other in amounts else None


def ratio(amounts: Amounts, promise: str, ours: Key, other: Key, bound: float) -> Bound:
    """At most so many times what another took."""
    return Bound(promise, quotient(amounts, ours, other), bound, "×")


def against(amounts: Amounts, task: str, peer: str, bound: float = 1) -> Bound:
    """On one task, at most so many times what a peer took; where only the peer came to an end, it is not kept."""
    if (task, peer) in amounts and (task, OURS) not in amounts:
        return Bound(f"{task}, against {peer}", inf, bound, "×")
    return ratio(amounts, f"{task}, against {peer}", (task, OURS), (task, peer), bound)


def within(amounts: Amounts, task: str, bound: float, unit: str = "ms", engine: str = OURS) -> Bound:
    """At most so many seconds, in milli- or microseconds."""
    found = amounts.get((task, engine))
    each = {"s": 1.0, "ms": 1e3, "µs": 1e6}[unit]
    return Bound(task, None if found is None else found * each, bound, unit)


def least(amounts: Amounts, task: str, bound: float, unit: str) -> Bound:
    """At least so many of something that is counted."""
    return Bound(task, amounts.get((task, OURS)), bound, unit, at_least=True)
