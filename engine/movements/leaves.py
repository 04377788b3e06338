"""Leaves of a learned tree as they stand in a domain: clauses of ``movement/10`` with ``likelihood/3`` beside them.

    movement(still, holding, _, _, G, brief, no, _, _, pick) :- member(G, [strong, sure]).
    likelihood(7, pick, 0.83).

A clause is a box: it says of some features which values they may have. The number is that of the clause, from 1.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from casper.engine.movements.features import TIMED_ORDERS, TimedFeatures
from casper.engine.settings import number, require
from casper.kb.errors import DomainError
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import NIL, Term, Variable, list_items

TIMED: Indicator = ("movement", len(TIMED_ORDERS) + 1)
MOVEMENTS: tuple[Indicator, ...] = (("movement", 5), TIMED)


@dataclass(frozen=True, slots=True)
class Box:
    """The values each feature may have, the movement, and how likely that is for each movement (None: not known)."""

    allowed: tuple[frozenset[str], ...]
    label: str
    likelihoods: Mapping[str, float] | None = None

    def has(self, seen: TimedFeatures) -> bool:
        """Whether the features are in it."""
        return all(value in allowed for value, allowed in zip(seen, self.allowed))

    @property
    def size(self) -> int:
        """How many combinations of features are in it."""
        return math.prod(map(len, self.allowed))


def boxes_of(clauses: Sequence[Clause], rows: Iterable[Sequence[Any]]) -> tuple[Box, ...]:
    """The boxes of clauses, with the likelihoods that facts give to their numbers.

    Raises:
        DomainError: a clause that asks for something else than values of its features, with its place; a likelihood
            that is none, or of no clause.
    """
    table: dict[int, dict[str, float]] = {}
    for leaf, movement, p in rows:
        where = f"likelihood({leaf}, {movement}, {p})"
        require(isinstance(leaf, int) and 1 <= leaf <= len(clauses), f"{where} is of no clause of movement/{TIMED[1]}")
        chance = number(p, where)
        require(chance > 0.0, f"{where}: a likelihood is above 0")
        table.setdefault(leaf, {})[str(movement)] = chance
    return tuple(_box(clause, table.get(at)) for at, clause in enumerate(clauses, 1))


def check_boxes(boxes: Sequence[Box]) -> None:
    """See that every combination of features is in exactly one.

    Raises:
        DomainError: one is in two, or in none.
    """
    for one, other in combinations(boxes, 2):
        common = [sorted(a & b) for a, b in zip(one.allowed, other.allowed)]
        if all(common) and one.label != other.label:
            shown = ", ".join(values[0] for values in common)
            raise DomainError(f"movement: {shown} is both {one.label} and {other.label}")
        require(not all(common), f"two clauses of movement/{TIMED[1]} with {one.label} have features in common")
    every = math.prod(map(len, TIMED_ORDERS))
    missing = every - sum(box.size for box in boxes)
    require(missing == 0, f"movement/{TIMED[1]} has no answer for {missing} of {every} combinations of features")


def _box(clause: Clause, likelihoods: Mapping[str, float] | None) -> Box:
    *args, label = clause.head.args
    if not isinstance(label, str):
        raise _refused(clause, "its last argument is a movement")
    allowed = [set(order) if isinstance(arg, Variable) else {str(arg)} for arg, order in zip(args, TIMED_ORDERS)]
    for values, order in zip(allowed, TIMED_ORDERS):
        if not values <= set(order):
            raise _refused(clause, f"{', '.join(values)} is none of {', '.join(order)}")
    for literal in clause.body:
        at, values = _narrowed(literal, args)
        if at is None or not values:
            raise _refused(clause, "a condition lists values of a feature, as in member(Qdc, [touch, near])")
        allowed[at] = allowed[at] & values
    return Box(tuple(map(frozenset, allowed)), label, likelihoods)


def _narrowed(literal: Literal, args: Sequence[Term]) -> tuple[int | None, set[str]]:
    """Which argument a condition is about, and the values that it lists."""
    atom = literal.atom
    if literal.negated or atom.indicator != ("member", 2) or atom[1] not in args or not isinstance(atom[1], Variable):
        return None, set()
    items, tail = list_items(atom[2])
    return args.index(atom[1]), {str(item) for item in items} if tail == NIL else set()


def _refused(clause: Clause, sentence: str) -> DomainError:
    return DomainError(f"movement/{TIMED[1]}: {sentence}", clause.place if clause.place.line else None)
