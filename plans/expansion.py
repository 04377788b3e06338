"""From grammar to plans: every choice among alternatives, with parameters flowing through unification.

Shapes in a body: ``(X ; Y)`` is a choice, ``optional(X)`` is X or nothing, ``unordered(X, Y, …)`` any order of its
arguments, ``steps([a: X, b: Y, …], [a < b, …])`` any order that keeps the stated pairs. Each stands for the
alternatives it allows, so a library with many of them is bounded by ``most_plans``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations
from typing import TypeAlias

from casper.kb.clauses import Literal, Production
from casper.kb.errors import Place, PlanError
from casper.kb.terms import (
    NIL,
    Bindings,
    Compound,
    Term,
    Variable,
    as_term,
    list_items,
    predication,
    renamed,
    substitute,
    unify,
)
from casper.kb.writer import term_text
from casper.plans.plan import Action, Node, Plan, Task

MOST_PLANS = 100_000
Items: TypeAlias = tuple[Term, ...]
_ONLY_NAMES = "an item of a plan is an action or a task, such as wash(Plate, sink)"


def expand(
    goals: Sequence[tuple[Compound, Place]], productions: Sequence[Production], most_plans: int = MOST_PLANS
) -> Iterator[Plan]:
    """Every plan of every goal, in the author's order.

    Raises:
        PlanError: see `casper.plans.library.PlanLibrary.plans`.
    """
    grammar = _Grammar(productions)
    labels = _labels([goal for goal, _ in goals])
    total = 0
    for (goal, place), label in zip(goals, labels):
        if goal.indicator not in grammar.methods:
            raise PlanError(f"the goal {term_text(as_term(goal))} has no production: write {goal.functor} --> …", place)
        way = 0
        for node, bindings in grammar.task(goal, {}, (), place):
            root = _settled(node, bindings)
            assert isinstance(root, Task)
            if not Plan(label, root).leaves:
                raise PlanError(f"a plan of {label} has no action at all", place)
            yield Plan(label, root, way, place)
            way, total = way + 1, total + 1
            if total > most_plans:
                raise PlanError(f"the library has more than {most_plans} plans; {label} alone has {way}", place)
        if not way:
            raise PlanError(f"no choice of productions completes the goal {label}: their parameters disagree", place)


def _labels(goals: Sequence[Compound]) -> list[str]:
    names = [goal.functor for goal in goals]
    return [g.functor if names.count(g.functor) == 1 else term_text(as_term(g)) for g in goals]


def _settled(node: Node, bindings: Bindings) -> Node:
    """The tree with every parameter replaced by what became of it, under names a person can read."""
    names: dict[Variable, Variable] = {}
    taken: set[str] = set()

    def name(term: Term) -> Term:
        if isinstance(term, Variable):
            if term not in names:
                names[term] = _fresh_name(term, taken)
            return names[term]
        return Compound([name(part) for part in term]) if isinstance(term, Compound) else term

    def settle(node: Node) -> Node:
        term = name(substitute(node.term, bindings))
        if isinstance(node, Action):
            return Action(term, node.place)
        return Task(term, tuple(settle(child) for child in node.children))

    return settle(node)


def _fresh_name(variable: Variable, taken: set[str]) -> Variable:
    """The author's name for the variable, numbered where two different ones share it."""
    base = variable.name
    name, number = base, 1
    while name in taken:
        number += 1
        name = f"{base}{number}" if not base.startswith("_#") else f"_#{number}0{base[2:]}"
    taken.add(name)
    return Variable(name)


Ways: TypeAlias = Iterator[tuple[tuple[Node, ...], Bindings]]


@dataclass
class _Grammar:
    """Productions by the task they produce, and the expansion of bodies."""

    methods: dict[tuple[str, int], list[Production]]

    def __init__(self, productions: Sequence[Production]) -> None:
        self.methods = {}
        self.serial = 0
        for production in productions:
            self.methods.setdefault(production.head.indicator, []).append(production)

    def task(
        self, term: Compound, bindings: Bindings, above: tuple[Compound, ...], place: Place
    ) -> Iterator[tuple[Task, Bindings]]:
        """Every way to do a task: its productions in order, each with every choice inside."""
        if any(term.indicator == other.indicator for other in above):
            circle = " needs ".join(str(t.functor) for t in (*above, term))
            raise PlanError(f"the task {term.functor} contains itself ({circle}); a plan must end", place)
        found = False
        for production in self.methods[term.indicator]:
            self.serial += 1
            head, body = renamed([production.head, production.body], self.serial)
            extended = unify(term, head, bindings)
            if extended is not None:
                found = True
                for children, result in self.item(body, extended, (*above, term), production.place):
                    yield Task(term, children), result
        if not found and not above:
            raise PlanError(f"no production fits the goal {term_text(as_term(term))}", place)

    def item(self, item: Term, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Ways:
        """Every way to do one item of a body."""
        if not isinstance(item, (str, Compound)):
            raise PlanError(f"{term_text(renamed([item], 0)[0])} cannot stand in a plan: {_ONLY_NAMES}", place)
        term = predication(item)
        shape = SHAPES.get(term.functor) if term.indicator not in self.methods else None
        if shape is not None and term.args:
            for sequence in shape(term, place):
                yield from self.sequence(sequence, bindings, above, place)
        elif term.indicator in self.methods:
            for task, extended in self.task(term, bindings, above, place):
                yield (task,), extended
        else:
            _check_action(term, place)
            yield (Action(term, place),), bindings

    def sequence(self, items: Items, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Ways:
        """Every way to do the items one after the other."""
        if not items:
            yield (), bindings
            return
        for first, extended in self.item(items[0], bindings, above, place):
            for rest, result in self.sequence(items[1:], extended, above, place):
                yield (*first, *rest), result


def _check_action(term: Compound, place: Place) -> None:
    named = term.functor[:1].isalpha() or term.functor[:1] == "_"
    if not named or Literal(term).is_comparison:
        shown = term_text(renamed([as_term(term)], 0)[0])
        raise PlanError(f"{shown} cannot stand in a plan: {_ONLY_NAMES}", place)


def _steps(term: Compound, place: Place) -> Iterator[Items]:
    """Every order of labelled steps that keeps the stated pairs."""
    import networkx as nx  # only plans with partial orders need it

    lists = [list_items(arg) for arg in term.args]
    if [tail for _, tail in lists] != [NIL, NIL] or not lists[0][0]:
        raise PlanError("steps takes a list of labelled items and a list of pairs: steps([a: X, b: Y], [a < b])", place)
    labelled, ordered = lists[0][0], lists[1][0]
    items: dict[Term, Term] = {}
    for entry in labelled:
        if not (isinstance(entry, Compound) and entry.indicator == (":", 2)):
            raise PlanError(f"{term_text(entry)} has no label: write it as name: {term_text(entry)}", place)
        if entry[1] in items:
            raise PlanError(f"two steps are labelled {term_text(entry[1])}", place)
        items[entry[1]] = entry[2]
    graph: nx.DiGraph = nx.DiGraph()
    graph.add_nodes_from(items)
    for pair in ordered:
        if not (isinstance(pair, Compound) and pair.indicator == ("<", 2) and pair[1] in items and pair[2] in items):
            raise PlanError(f"{term_text(pair)} is no pair of step labels: write a < b", place)
        graph.add_edge(pair[1], pair[2])
    if not nx.is_directed_acyclic_graph(graph):
        raise PlanError("the order of these steps runs in a circle", place)
    for order in nx.all_topological_sorts(graph):
        yield tuple(items[label] for label in order)


SHAPES: dict[str, Callable[[Compound, Place], Iterator[Items]]] = {
    ",": lambda term, _: iter([term.args]),
    ";": lambda term, _: iter([(alternative,) for alternative in term.args]),
    "optional": lambda term, _: iter([term.args, ()]),
    "unordered": lambda term, _: (tuple(order) for order in permutations(term.args)),
    "steps": _steps,
}
