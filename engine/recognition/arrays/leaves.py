"""The leaves of a library of chains, grouped by action name: what `arrays` counts on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from casper.engine.recognition.arrays.shared import Array
from casper.plans.trees.plan import Plan


@dataclass(frozen=True, slots=True)
class Leaves:
    """The leaves of one name, in the order of the library. Shapes: (leaves of the name,), but (plans that have it,)
    for ``first`` (where each such plan begins among them) and ``plans``."""

    at: Array  # number among all leaves
    begin: Array  # number of its plan's first leaf
    plan: Array
    right: Array  # leaves right of it
    square: Array  # of its plan's number of leaves
    first: Array
    plans: Array


def leaves_by_name(np: Any, plans: Sequence[Plan], lengths: Array) -> dict[str, Leaves]:
    """The leaves of every name; ``lengths``: by plan, how many leaves it has."""
    names = [leaf[0] for plan in plans for leaf in plan.leaves]
    numbers = {name: at for at, name in enumerate(dict.fromkeys(names))}
    symbols = np.fromiter((numbers[name] for name in names), np.int64, len(names))
    ends = np.cumsum(lengths)
    plan_of = np.repeat(np.arange(len(plans)), lengths)
    order = np.argsort(symbols, kind="stable")
    bounds = np.searchsorted(symbols[order], np.arange(len(numbers) + 1))
    found = {}
    for name, number in numbers.items():
        at = order[bounds[number] : bounds[number + 1]]
        plan = plan_of[at]
        own, first = np.unique(plan, return_index=True)
        begin = (ends - lengths)[plan]
        found[name] = Leaves(at, begin, plan, ends[plan] - at - 1, lengths[plan] ** 2, first, own)
    return found
