"""Which predicates can be listed: those whose rows all follow from other rows, and are finitely many."""

from __future__ import annotations

from collections.abc import Collection

from casper.kb.program.strata import Groups, Table, circular
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import is_ground, variables_of


def unlisted(table: Table, groups: Groups, least: Collection[Indicator] = ()) -> set[Indicator]:
    """Predicates whose rows cannot all be listed: an unbound head variable, or recursion that builds terms.

    Args:
        groups: those of the table (`kb.program.strata.components_of`).
        least: one row for each key: what grows there is better each time.
    """
    open_ = {i for i, clauses in table.items() if not all(map(is_range_restricted, clauses))}
    growing = {i for i, clauses in table.items() if i not in least and any(map(_grows, clauses))}
    return open_ | (growing & circular(table, groups) if growing else growing)


def _grows(clause: Clause) -> bool:
    """Whether a clause makes a term that stands nowhere else."""
    return _builds(clause.head) or any(map(_computes, clause.body))


def _builds(head: Compound) -> bool:
    return any(isinstance(arg, Compound) and not is_ground(arg) for arg in head.args)


def _computes(literal: Literal) -> bool:
    """Whether a condition can make a term that stands nowhere else: ``N is M + 1``, ``Y = s(X)``."""
    return literal.is_comparison and (literal.atom[0] == "is" or (literal.atom[0] == "=" and _builds(literal.atom)))


def is_range_restricted(clause: Clause) -> bool:
    """Whether positive conditions bind every variable of the head, of the comparisons and of the negations."""
    bound: set[Variable] = set()
    tested: list[Literal] = []
    for literal in clause.body:
        if literal.is_strict or literal.is_comparison:
            tested.append(literal)
        else:
            bound.update(literal.variables())
    grown = bool(tested)
    while grown:
        grown = False
        for literal in tested:
            if literal.is_aggregate and bound.issuperset(literal.strict_variables()) and not literal.binds() <= bound:
                bound |= literal.binds()
                grown = True
            if literal.negated or not literal.is_comparison or literal.atom[0] not in ("=", "is"):
                continue
            left, right = set(variables_of(literal.atom[1])), set(variables_of(literal.atom[2]))
            new = (left if right <= bound else set()) | (right if left <= bound and literal.atom[0] == "=" else set())
            if not new <= bound:
                bound |= new
                grown = True
    needed = set(variables_of(clause.head))
    for literal in tested:
        if literal.is_comparison:
            needed.update(literal.variables())
        elif literal.is_strict:
            needed.update(literal.strict_variables())
    return needed <= bound
