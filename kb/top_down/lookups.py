"""A question on stored rows alone: nested look-ups, without the machine, planned once for all questions of its shape.

The shape of a question is its predicates, which arguments are known, and which are the same. The answers are the
machine's; only conditions that are look-ups of constants and variables qualify.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any, TypeAlias

from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, walk

Shape: TypeAlias = tuple[str | int, ...]  # for each condition its name, and for each argument the variable, or _KNOWN
Order: TypeAlias = Callable[[Sequence[Literal]], Sequence[Literal]]
_KNOWN = -1
MOST_PLANS = 4096  # shapes that are remembered at a time


@dataclass(frozen=True, slots=True)
class Lookup:
    """One condition: the columns that are known when it is reached, and what its rows tell.

    A frame holds the question's constants, then its variables. ``key`` reads the known columns' values off a frame;
    ``binds`` are columns with the slot that they fill, ``agrees`` pairs of columns that must be the same.
    """

    relation: Relation
    columns: Columns
    key: Callable[[Sequence[Term]], Row]
    binds: tuple[tuple[int, int], ...]
    agrees: tuple[tuple[int, int], ...]

    def rows(self, frame: Sequence[Term]) -> Iterator[Row]:
        """The rows that fit what is known."""
        found = iter(self.relation.matching(self.columns, self.key(frame)))
        return filter(self._agree, found) if self.agrees else found

    def _agree(self, row: Row) -> bool:
        return all(row[one] == row[other] for one, other in self.agrees)


@dataclass(frozen=True, slots=True)
class Planned:
    """The look-ups of one shape, in the order in which they are taken, and how many variables they give."""

    lookups: tuple[Lookup, ...]
    size: int
    pick: Callable[[Sequence[Term]], Row]  # of one look-up: a row's values in the order of the variables

    @property
    def is_settled(self) -> bool:
        """Whether no relation has undefined rows just now."""
        return all(lookup.relation.undefined is None for lookup in self.lookups)

    def answers(self, constants: Sequence[Term], look: Callable[[int], int] | None) -> Iterator[Row]:
        """Every answer, as the row of the values of all variables; ``look`` is told of the steps now and then."""
        if len(self.lookups) > 1:
            assert look is not None
            return _nested(self.lookups, list(constants), self.size, look)
        if look is not None:
            look(0)
        return map(self.pick, self.lookups[0].rows(constants))


class Lookups:
    """How questions are looked up in one state of the relations, each shape planned when it is first asked.

    Rows may come and go, as long as each relation stays the same object.
    """

    def __init__(self, relations: Mapping[Indicator, Relation], order: Order = list) -> None:
        self.relations, self.order = relations, order
        self.plans: dict[Shape, Planned | None] = {}

    def of(self, shape: Shape) -> Planned | None:
        """How a question of the shape is looked up; None where some condition is something else, or undefined rows."""
        try:
            found = self.plans[shape]
        except KeyError:
            if len(self.plans) >= MOST_PLANS:
                self.plans = {}
            found = self.plans[shape] = self._planned(shape)
        return found if found is not None and found.is_settled else None

    def _planned(self, shape: Shape) -> Planned | None:
        body, constants, size = _spelt(shape)
        if not body or any(x.is_comparison or x.is_strict for x in body):
            return None
        if any(self.relations.get(x.atom.indicator) is None for x in body):
            return None
        known = set[int](range(constants))
        lookups = tuple(_lookup(self.relations[x.atom.indicator], x, known) for x in self.order(body))
        first = lookups[0]
        return Planned(lookups, size, _picker([column for column, _ in first.binds], first.relation.arity))


def shape_of(body: Sequence[Literal], given: Bindings) -> tuple[Shape, list[Term], dict[Variable, int]] | None:
    """The shape of a question, its constants, and the number of each variable; None where it has more in it."""
    shape: list[str | int] = []
    constants: list[Term] = []
    names: dict[Variable, int] = {}
    for literal in body:
        if literal.negated:
            return None
        atom = literal.atom
        shape.append(atom[0])
        for arg in atom[1:]:
            if given and type(arg) is Variable:
                arg = walk(arg, given)
            if type(arg) is Variable:
                shape.append(names.setdefault(arg, len(names)))
            elif type(arg) is str or is_ground(arg):
                shape.append(_KNOWN)
                constants.append(arg)
            else:
                return None
    return tuple(shape), constants, names


def _spelt(shape: Shape) -> tuple[list[Literal], int, int]:
    """Conditions of a shape, with the number of constants and of variables.

    An argument is the slot of a frame that it stands for: of a constant as a number, of a variable as a `Variable`.
    """
    constants, size = shape.count(_KNOWN), max((x for x in shape if isinstance(x, int)), default=_KNOWN) + 1
    atoms: list[list[Any]] = []
    number = 0
    for part in shape:
        if isinstance(part, str):
            atoms.append([part])
        elif part == _KNOWN:
            atoms[-1].append(number)
            number += 1
        else:
            atoms[-1].append(Variable("X", constants + part))
    return [Literal(Compound(atom)) for atom in atoms], constants, size


def _lookup(relation: Relation, literal: Literal, known: set[int]) -> Lookup:
    """How a condition is looked up when those slots of the frame are known; afterwards all of its own are."""
    slots = [arg.serial if isinstance(arg, Variable) else arg for arg in literal.atom.args]
    columns = tuple(at for at, slot in enumerate(slots) if slot in known)
    first: dict[int, int] = {}
    agrees = []
    for at, slot in enumerate(slots):
        if slot not in known and first.setdefault(slot, at) != at:
            agrees.append((first[slot], at))
    known.update(slots)
    key = _picker([slots[at] for at in columns])
    return Lookup(relation, columns, key, tuple((at, slot) for slot, at in first.items()), tuple(agrees))


def _picker(places: Sequence[int], length: int | None = None) -> Callable[[Sequence[Term]], Row]:
    """What picks those places of a row, as a tuple; of all ``length`` places in their order, the row itself."""
    if length is not None and list(places) == list(range(length)):
        return tuple
    if len(places) > 1:
        return itemgetter(*places)
    if not places:
        return lambda row: ()
    (only,) = places
    return lambda row: (row[only],)


def _nested(lookups: Sequence[Lookup], frame: list[Term], size: int, look: Callable[[int], int]) -> Iterator[Row]:
    """Every way to look up one after the other, as the row of the values of all variables."""
    constants = len(frame)
    frame += [None] * size
    last, granted = len(lookups) - 1, look(0)
    left = granted
    open_ = [lookups[0].rows(frame)]
    while open_:
        depth = len(open_) - 1
        for row in open_[-1]:
            for column, slot in lookups[depth].binds:
                frame[slot] = row[column]
            if depth == last:
                yield tuple(frame[constants:])
                continue
            left -= 1
            if left <= 0:
                granted = left = look(granted - left)
            open_.append(lookups[depth + 1].rows(frame))
            break
        else:
            open_.pop()
