"""A whole program's fixpoint on columns: facts interned into tables, strata evaluated one after the other."""

from __future__ import annotations

from collections.abc import Mapping

from casper.kb.bottom_up.circles.columns import is_plain_circle, settle_columns
from casper.kb.bottom_up.columnar import ColumnStratum, fits, is_columnar
from casper.kb.bottom_up.row_fixpoint import evaluate_stratum
from casper.kb.bottom_up.size import Room
from casper.kb.program.program import Program
from casper.kb.program.strata import needs
from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import Interner, Table
from casper.kb.relations.relation import Relation
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Clause, Indicator


def columnar_fixpoint(program: Program, most_rows: int) -> dict[Indicator, Relation] | None:
    """All rows of every stored predicate, or None when some rule or fact is not plain enough for columns.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    stored = [indicator for stratum in program.strata for indicator in stratum]
    rules = [rule for indicator in stored for rule in program.rules[indicator]]
    circles = [stratum for stratum in program.strata if not stratum.isdisjoint(program.circular)]
    if program.least or not is_columnar(rules) or not all(is_plain_circle(_rules(program, c), c) for c in circles):
        return None
    wide = [i for i in stored if i[1] > 0]
    interner = Interner()
    columns = {i: interner.columns(program.given[i], i[1]) for i in wide}
    for rule in rules:
        for atom in (rule.head, *(x.atom for x in rule.body)):
            for arg in atom.args:
                interner.intern(arg)
    if not fits((arity for _, arity in wide), len(interner)):
        return None
    tables = {i: Table(i[1], len(interner)) for i in wide}
    for indicator, found in columns.items():
        if len(found[0]):
            tables[indicator].add(found, 0)
    room, round_ = Room(most_rows, tables), 0
    undefined: dict[Indicator, UndefinedRows] = {}
    for at, stratum in enumerate(program.strata):
        of_stratum = _rules(program, stratum)
        if not undefined.keys().isdisjoint(needs(of_stratum)):
            relations = _relations(program, tables, interner, undefined)
            for later in program.strata[at:]:  # what needs undefined rows is worked out on rows
                round_ = evaluate_stratum(program, later, relations, Room(most_rows, relations), round_)
            return relations
        if stratum in circles:
            round_, open_ = settle_columns(tables, interner, stratum, of_stratum, room.take, round_)
            undefined.update((i, UndefinedRows(*i, rows)) for i, rows in open_.items() if rows)
        else:
            round_ = ColumnStratum(tables, interner, stratum, of_stratum, room.take).run(round_)
    return _relations(program, tables, interner, undefined)


def _rules(program: Program, stratum: frozenset[Indicator]) -> list[Clause]:
    return [rule for indicator in sorted(stratum) for rule in program.rules[indicator]]


def _relations(
    program: Program,
    tables: Mapping[Indicator, Table],
    interner: Interner,
    undefined: Mapping[Indicator, UndefinedRows],
) -> dict[Indicator, Relation]:
    """The tables as relations, with the undefined rows beside them."""
    stored = [indicator for stratum in program.strata for indicator in stratum]
    relations: dict[Indicator, Relation] = {i: Relation(*i, program.given[i]) for i in stored if i[1] == 0}
    relations.update((i, ColumnRelation(*i, table, interner)) for i, table in tables.items())
    for indicator, rows in undefined.items():
        relations[indicator].undefined = rows
    return relations
