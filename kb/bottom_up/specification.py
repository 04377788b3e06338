"""The executable specification of what a program means: the naive fixpoint, stratum by stratum.

Every clause is tried on everything known, again and again, until nothing new comes. `materialise` must agree.
"""

from __future__ import annotations

from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.unification import substitute
from casper.kb.top_down.solve import Solver


def naive_fixpoint(program: Program) -> dict[Indicator, Relation]:
    """All rows of every stored predicate."""
    relations = {i: Relation(*i, program.given[i]) for stratum in program.strata for i in stratum}
    for stratum in program.strata:
        while any(_apply(program, indicator, relations) for indicator in sorted(stratum)):
            pass
    return relations


def _apply(program: Program, indicator: Indicator, relations: dict[Indicator, Relation]) -> int:
    """Add what the clauses of one predicate derive from what is known; how many rows were new."""
    solver = Solver(relations, program.clauses, budget=10**9)
    found = [substitute(c.head, s).args for c in program.rules[indicator] for s in list(solver.solve(c.body))]
    return sum(relations[indicator].add(row) for row in found)
