"""Best-first enumeration of the paths through levels of states: explanations, one after the other, without a list.

The best that can still come of a state is exact, so the search never turns back: the next path costs as many steps as
it is long.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from heapq import heappop, heappush
from itertools import count
from typing import Any, TypeAlias, TypeVar

S = TypeVar("S")
Mark: TypeAlias = Any  # what a step is told as; marks of one level compare with one another
Onward: TypeAlias = dict[S, list[tuple[Mark, S, float]]]  # by state: mark, following state and factor of each step
Back: TypeAlias = Callable[[int, S], Iterable[tuple[S, Mark, float]]]
"""(level, state) -> the states of the level before that lead here, each with the step's mark and factor."""


def best_first(finals: Mapping[S, float], back: Back[S], steps: int) -> Iterator[tuple[float, tuple[Mark, ...], S]]:
    """Every path that ends in one of the final states, as (weight, marks, final state).

    A path weighs what its final state does, times the factors of its steps; equal weights come in the order of their
    marks. Shape: ``steps`` steps, so as many marks.
    """
    ahead, forward = _look_ahead(finals, back, steps)
    order = count()
    heap: list[tuple[float, tuple[Mark, ...], int, S, float]] = []
    for state, bound in ahead[0].items():
        heappush(heap, (-bound, (), next(order), state, 1.0))
    while heap:
        bound, marks, _, state, weight = heappop(heap)
        level = len(marks)
        if level == steps:
            yield -bound, marks, state
            continue
        for mark, following, factor in forward[level][state]:
            reached = weight * factor
            heappush(heap, (-reached * ahead[level + 1][following], (*marks, mark), next(order), following, reached))


def _look_ahead(finals: Mapping[S, float], back: Back[S], steps: int) -> tuple[list[dict[S, float]], list[Onward[S]]]:
    """Per level what each state can still become at best, and the steps that lead on from it."""
    ahead: list[dict[S, float]] = [dict(finals)]
    forward: list[Onward[S]] = []
    for level in range(steps, 0, -1):
        bounds: dict[S, float] = {}
        onward: Onward[S] = {}
        for state, bound in ahead[-1].items():
            for before, mark, factor in back(level, state):
                bounds[before] = max(bounds.get(before, 0.0), factor * bound)
                onward.setdefault(before, []).append((mark, state, factor))
        ahead.append(bounds)
        forward.append(onward)
    return ahead[::-1], forward[::-1]
