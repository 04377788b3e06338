"""What needs what: dependents, and strata that put every negation above what it negates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Clause, Indicator


def dependents(table: Mapping[Indicator, tuple[Clause, ...]], roots: set[Indicator]) -> set[Indicator]:
    """Every defined predicate that needs one of the roots, directly or not."""
    reached: set[Indicator] = set()
    grown = True
    while grown:
        grown = False
        for indicator, clauses in table.items():
            if indicator not in reached and any(n in roots or n in reached for n in needs(clauses)):
                reached.add(indicator)
                grown = True
    return reached


def needs(clauses: Iterable[Clause]) -> Iterator[Indicator]:
    """The predicates that clauses need, one for each condition that is looked up."""
    return (x.atom.indicator for clause in clauses for x in clause.body if not x.is_comparison)


def levels_of(table: Mapping[Indicator, tuple[Clause, ...]]) -> dict[Indicator, int]:
    """The stratum of every predicate: at least that of what it needs, above that of what it negates."""
    levels = dict.fromkeys(table, 0)
    for _ in range(len(table) + 1):
        changed = False
        for indicator, clauses in table.items():
            for literal in (x for clause in clauses for x in clause.body):
                below = levels.get(literal.atom.indicator)
                if below is not None and levels[indicator] < below + literal.negated:
                    levels[indicator] = below + literal.negated
                    changed = True
        if not changed:
            return levels
    raise _negative_cycle(table)


def _negative_cycle(table: Mapping[Indicator, tuple[Clause, ...]]) -> ProgramError:
    import networkx as nx  # only a program that is refused needs it

    graph: nx.DiGraph = nx.DiGraph()
    for indicator, clauses in table.items():
        graph.add_edges_from((indicator, needed) for needed in needs(clauses))
    for indicator, clauses in table.items():
        for literal in (x for clause in clauses for x in clause.body if x.negated and not x.is_comparison):
            negated = literal.atom.indicator
            if negated in graph and nx.has_path(graph, negated, indicator):
                cycle = [indicator, *nx.shortest_path(graph, negated, indicator)]
                names = " needs ".join(f"{'not ' if at == 1 else ''}{n}/{a}" for at, (n, a) in enumerate(cycle))
                return ProgramError(f"negation runs in a circle: {names}; break it", literal.place)
    raise AssertionError("levels diverge only through a negation")
