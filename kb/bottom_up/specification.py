"""The executable specification of what a program means: naive and alternating, stratum by stratum.

For each stratum, what is possible and what is certain are worked out in turn until neither changes: every clause is
tried on everything known, again and again, by the search, which knows three truth values. `materialise` must agree.
"""

from __future__ import annotations

from collections.abc import Iterator

from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.unification import substitute
from casper.kb.terms.unknown import DOUBT, closed
from casper.kb.top_down.solve import Solver


def naive_fixpoint(program: Program) -> dict[Indicator, Relation]:
    """All rows of every stored predicate, the undefined ones beside those that hold."""
    relations = {i: Relation(*i, program.given[i]) for stratum in program.strata for i in stratum}
    for stratum in program.strata:
        size = -1
        while size != sum(len(relations[i]) for i in stratum):
            size = sum(len(relations[i]) for i in stratum)
            _add_possible(program, stratum, relations)
            _replace_by_certain(program, stratum, relations)
        for indicator in stratum:
            relations[indicator].undefined = _without(relations[indicator])
    return relations


def _add_possible(program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation]) -> None:
    """As undefined rows, all that is possible while the rows that hold are all that is certain."""
    for indicator in stratum:
        relations[indicator].undefined = UndefinedRows(*indicator)
    while any([_add(relations, i, row) for i in stratum for row, _ in list(_derived(program, i, relations))]):
        pass


def _add(relations: dict[Indicator, Relation], indicator: Indicator, row: Row) -> bool:
    relation = relations[indicator]
    return row not in relation and relation.undefined is not None and relation.undefined.add(row)


def _replace_by_certain(program: Program, stratum: frozenset[Indicator], relations: dict[Indicator, Relation]) -> None:
    """As rows that hold, all that is certain while the undefined rows and those that held are all that is possible."""
    for indicator in stratum:
        certain = Relation(*indicator, program.given[indicator])
        certain.undefined = UndefinedRows(*indicator, [*relations[indicator], *(relations[indicator].undefined or ())])
        relations[indicator] = certain
    while any(
        [relations[i].add(row) for i in stratum for row, sure in list(_derived(program, i, relations)) if sure]
    ):
        pass


def _derived(
    program: Program, indicator: Indicator, relations: dict[Indicator, Relation]
) -> Iterator[tuple[Row, bool]]:
    """What the rules of one predicate give of what is known, and whether for certain."""
    solver = Solver(relations, program.clauses, budget=10**9)
    for clause in program.rules[indicator]:
        for solution in solver.possible(clause.body):
            row = tuple([closed(substitute(arg, solution)) for arg in clause.head.args])
            yield row, DOUBT not in solution


def _without(relation: Relation) -> UndefinedRows | None:
    """The undefined rows of a relation, less those that hold."""
    left = [row for row in relation.undefined or () if row not in relation]
    return UndefinedRows(relation.name, relation.arity, left) if left else None
