"""Which predicates can be listed: those whose rows all follow from other rows, and are finitely many."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from casper.kb.program.strata import circular
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import is_ground, variables_of


def unlisted(table: Mapping[Indicator, tuple[Clause, ...]], least: Collection[Indicator] = ()) -> set[Indicator]:
    """Predicates whose rows cannot all be listed: an unbound head variable, or recursion that builds terms."""
    found = {i for i, clauses in table.items() if not all(is_range_restricted(c) for c in clauses)}
    for indicator in circular(table):
        if indicator in least:
            continue  # one row for each key: what grows there is better each time
        if any(_builds(c.head) or any(_computes(x) for x in c.body) for c in table[indicator]):
            found.add(indicator)
    return found


def _builds(head: Compound) -> bool:
    return any(isinstance(arg, Compound) and not is_ground(arg) for arg in head.args)


def _computes(literal: Literal) -> bool:
    """Whether a condition can make a term that stands nowhere else: ``N is M + 1``, ``Y = s(X)``."""
    return literal.is_comparison and (literal.atom[0] == "is" or (literal.atom[0] == "=" and _builds(literal.atom)))


def is_range_restricted(clause: Clause) -> bool:
    """Whether positive conditions bind every variable of the head, of the comparisons and of the negations."""
    bound: set[Variable] = set()
    for literal in clause.body:
        if not literal.is_strict and not literal.is_comparison:
            bound.update(literal.variables())
    grown = True
    while grown:
        grown = False
        for literal in clause.body:
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
    for literal in clause.body:
        if literal.is_comparison:
            needed.update(literal.variables())
        elif literal.is_strict:
            needed.update(literal.strict_variables())
    return needed <= bound
