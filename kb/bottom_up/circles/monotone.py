"""Which rules of a recursive minimum never make a worse row of a better premise, so that any order finds the best.

The value of the one recursive condition may go into the head's value as it is, or by way of sums, differences (on the
left), ``min`` and ``max``; and it may be held against a bound that a better value keeps.
"""

from __future__ import annotations

from collections.abc import Set

from casper.kb.errors import NotOnColumns
from casper.kb.program.declarations import Moded
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import variables_of

_KEEPS = {("min", "<"), ("min", "=<"), ("max", ">"), ("max", ">=")}  # mode, and what a better left side keeps
_TURNED = {"<": ">", ">": "<", "=<": ">=", ">=": "=<"}


def check_monotone(rule: Clause, at: int, modes: tuple[Moded, Moded]) -> None:
    """Refuse a rule in which the value of condition ``at`` goes any other way.

    Args:
        modes: of the condition's predicate and of the head's.

    Raises:
        NotOnColumns: so the order in which rows get better may matter.
    """
    (place, mode), (head_place, head_mode) = modes
    value = rule.body[at].atom.args[place]
    others = [arg for c, arg in enumerate(rule.body[at].atom.args) if c != place]
    carriers = {value} if isinstance(value, Variable) else set[Variable]()
    _require(mode == head_mode and bool(carriers) and value not in set(variables_of(*others)), rule)
    size = 0
    while size != len(carriers):  # an expression may stand before what it is made of
        size = len(carriers)
        for literal in rule.body:
            if _assigns(literal) and _uses(literal.atom[2], carriers):
                carriers.add(literal.atom[1])
    for number, literal in enumerate(rule.body):
        _require(number == at or not _uses(literal.atom, carriers) or _is_monotone(literal, carriers, mode), rule)
    defined = [x.atom[1] for x in rule.body if _assigns(x) and x.atom[1] in carriers]
    _require(len(set(defined)) == len(defined) and value not in defined, rule)
    keys = [arg for c, arg in enumerate(rule.head.args) if c != head_place]
    _require(not _uses(Compound(("", *keys)), carriers), rule)


def _assigns(literal: Literal) -> bool:
    """Whether a condition gives a variable the value of an expression."""
    is_plain = literal.is_comparison and literal.atom[0] == "is" and not literal.negated
    return is_plain and isinstance(literal.atom[1], Variable)


def _require(holds: bool, rule: Clause) -> None:
    if not holds:
        raise NotOnColumns(f"better premises need not make better rows in {rule}")


def _is_monotone(literal: Literal, carriers: Set[Variable], mode: str) -> bool:
    if not literal.is_comparison or literal.negated:
        return False
    operator, left, right = literal.atom
    if operator == "is":
        return left in carriers and _rises(right, carriers)
    if not _uses(left, carriers):
        operator, left, right = _TURNED.get(operator, operator), right, left
    return (mode, operator) in _KEEPS and _rises(left, carriers) and not _uses(right, carriers)


def _rises(term: Term, carriers: Set[Variable]) -> bool:
    """Whether an expression never falls where the carriers rise."""
    if isinstance(term, Variable) or not _uses(term, carriers):
        return True
    if term.indicator == ("-", 2):
        return _rises(term[1], carriers) and not _uses(term[2], carriers)
    return term.indicator in (("+", 2), ("min", 2), ("max", 2)) and all(_rises(arg, carriers) for arg in term.args)


def _uses(term: Term, carriers: Set[Variable]) -> bool:
    return not carriers.isdisjoint(variables_of(term))
