"""In which order the conditions of a body are taken: what is known first, then what has the fewest rows.

Where every predicate is a finite relation the order changes nothing but the work; elsewhere it is the author's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Term, Variable
from casper.kb.terms.unification import variables_of

SizeOf = Callable[[Indicator], int]


def ordered(body: Sequence[Literal], known: Iterable[Variable], size_of: SizeOf) -> list[Literal]:
    """The conditions in the order in which they are taken, once the ``known`` variables have values."""
    waiting, found, bound = list(body), list[Literal](), set(known)
    while waiting:
        costs = [estimate(literal, bound, size_of) for literal in waiting]
        literal = waiting.pop(costs.index(min(costs)))
        found.append(literal)
        bound |= binds(literal, bound)
    return found


def estimate(literal: Literal, bound: set[Variable], size_of: SizeOf) -> float:
    """About how many rows a condition gives; infinitely many for one that has to wait."""
    variables = literal.variables()
    if literal.is_comparison and not literal.negated and literal.atom[0] in ("=", "is"):
        left, right = (is_bound(part, bound) for part in literal.atom.args)
        return 0.0 if right or (left and literal.atom[0] == "=") else float("inf")
    if literal.is_comparison or literal.negated:
        return 0.0 if all(v in bound or (literal.negated and v.is_anonymous) for v in variables) else float("inf")
    if literal.is_aggregate:  # what it shares with other conditions has to be known; the rest is its own
        return 0.5 if all(v in bound for v in literal.strict_variables()) else float("inf")
    args = literal.atom.args
    open_ = sum(not is_bound(arg, bound) for arg in args)
    return float(size_of(literal.atom.indicator)) ** (open_ / len(args)) if open_ else 0.5


def is_bound(term: Term, bound: set[Variable]) -> bool:
    """Whether every variable of a term has a value."""
    return all(variable in bound for variable in variables_of(term))


def binds(literal: Literal, bound: set[Variable]) -> set[Variable]:
    """The variables that have a value once the condition holds."""
    if literal.negated or (literal.is_comparison and literal.atom[0] not in ("=", "is")):
        return set()
    if literal.is_comparison and not any(is_bound(part, bound) for part in literal.atom.args):
        return set()
    if literal.is_aggregate:
        return literal.binds()
    return set(literal.variables())
