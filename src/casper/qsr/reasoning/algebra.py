"""An algebra of base relations: which follow from others, and which can follow each other in time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from casper.kb.errors import TraceError

Relation = str
Set = int
"""A set of base relations: bit n is the n-th of them."""


@dataclass(frozen=True, eq=False)
class Algebra:
    """Base relations that exclude each other, and of which one always holds.

    identity: the relation of everything to itself, None where there is none. converses: by number, of which (b, a) has
    that of (a, b). composed: ``composed[r][s]`` is the set of those (a, c) may have when (a, b) has r and (b, c) has s.
    near: by number, the relations one may turn into at once under continuous change (conceptual neighbours).
    decides: whether path consistency decides if definite relations can hold together. tight: whether every
    composition is the smallest that is right.
    """

    name: str
    relations: tuple[Relation, ...]
    identity: int | None
    converses: tuple[int, ...]
    composed: tuple[tuple[Set, ...], ...]
    near: tuple[Set, ...]
    decides: bool = True
    tight: bool = True

    @cached_property
    def place(self) -> Mapping[Relation, int]:
        """The number of each relation."""
        return {relation: number for number, relation in enumerate(self.relations)}

    @property
    def all(self) -> Set:
        """Nothing is known."""
        return (1 << len(self.relations)) - 1

    def set_of(self, relations: Relation | Iterable[Relation]) -> Set:
        """A set by names.

        Raises:
            TraceError: a name is that of no relation of this calculus.
        """
        members = 0
        for relation in [relations] if isinstance(relations, str) else relations:
            if relation not in self.place:
                some = ", ".join(self.relations[:20]) + (" …" if len(self.relations) > 20 else "")
                raise TraceError(f"{relation!r:.40} is no relation of {self.name}; there are {some}")
            members |= 1 << self.place[relation]
        return members

    def names(self, members: Set) -> frozenset[Relation]:
        """The names of a set."""
        return frozenset(self.relations[number] for number in bits(members))

    def converse(self, relations: Relation | Iterable[Relation]) -> frozenset[Relation]:
        """What (b, a) may have when (a, b) has one of these."""
        return self.names(self.turned(self.set_of(relations)))

    def compose(self, one: Relation | Iterable[Relation], other: Relation | Iterable[Relation]) -> frozenset[Relation]:
        """What (a, c) may have when (a, b) has one of the first and (b, c) one of the second."""
        return self.names(self.joined(self.set_of(one), self.set_of(other)))

    def neighbours(self, relation: Relation) -> frozenset[Relation]:
        """What a relation may turn into without another between."""
        self.set_of(relation)
        return self.names(self.near[self.place[relation]])

    def turned(self, members: Set) -> Set:
        """`converse` of a set."""
        turned = 0
        for number in bits(members):
            turned |= 1 << self.converses[number]
        return turned

    @cached_property
    def _joined(self) -> dict[tuple[Set, Set], Set]:
        return {}

    def joined(self, one: Set, other: Set) -> Set:
        """`compose` of sets; what was worked out is remembered, within bounds."""
        known = self._joined.get((one, other))
        if known is None:
            known = 0
            others = list(bits(other))
            for r in bits(one):
                row = self.composed[r]
                for s in others:
                    known |= row[s]
                if known == self.all:
                    break
            if len(self._joined) >= 200_000:
                self._joined.clear()
            self._joined[one, other] = known
        return known

    def rows(self) -> dict[str, list[tuple[str, ...]]]:
        """The tables as rows of names, the calculus first: relation, converse, composition, neighbour."""
        names, name = self.relations, self.name
        return {
            "relation": [(name, r) for r in names],
            "converse": [(name, r, names[self.converses[n]]) for n, r in enumerate(names)],
            "composition": [
                (name, r, s, names[t])
                for r, row in zip(names, self.composed)
                for s, ts in zip(names, row)
                for t in bits(ts)
            ],
            "neighbour": [(name, r, names[s]) for r, members in zip(names, self.near) for s in bits(members)],
        }

    def __repr__(self) -> str:
        return f"<Algebra {self.name} of {len(self.relations)} relations>"


def bits(members: Set) -> Iterator[int]:
    """The numbers in a set, from the smallest."""
    while members:
        low = members & -members
        yield low.bit_length() - 1
        members ^= low


def product(name: str, one: Algebra, other: Algebra, labels: Mapping[tuple[Relation, Relation], Relation]) -> Algebra:
    """The algebra of pairs of relations, such as those along two axes; neighbours change along one of them."""
    pairs = list(labels)
    place = {(one.place[r], other.place[s]): number for number, (r, s) in enumerate(pairs)}
    numbers = list(place)

    def crossed(rs: Set, ss: Set) -> Set:
        return sum(1 << place[r, s] for r in bits(rs) for s in bits(ss))

    crosses: dict[tuple[Set, Set], Set] = {}

    def composed(a: tuple[int, int], b: tuple[int, int]) -> Set:
        sets = one.composed[a[0]][b[0]], other.composed[a[1]][b[1]]
        if sets not in crosses:
            crosses[sets] = crossed(*sets)
        return crosses[sets]

    identity = None if one.identity is None or other.identity is None else place[one.identity, other.identity]
    return Algebra(
        name,
        tuple(labels.values()),
        identity,
        tuple(place[one.converses[r], other.converses[s]] for r, s in numbers),
        tuple(tuple(composed(a, b) for b in numbers) for a in numbers),
        tuple(crossed(one.near[r], 1 << s) | crossed(1 << r, other.near[s]) for r, s in numbers),
        one.decides and other.decides,
        one.tight and other.tight,
    )
