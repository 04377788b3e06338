"""What needs what: dependents, circles, and strata that put every negation above what it negates."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import TypeAlias, TypeVar

from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Clause, Indicator

Table: TypeAlias = Mapping[Indicator, tuple[Clause, ...]]
Node = TypeVar("Node", bound=Hashable)


def dependents(table: Table, roots: set[Indicator]) -> set[Indicator]:
    """Every defined predicate that needs one of the roots, directly or not."""
    above: dict[Indicator, list[Indicator]] = {}
    for indicator, clauses in table.items():
        for needed in needs(clauses):
            above.setdefault(needed, []).append(indicator)
    reached: set[Indicator] = set()
    waiting = list(roots)
    while waiting:
        new = [i for i in above.get(waiting.pop(), ()) if i not in reached]
        reached.update(new)
        waiting += new
    return reached


def needs(clauses: Iterable[Clause]) -> Iterator[Indicator]:
    """The predicates that clauses need, one for each condition that is looked up."""
    return (x.atom.indicator for clause in clauses for x in clause.body if not x.is_comparison)


def circular(table: Table) -> set[Indicator]:
    """Every defined predicate that needs itself, directly or not."""
    graph = {indicator: list(needs(clauses)) for indicator, clauses in table.items()}
    groups = (group for group in components(graph) if len(group) > 1 or group[0] in graph[group[0]])
    return {indicator for group in groups for indicator in group}


def components(graph: Mapping[Node, Iterable[Node]]) -> list[list[Node]]:
    """The strongly connected components, each after all that it leads to (Tarjan, on a stack of its own).

    Args:
        graph: for every node where it leads to; what is no key of it is left out.
    """
    number: dict[Node, int] = {}
    lowest: dict[Node, int] = {}
    pending: list[Node] = []  # numbered, and in no component yet
    found: list[list[Node]] = []
    for start in graph:
        path = [] if start in number else [_opened(start, graph, number, lowest, pending)]
        while path:
            node, following = path[-1]
            for other in following:
                if other not in number:
                    path.append(_opened(other, graph, number, lowest, pending))
                    break
                if other in lowest:
                    lowest[node] = min(lowest[node], lowest[other])
            else:
                path.pop()
                if path:
                    lowest[path[-1][0]] = min(lowest[path[-1][0]], lowest[node])
                if lowest[node] == number[node]:
                    found.append(_closed(node, lowest, pending))
    return found


def _opened(
    node: Node,
    graph: Mapping[Node, Iterable[Node]],
    number: dict[Node, int],
    lowest: dict[Node, int],
    pending: list[Node],
) -> tuple[Node, Iterator[Node]]:
    number[node] = lowest[node] = len(number)
    pending.append(node)
    return node, (other for other in graph[node] if other in graph)


def _closed(node: Node, lowest: dict[Node, int], pending: list[Node]) -> list[Node]:
    """Take the component that was entered by the node off the pending ones."""
    group: list[Node] = []
    while not group or group[-1] != node:
        group.append(pending.pop())
        del lowest[group[-1]]
    return group


def levels_of(table: Table) -> dict[Indicator, int]:
    """The stratum of every predicate: at least that of what it needs, above that of what it negates."""
    groups = components({indicator: list(needs(clauses)) for indicator, clauses in table.items()})
    group_of = {indicator: at for at, group in enumerate(groups) for indicator in group}
    levels: dict[Indicator, int] = {}
    for at, group in enumerate(groups):  # what a group needs comes before it
        level = 0
        for literal in (x for i in group for clause in table[i] for x in clause.body):
            needed = literal.atom.indicator
            if group_of.get(needed, at) != at:
                level = max(level, levels[needed] + literal.negated)
            elif literal.negated and needed in group_of:
                raise _negative_circle(table, group_of)
        levels.update(dict.fromkeys(group, level))
    return levels


def _negative_circle(table: Table, group_of: Mapping[Indicator, int]) -> ProgramError:
    import networkx as nx  # only a program that is refused needs it

    graph: nx.DiGraph = nx.DiGraph()
    for indicator, clauses in table.items():
        graph.add_edges_from((indicator, needed) for needed in needs(clauses))
    for indicator, clauses in table.items():
        for literal in (x for clause in clauses for x in clause.body if x.negated and not x.is_comparison):
            negated = literal.atom.indicator
            if group_of.get(negated) == group_of[indicator]:
                cycle = [indicator, *nx.shortest_path(graph, negated, indicator)]
                names = " needs ".join(f"{'not ' if at == 1 else ''}{n}/{a}" for at, (n, a) in enumerate(cycle))
                return ProgramError(f"negation runs in a circle: {names}; break it", literal.place)
    raise AssertionError("only a negation within a group is refused")
