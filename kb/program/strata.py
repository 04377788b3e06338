"""What needs what: dependents, circles, and strata that put every negation above what it negates."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias, TypeVar

from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Clause, Indicator, Literal, is_auxiliary

Table: TypeAlias = Mapping[Indicator, tuple[Clause, ...]]
Groups: TypeAlias = Sequence[Sequence[Indicator]]  # predicates that need one another, each group after what it needs
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
    """The predicates that clauses need: what is looked up, and what is called by a built-in."""
    for literal in (x for clause in clauses for x in clause.body):
        if literal.needed is not None:
            yield literal.needed
        if literal.called is not None:
            yield literal.called


def circular(table: Table, groups: Groups) -> set[Indicator]:
    """Every defined predicate that needs itself, directly or not.

    Args:
        groups: those of the table (`components_of`).
    """
    circles = (group for group in groups if len(group) > 1 or group[0] in needs(table[group[0]]))
    return {indicator for group in circles for indicator in group}


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


def components_of(table: Table) -> list[list[Indicator]]:
    """The groups of predicates that need one another, each after what it needs."""
    return components({indicator: list(needs(clauses)) for indicator, clauses in table.items()})


def check_least(table: Table, groups: Groups, least: Collection[Indicator]) -> None:
    """Refuse a recursive minimum or maximum whose circle goes through a negation or a predicate that keeps all rows.

    Raises:
        ProgramError: naming the circle.
    """
    for group in groups if least else ():
        moded = [i for i in group if i in least]
        others = [i for i in group if i not in least]
        strict = any(x.is_strict and x.needed in group for i in group for c in table[i] for x in c.body)
        if moded and (others or strict):
            name, arity = moded[0]
            circle = " and ".join(f"{n}/{a}" for n, a in sorted(group) if not is_auxiliary((n, a)))
            sentence = f"{name}/{arity} keeps one row for each key, so its circle may hold nothing else"
            raise ProgramError(f"{sentence}: {circle}")


def levels_of(table: Table, groups: Groups, least: Collection[Indicator] = ()) -> dict[Indicator, int]:
    """The stratum of every predicate: at least that of what it needs, above that of what it negates or counts.

    Where negation runs in a circle, the circle is above all that it needs, and below all that needs it; so is a
    predicate that keeps one row for each key (``least``).

    Raises:
        ProgramError: an aggregate is part of what it is worked out of; the circle is named.
    """
    group_of = {indicator: at for at, group in enumerate(groups) for indicator in group}
    within = list(_within(table, group_of))
    negative = {group_of[i] for i, x in within if x.negated} | {group_of[i] for i in least}
    levels: dict[Indicator, int] = {}
    for at, group in enumerate(groups):  # what a group needs comes before it
        level = 0
        for literal in (x for i in group for clause in table[i] for x in clause.body):
            needed = literal.needed
            if needed is not None and group_of.get(needed, at) != at:
                apart = literal.is_strict or at in negative or group_of[needed] in negative
                level = max(level, levels[needed] + apart)
        levels.update(dict.fromkeys(group, level))
    for indicator, literal in within:
        if literal.is_aggregate:
            names = _circle(table, indicator, literal)
            sentence = f"{literal.atom[0]} is part of what it is worked out of: {names}; break the circle"
            raise ProgramError(sentence, literal.place if literal.place.line else None)
    return levels


def negative_circles(table: Table, groups: Groups) -> list[tuple[frozenset[Indicator], Literal, str]]:
    """The groups of predicates in which negation runs in a circle, each with one such negation and the circle."""
    group_of = {indicator: at for at, group in enumerate(groups) for indicator in group}
    found: dict[int, tuple[Indicator, Literal]] = {}
    for indicator, literal in _within(table, group_of):
        if literal.negated:
            found.setdefault(group_of[indicator], (indicator, literal))
    return [(frozenset(groups[at]), literal, _circle(table, i, literal)) for at, (i, literal) in found.items()]


def _within(table: Table, group_of: Mapping[Indicator, int]) -> Iterator[tuple[Indicator, Literal]]:
    """Every negation and aggregate of something that needs the head in turn, with the head's predicate."""
    for indicator, clauses in table.items():
        for literal in (x for clause in clauses for x in clause.body if x.is_strict):
            if literal.needed is not None and group_of.get(literal.needed) == group_of[indicator]:
                yield indicator, literal


def _circle(table: Table, indicator: Indicator, literal: Literal) -> str:
    """The shortest way from a predicate through its strict condition back to itself, in words."""
    assert literal.needed is not None
    before: dict[Indicator, Indicator] = {}
    waiting = [literal.needed]
    for node in waiting:  # it grows: breadth first
        for other in needs(table.get(node, ())):
            if other not in before and other != literal.needed:
                before[other] = node
                waiting.append(other)
    path = [indicator]
    while path[-1] != literal.needed:
        path.append(before[path[-1]])
    circle = [indicator, *reversed(path)]
    shown = [(at, i) for at, i in enumerate(circle) if at in (0, len(circle) - 1) or not is_auxiliary(i)]
    return " needs ".join(f"{'not ' if at == 1 and literal.negated else ''}{n}/{a}" for at, (n, a) in shown)
