"""A whole program's fixpoint on columns: facts interned into tables, strata evaluated one after the other."""

from __future__ import annotations

from casper.kb.bottom_up.columnar import ColumnStratum, fits, is_columnar
from casper.kb.bottom_up.size import Room
from casper.kb.program.program import Program
from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import Interner, Table
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Indicator


def columnar_fixpoint(program: Program, most_rows: int) -> dict[Indicator, Relation] | None:
    """All rows of every stored predicate, or None when some rule or fact is not plain enough for columns.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived.
    """
    stored = [indicator for stratum in program.strata for indicator in stratum]
    rules = [rule for indicator in stored for rule in program.rules[indicator]]
    if program.circular or program.least or not is_columnar(rules):
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
    for stratum in program.strata:
        of_stratum = [rule for indicator in sorted(stratum) for rule in program.rules[indicator]]
        round_ = ColumnStratum(tables, interner, stratum, of_stratum, room.take).run(round_)
    relations: dict[Indicator, Relation] = {i: Relation(*i, program.given[i]) for i in stored if i[1] == 0}
    relations.update((i, ColumnRelation(*i, tables[i], interner)) for i in wide)
    return relations


