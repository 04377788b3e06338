"""Calls of stored relations: look-ups through the index of the columns that are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unknown import opened
from casper.kb.terms.values.sizes import check_large
from casper.kb.top_down.compiled.cells import (
    UNBOUND,
    Trail,
    freeze,
    frozen_is_ground,
    inward,
    serials,
    undo,
)
from casper.kb.top_down.compiled.code import Frame, Node
from casper.kb.top_down.compiled.unifying import is_ground, unify
from casper.kb.top_down.linking import Link
from casper.kb.top_down.running.engine import Workspace
from casper.kb.top_down.running.strands import ROWS, Choice, Cont, State, Strand


def looked_up(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    """The first row that fits; a choice point has the others."""
    columns, key, open_, positions = pattern(node.build(frame))
    relation: Relation = link.what
    if not open_:
        return (node.next, frame, cont, doubt) if key in relation else None
    rows = relation.matching(columns, key)
    size = len(rows)
    if size == 0:
        return None
    if size == 1:
        (row,) = rows
        trail, top = strand.trail, strand.top
        for column, term in zip(positions, open_):
            if not unify(term, row[column], trail, top):
                return None
        return node.next, frame, cont, doubt
    if node.next is not None:
        cont = (node.next, frame, cont)
    work.serial = serial = work.serial + 1
    choice = Choice(len(strand.trail), serial, doubt, ROWS, iter(rows), positions, open_, cont)  # type: ignore[arg-type]
    strand.push(choice)
    return next_row(work, choice, strand)


def next_row(work: Workspace, choice: Choice, strand: Strand) -> State | None:
    """The next row that a choice point of a look-up has; None where it does not fit, or there is none left."""
    row = next(choice.what, None)
    if row is None:
        strand.pop()
        return None
    trail, top = strand.trail, choice.serial
    for column, term in zip(choice.at, choice.args):  # type: ignore[call-overload]
        if type(term) is list and term[0] is UNBOUND:
            term[0] = row[column]
            trail.append(term)
        elif not unify(term, row[column], trail, top):
            return None
    return None, _NO_FRAME, choice.cont, choice.doubt


_NO_FRAME: Frame = []


def pattern(args: tuple[Any, ...]) -> tuple[Columns, Row, list[Any], list[int]]:
    """Of a look-up's arguments: the columns that are known, their values, the terms that are open, their columns."""
    columns: list[int] = []
    key: list[Any] = []
    open_: list[Any] = []
    positions: list[int] = []
    for at, arg in enumerate(args):
        while type(arg) is list:
            value = arg[0]
            if value is UNBOUND:
                break
            arg = value
        if isinstance(arg, tuple):
            arg = _known_or_open(arg)
        if type(arg) is list or type(arg) is tuple:
            open_.append(arg)
            positions.append(at)
        else:
            columns.append(at)
            key.append(arg)
    return tuple(columns), tuple(key), open_, positions


def _known_or_open(term: tuple[Any, ...]) -> Any:
    """A compound term without cells, where it is ground; its hash is that of a tree.

    Raises:
        BudgetExceeded: that tree is too large.
    """
    if not is_ground(term):
        return term
    frozen = freeze(term, {})
    check_large(frozen)
    return frozen


def doubtful_rows(link: Link, args: tuple[Any, ...], name: str) -> Iterator[tuple[Row, str]]:
    """The rows of a relation some of whose rows are undefined, each with what makes it doubtful (else ``""``)."""
    columns, key, _, _ = pattern(args)
    relation: Relation = link.what
    for row in list(relation.matching(columns, key)):
        yield row, ""
    for row in list(relation.undefined.matching(columns, key)) if relation.undefined is not None else ():
        yield tuple([opened(value, serials) for value in row]), undefined_sentence(name, row)


def undefined_sentence(name: str, row: Row) -> str:
    """That a row is undefined, in words."""
    return f"{term_text(as_term(Compound((name, *row))))} is undefined"


def absent(link: Link, name: str, args: Iterable[Any], frozen: Row) -> bool | str:
    """Whether no stored row is an instance of a goal; if that is undefined, the reason."""
    relation: Relation = link.what
    if _fits(relation, args, frozen):
        return False
    undefined = relation.undefined
    if undefined is None:
        return True
    columns, key = _known(frozen)
    for row in list(undefined.matching(columns, key)):
        if _unifies(args, tuple([opened(value, serials) for value in row])):
            return undefined_sentence(name, row)
    return True


def _known(frozen: Row) -> tuple[Columns, Row]:
    columns = tuple([at for at, arg in enumerate(frozen) if frozen_is_ground(arg)])
    return columns, tuple([frozen[at] for at in columns])


def _fits(relation: Relation, args: Iterable[Any], frozen: Row) -> bool:
    columns, key = _known(frozen)
    if len(columns) == len(frozen):
        return key in relation
    return any(_unifies(args, row) for row in relation.matching(columns, key))


def _unifies(args: Iterable[Any], row: Row) -> bool:
    trail = Trail()
    cells: dict[Any, Any] = {}
    fits = unify(("", *args), ("", *[inward(value, cells) for value in row]), trail, 1 << 62)
    undo(trail, 0)
    return fits
