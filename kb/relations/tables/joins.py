"""A question on stored rows worked out on numpy columns: joins by sorted indexes, negations and comparisons as masks.

The solutions come in blocks of at most ``BLOCK`` rows, depth first: however large a product is, no more than one block
for each condition is in memory. What columns cannot do is refused with `NotOnColumns`, before or in between.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from casper.kb.errors import NotOnColumns
from casper.kb.relations.coded import Coded, coded, number_of
from casper.kb.relations.columns import MOST_CODES, Ids, Table, matches
from casper.kb.relations.constants import Constants
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.tables.masks import Column, Frame, Mask, Values, check_condition, codes, compared
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import is_ground

BLOCK = 1 << 16  # solutions that are worked out at once
Find: TypeAlias = Callable[[Indicator], Relation | None]  # the relation of a predicate; None where none is settled


@dataclass(frozen=True, slots=True)
class Join:
    """The conditions of a question in the order in which they are taken, all of them fit for columns.

    ``names`` are the variables whose values are wanted; ``is_distinct`` says that no two solutions agree on them.
    """

    body: tuple[Literal, ...]
    names: tuple[Variable, ...]
    relations: Mapping[Indicator, Relation]
    is_distinct: bool


def join_of(
    body: Sequence[Literal], names: Sequence[Variable], find: Find, given: Iterable[Variable] = ()
) -> Join:
    """Check that a question can be worked out on columns, once the ``given`` variables have values.

    Raises:
        NotOnColumns: with what is in the way.
    """
    known = set(given)
    relations: dict[Indicator, Relation] = {}
    for literal in body:
        if literal.is_comparison:
            check_condition(literal, known)
            known |= literal.binds()
        else:
            relations[literal.atom.indicator] = _relation(literal, known, find)
            known |= literal.binds()
    if not known.issuperset(names):
        raise NotOnColumns("it asks for what nothing binds")
    looked_up = (x for x in body if not x.is_strict and not x.is_comparison)
    inner = {v for x in looked_up for v in x.variables()} - set(names)
    return Join(tuple(body), tuple(names), relations, not inner)


def _relation(literal: Literal, known: set[Variable], find: Find) -> Relation:
    relation = None if literal.is_aggregate else find(literal.atom.indicator)
    shown = term_text(literal.atom)
    if relation is None or relation.undefined is not None:
        raise NotOnColumns(f"{shown} is not looked up in rows that are all settled")
    if not all(isinstance(arg, Variable) or is_ground(arg) for arg in literal.atom.args):
        raise NotOnColumns(f"{shown} looks into terms")
    if literal.negated:
        wild = [arg for arg in literal.atom.args if isinstance(arg, Variable) and arg not in known]
        if not all(arg.is_anonymous for arg in wild) or len(set(wild)) < len(wild):
            raise NotOnColumns(f"\\+ {shown} has a variable that nothing binds")
    return relation


class Solutions:
    """The solutions of a join, in blocks.

    Raises:
        NotOnColumns: while they are made or iterated over.
    """

    def __init__(
        self, join: Join, by_id: Mapping[int, Coded] | None = None, constants: Constants | None = None
    ) -> None:
        self.join = join
        if by_id is None or constants is None:
            by_id = coded(join.relations.values())
            constants = next(iter(by_id.values())).constants
        self.columns: dict[Indicator, Coded] = {i: by_id[id(relation)] for i, relation in join.relations.items()}
        self.constants = constants
        for literal in join.body:  # numbers first: the radix of rows depends on how many there are
            for arg in literal.atom.args:
                if not isinstance(arg, Variable) and is_ground(arg):
                    number_of(arg, self.constants)

    def __iter__(self) -> Iterator[list[Column]]:
        """The wanted columns, block by block; each solution once over all of them."""
        seen = None if self.join.is_distinct else self._seen()
        for frame in self.extending({}, 1):
            columns = [frame[name] for name in self.join.names]
            yield columns if seen is None else list(seen.add([_plain(column) for column in columns], 0))

    def extending(self, frame: Frame, size: int) -> Iterator[Frame]:
        """Every solution that extends one of some partial solutions, in blocks, whether distinct or not."""
        return self._from(0, frame, size)

    def _seen(self) -> Table:
        arity, base = len(self.join.names), len(self.constants.interner)
        if (base + 1) ** arity >= MOST_CODES:
            raise NotOnColumns(f"{arity} columns of so many constants cannot be told apart by one number")
        return Table(arity, base)

    def _from(self, at: int, frame: Frame, size: int) -> Iterator[Frame]:
        """The solutions of the conditions from one on that extend those found so far."""
        if not size:
            return
        if at == len(self.join.body):
            yield frame
            return
        literal = self.join.body[at]
        if literal.is_comparison:
            frame, mask = compared(literal, frame, size, self.constants)
            yield from self._from(at + 1, *_kept(frame, mask, size))
        elif literal.negated:
            _, counts, _ = self._spans(literal, frame, size)
            yield from self._from(at + 1, *_kept(frame, counts == 0, size))
        else:
            for extended, more in self._matches(literal, frame, size):
                yield from self._from(at + 1, extended, more)

    def _spans(self, literal: Literal, frame: Frame, size: int) -> tuple[Ids, Ids, Ids]:
        """Where the rows of a condition are for each partial solution, how many, and in which order."""
        rows = self.columns[literal.atom.indicator]
        args = literal.atom.args
        bound = tuple(c for c, arg in enumerate(args) if not isinstance(arg, Variable) or arg in frame)
        if not bound:
            return np.zeros(size, np.int64), np.full(size, rows.size), np.arange(rows.size)
        keys = [self._key(args[c], frame, size) for c in bound]
        return rows.spans(bound, keys)

    def _key(self, arg: Term, frame: Frame, size: int) -> Ids:
        if isinstance(arg, Variable):
            return codes(frame[arg], self.constants)
        return np.full(size, number_of(arg, self.constants), np.int64)

    def _matches(self, literal: Literal, frame: Frame, size: int) -> Iterator[tuple[Frame, int]]:
        """The partial solutions with each of their rows, in blocks."""
        for which, rows in matches(*self._spans(literal, frame, size), BLOCK):
            yield self._bound(literal, {v: _at(column, which) for v, column in frame.items()}, rows)

    def _bound(self, literal: Literal, frame: Frame, rows: Ids) -> tuple[Frame, int]:
        """Give the condition's open variables their columns; one that stands there twice is a filter."""
        mask: Mask | None = None
        found: dict[Variable, Ids] = {}
        for arg, column in zip(literal.atom.args, self.columns[literal.atom.indicator].columns):
            if isinstance(arg, Variable) and arg not in frame:
                values = column[rows]
                if arg in found:
                    same = found[arg] == values
                    mask = same if mask is None else mask & same
                else:
                    found[arg] = values
        return _kept({**frame, **found}, mask, len(rows))


def _kept(frame: Frame, mask: Mask | None, size: int) -> tuple[Frame, int]:
    if mask is None or mask.all():
        return frame, size
    at = np.flatnonzero(mask)
    return {v: _at(column, at) for v, column in frame.items()}, len(at)


def _at(column: Column, places: Ids) -> Column:
    return Values(column.array[places]) if isinstance(column, Values) else column[places]


def _plain(column: Column) -> Ids:
    if isinstance(column, Values):
        raise NotOnColumns("computed values are not told apart by number")
    return column


def rows_beyond(join: Join, given: set[Row], look: Callable[[], object]) -> Iterator[Row]:
    """Every solution as a row of Python values, but for those that were given already; ``look`` is called now and then.

    Raises:
        NotOnColumns: what came until then is in ``given``.
    """
    may_fail = any(literal.is_comparison for literal in join.body)
    done: list[list[Column]] = []
    left = len(given)
    try:
        solutions = Solutions(join)
        for columns in solutions:
            look()
            rows: Iterator[Row] = zip(*(python_values(column, solutions.constants) for column in columns))
            if left:
                left, rows = _others(list(rows), given, left)
            yield from rows
            if may_fail:
                done.append(columns)
    except NotOnColumns:
        for columns in done:
            given.update(zip(*(python_values(column, solutions.constants) for column in columns)))
        raise


def _others(rows: list[Row], given: set[Row], left: int) -> tuple[int, Iterator[Row]]:
    """The rows that were not given, and how many of those that were are still to come."""
    others = [row for row in rows if row not in given]
    return left - len(rows) + len(others), iter(others)


def python_values(column: Column, constants: Constants) -> list[Any]:
    """A column as a list of Python values."""
    return list((column.array if isinstance(column, Values) else constants.terms(column)).tolist())
