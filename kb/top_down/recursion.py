"""Which recursive predicates are tabled: those whose recursion builds no terms, so that calls are finitely many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from casper.kb.program.strata import needs
from casper.kb.terms.builtins import BUILTINS, KINDS
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground

Table = Mapping[Indicator, Sequence[Clause]]
_CHOOSING = frozenset(  # built-ins that give nothing but what they are given
    {("member", 2), ("memberchk", 2), ("last", 2), ("nth0", 3), ("nth1", 3), ("true", 0), ("fail", 0), ("false", 0)}
    | {(kind, 1) for kind in KINDS}
)


def tabled_of(clauses: Table) -> frozenset[Indicator]:
    """Every predicate that needs itself, in a group of predicates none of whose clauses makes new terms."""
    found: set[Indicator] = set()
    for group in groups(clauses):
        own = [clause for indicator in group for clause in clauses[indicator] if clause.body]
        recurs = any(indicator in group for indicator in needs(own))
        if recurs and not any(_builds(clause, group, clauses) for clause in own):
            found.update(group)
    return frozenset(found)


def _builds(clause: Clause, group: frozenset[Indicator], clauses: Table) -> bool:
    """Whether a rule can make a term that stands nowhere else, in its head or for a recursive call."""
    return _has_open_term(clause.head) or any(_grows(literal, group, clauses) for literal in clause.body)


def _grows(literal: Literal, group: frozenset[Indicator], clauses: Table) -> bool:
    indicator = literal.atom.indicator
    if literal.is_comparison:
        return literal.atom[0] == "is" or (literal.atom[0] == "=" and _has_open_term(literal.atom))
    if indicator in BUILTINS and indicator not in clauses:
        return indicator not in _CHOOSING
    return indicator in group and _has_open_term(literal.atom)


def _has_open_term(atom: Compound) -> bool:
    return any(isinstance(arg, Compound) and not is_ground(arg) for arg in atom.args)


def groups(clauses: Table) -> Iterator[frozenset[Indicator]]:
    """The strongly connected groups of predicates (Tarjan's, on a stack of its own)."""
    needed_by = {indicator: list(needs(found)) for indicator, found in clauses.items()}
    number: dict[Indicator, int] = {}
    low: dict[Indicator, int] = {}
    open_: dict[Indicator, None] = {}
    for root in clauses:
        path: list[tuple[Indicator, Iterator[Indicator]]] = []
        if root not in number:
            _enter(root, needed_by, number, low, open_, path)
        while path:
            indicator, rest = path[-1]
            following = next((i for i in rest if i in clauses), None)
            if following is not None:
                if following not in number:
                    _enter(following, needed_by, number, low, open_, path)
                elif following in open_:
                    low[indicator] = min(low[indicator], number[following])
                continue
            path.pop()
            if path:
                low[path[-1][0]] = min(low[path[-1][0]], low[indicator])
            if low[indicator] == number[indicator]:
                yield frozenset(_closed(indicator, open_))


def _enter(
    indicator: Indicator,
    needed_by: Mapping[Indicator, list[Indicator]],
    number: dict[Indicator, int],
    low: dict[Indicator, int],
    open_: dict[Indicator, None],
    path: list[tuple[Indicator, Iterator[Indicator]]],
) -> None:
    number[indicator] = low[indicator] = len(number)
    open_[indicator] = None
    path.append((indicator, iter(needed_by[indicator])))


def _closed(indicator: Indicator, open_: dict[Indicator, None]) -> Iterator[Indicator]:
    while True:
        last, _ = open_.popitem()
        yield last
        if last == indicator:
            return
