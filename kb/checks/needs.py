"""What needs what: negation that runs in a circle, and predicates that nothing needs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from difflib import get_close_matches
from typing import TYPE_CHECKING

from casper.kb.checks.finding import Finding, note
from casper.kb.program.strata import components_of, needs
from casper.kb.program.strata import negative_circles as circles_of
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator

if TYPE_CHECKING:
    import networkx as nx


def needs_graph(clauses: Iterable[Clause]) -> nx.DiGraph:
    """An edge from each predicate to every predicate its clauses need; ``never`` stands for the constraints."""
    import networkx as nx

    graph: nx.DiGraph = nx.DiGraph()
    for clause in clauses:
        graph.add_node(clause.head.indicator)
        graph.add_edges_from((clause.head.indicator, other) for other in needs([clause]))
    return graph


def negative_circles(clauses: Collection[Clause]) -> Iterator[Finding]:
    """Every circle that negation runs in, once for each group of predicates: there something may be undefined."""
    found: dict[Indicator, list[Clause]] = {}
    for clause in clauses:
        found.setdefault(clause.head.indicator, []).append(clause)
    table = {indicator: tuple(of_one) for indicator, of_one in found.items()}
    for _, literal, circle in circles_of(table, components_of(table)):
        yield note(literal.place, f"negation runs in a circle: {circle}; what the facts do not settle is undefined")


def unneeded(clauses: Collection[Clause], asked: Collection[Indicator]) -> Iterator[Finding]:
    """Predicates that nothing asked for leads to; told once for each chain, at its top.

    ``asked`` are the predicates that are asked from outside: actions, goals, settings. A text in which nothing is asked
    is a library for others to ask, and nothing in it is unneeded.
    """
    import networkx as nx

    graph = needs_graph(clauses)
    if not any(i in asked for i in graph):
        return
    roots = [i for i in graph if i in asked or i in SYSTEM]
    wanted = set(roots).union(*(nx.descendants(graph, root) for root in roots))
    lonely = graph.subgraph(i for i in graph if i not in wanted)
    tops = nx.condensation(lonely)
    first = {c.head.indicator: c for c in reversed(list(clauses))}
    for top in (node for node, above in tops.in_degree() if above == 0):
        members = [i for i in first if i in tops.nodes[top]["members"]]
        if members:
            name, arity = indicator = min(members, key=lambda i: (first[i].place.file, first[i].place.line))
            sentence = f"nothing needs {name}/{arity}: no plan, no constraint and no other relation leads to it"
            yield note(first[indicator].place, f"{sentence}{_hint(indicator, wanted)}")


def _hint(indicator: Indicator, wanted: Collection[Indicator]) -> str:
    """What may have been meant, if a needed predicate of the same arity has nearly the same name."""
    names = sorted({name for name, arity in wanted if arity == indicator[1] and name != indicator[0]})
    close = get_close_matches(indicator[0], names, n=1, cutoff=0.8)
    return f"; did you mean {close[0]}?" if close else ""
