"""Relations as columns of numbers that stand for their constants, made when a join on columns first needs them.

What was made stays with the relation until it changes. Relations that are joined have their numbers from one interner.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import chain
from threading import RLock

import numpy as np

from casper.kb.errors import NotOnColumns
from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import MOST_CODES, Ids, Interner, Run, code
from casper.kb.relations.constants import Constants
from casper.kb.relations.relation import Relation
from casper.kb.terms.terms import Term

_CODING = RLock()  # held while constants get their numbers: several questions may share an interner


class Coded:
    """The rows of one relation as columns of numbers, with an index for every pattern of columns that was asked for."""

    def __init__(self, columns: list[Ids], size: int, constants: Constants) -> None:
        self.constants, self.size = constants, size
        self.base = max(len(constants.interner), 1)  # its own numbers are below
        self._run = Run(columns, np.zeros(size, np.int64))

    @property
    def columns(self) -> list[Ids]:
        """The columns."""
        return self._run.columns

    def spans(self, at: tuple[int, ...], keys: Sequence[Ids]) -> tuple[Ids, Ids, Ids]:
        """For each key the rows that have it in the columns ``at``: where they begin, how many, in which order.

        Raises:
            NotOnColumns: the columns are too many for one number.
        """
        if self.base ** len(at) >= MOST_CODES:
            raise NotOnColumns(f"{len(at)} columns of so many constants have no common index")
        known = np.logical_and.reduce([(key >= 0) & (key < self.base) for key in keys])
        wanted = [np.where(known, key, 0) for key in keys]
        low, counts, order = self._run.spans(at, self.base, code(wanted, self.base, len(known)))
        return low, np.where(known, counts, 0), order


def coded(relations: Iterable[Relation]) -> dict[int, Coded]:
    """The relations' columns, by the relations' ids, with numbers from one interner.

    Raises:
        NotOnColumns: equal numbers of different types, 1 and 1.0, are among the constants.
    """
    largest_first = sorted({id(r): r for r in relations}.values(), key=len, reverse=True)
    with _CODING:
        known = next((r.coded for r in largest_first if _is_fresh(r)), None)
        constants = Constants(Interner()) if known is None else known.constants
        return {id(relation): _coded(relation, constants) for relation in largest_first}


def number_of(constant: Term, constants: Constants) -> int:
    """The number of a constant of a question, a new one if need be.

    Raises:
        NotOnColumns: an equal number of another type has it.
    """
    with _CODING:
        number = constants.interner.intern(constant)
    if type(constants.interner.constants[number]) is not type(constant):
        raise NotOnColumns(f"{constant} is also written otherwise")
    return number


def _is_fresh(relation: Relation) -> bool:
    """Whether a relation has columns whose interner is not mostly made of what is gone."""
    known = relation.coded
    return known is not None and len(known.constants.interner) <= 4 * known.size * max(relation.arity, 1)


def _coded(relation: Relation, constants: Constants) -> Coded:
    known: Coded | None = relation.coded
    if known is None or known.constants is not constants:
        known = relation.coded = Coded(_columns(relation, constants.interner), len(relation), constants)
    return known


def _columns(relation: Relation, interner: Interner) -> list[Ids]:
    interned = relation.interned() if isinstance(relation, ColumnRelation) else None
    if interned is None:
        return _interned(relation, interner)
    columns, constants = interned
    return [_translated(column, constants, interner) for column in columns]


def _translated(column: Ids, constants: Sequence[Term], interner: Interner) -> Ids:
    """A column with the numbers of another interner."""
    used = np.flatnonzero(np.bincount(column, minlength=len(constants)))
    numbers = np.zeros(len(constants), np.int64)
    for number in used.tolist():
        numbers[number] = interner.intern(constants[number])
        _check_same(constants[number], interner.constants[numbers[number]])
    return numbers[column]


def _interned(relation: Relation, interner: Interner) -> list[Ids]:
    columns = interner.columns(relation, relation.arity)
    flat = list(chain.from_iterable(relation))
    types = set(map(type, flat))
    if not types <= {str, int} or any(type(c) is float and c.is_integer() for c in interner.constants):
        is_number: Callable[[Term], bool] = lambda value: isinstance(value, (int, float))  # noqa: E731
        for value in filter(is_number, flat):
            _check_same(value, interner.constants[interner.numbers[value]])
    return columns


def _check_same(value: Term, kept: Term) -> None:
    if type(value) is not type(kept):
        raise NotOnColumns(f"{value} and {kept} are equal numbers of different types")
