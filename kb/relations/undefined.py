"""Rows that are neither true nor false, kept beside those that hold (`Relation.undefined`)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.unknown import UNKNOWN, has_unknown, may_equal


class UndefinedRows(Relation):
    """Undefined rows of one predicate; a value in them may be unknown, and is then equal to any."""

    def __init__(self, name: str, arity: int, rows: Iterable[Row] = ()) -> None:
        super().__init__(name, arity)
        self.open: dict[Row, None] = {}  # the rows with an unknown value
        for row in rows:
            self.add(row)

    def add(self, row: Row, round_: int = 0) -> bool:
        """Add a row; False when it was there already."""
        if has_unknown(row):
            self.open.setdefault(row)
        return super().add(row, round_)

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        """The rows that may equal the key on the columns."""
        found = super().matching(columns, key)
        if not self.open or not columns:
            return found
        wanted = list(zip(columns, key))
        more = [row for row in self.open if row not in found and all(may_equal(row[c], v) for c, v in wanted)]
        return [*found, *more]

    def may_hold(self, row: Row) -> bool:
        """Whether the row is undefined."""
        return row in self.rows or any(all(map(may_equal, row, other)) for other in self.open)


def wholly_unknown(indicator: Indicator, _: object = None) -> Relation:
    """A relation of which nothing is known: whatever it is asked is undefined."""
    relation = Relation(*indicator)
    relation.undefined = UndefinedRows(*indicator, [(UNKNOWN,) * indicator[1]])
    return relation


class _Possible(Relation):
    """A relation together with its undefined rows, to be looked up only."""

    def __init__(self, relation: Relation, undefined: Relation) -> None:
        super().__init__(relation.name, relation.arity)
        self.relation, self.more = relation, undefined

    def matching(self, columns: Columns, key: Row) -> Collection[Row]:
        """The rows that hold or may hold."""
        return [*self.relation.matching(columns, key), *self.more.matching(columns, key)]

    def __contains__(self, row: object) -> bool:
        return row in self.relation or row in self.more

    def __iter__(self) -> Iterator[Row]:
        yield from self.relation
        yield from self.more

    def __len__(self) -> int:
        return len(self.relation) + len(self.more)


class Possible(dict[Indicator, Relation]):
    """The relations with their undefined rows laid in: what a negation must not find to hold for certain."""

    def __init__(self, relations: Mapping[Indicator, Relation]) -> None:
        super().__init__()
        self.relations = relations

    def __missing__(self, indicator: Indicator) -> Relation:
        relation = self.relations[indicator]
        found = self[indicator] = possible(relation)
        return found


def possible(relation: Relation) -> Relation:
    """The relation with its undefined rows laid in."""
    return relation if relation.undefined is None else _Possible(relation, relation.undefined)


def are_settled(relations: Mapping[Indicator, Relation], needed: Iterable[Indicator]) -> bool:
    """Whether none of the predicates has an undefined row."""
    return all(relations[i].undefined is None for i in needed if i in relations)
