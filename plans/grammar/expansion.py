"""From grammar to plans: parameters flow through unification, and what does not depend on them stays open.

Shapes in a body: ``(X ; Y)`` is a choice, ``optional(X)`` is X or nothing, ``unordered(X, Y, …)`` any order of its
arguments, ``steps([a: X, b: Y, …], [a < b, …])`` any order that keeps the stated pairs, ``repeat(X, Min, Max)`` X
from Min to Max times, ``{Goal}`` a condition, ``[]`` nothing to do, ``by(Who, X)`` the action X with who does it.
Shapes, and the productions of a task, are kept in the plan as `Shape` nodes
(`plans.trees.spelling` spells them out). Only alternatives that settle a parameter of what surrounds them make plans of
their own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Literal as OneOf
from typing import TypeAlias

from casper.kb.errors import Place, PlanError
from casper.kb.terms.clauses import Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, as_term, predication
from casper.kb.terms.unification import Bindings, is_ground, renamed, unify
from casper.plans.grammar.conditions import is_condition, relation_of
from casper.plans.grammar.naming import called, settled, settles, with_values
from casper.plans.grammar.shapes import BY, CHOICES, SHAPES, Items, partial_order
from casper.plans.grammar.steps import NO_ACTIONS, ONLY_NAMES, checked_action, checked_step
from casper.plans.trees.nodes import Action, Condition, Node, Shape, Task, conditions_below, is_hollow
from casper.plans.trees.plan import Plan


class Unlisted(PlanError):
    """Plans that have no end, or are too many to be listed: they are read as the grammar they are, if at all."""


MOST_PLANS = 100_000
MOST_ITEMS = 20_000  # of one goal, with everything it may be done by
MOST_WORK = 200_000  # items of all goals together, and fifty for each production: then nothing is listed
_LOWER = "lower the bound of its recursion or repetition, or give the goal fewer choices"


def expand(
    goals: Sequence[tuple[Compound, Place]],
    productions: Sequence[Production],
    most_plans: int = MOST_PLANS,
    *,
    recursion: int = 0,
) -> Iterator[Plan]:
    """Every plan of every goal, in the author's order.

    Args:
        goals: the goals, with the places that state them.
        productions: the grammar.
        most_plans: the largest library there may be.
        recursion: how often a task may stand inside itself; deeper choices are left out.

    Raises:
        PlanError: see `casper.plans.library.PlanLibrary.plans`.
    """
    grammar = _Grammar(productions, recursion)
    total = 0
    for (goal, place), label in zip(goals, labels([goal for goal, _ in goals])):
        if goal.indicator not in grammar.methods:
            raise PlanError(f"the goal {term_text(as_term(goal))} has no production: write {goal.functor} --> …", place)
        way = 0
        for root in _roots(grammar, goal, place):
            if is_hollow(root) and conditions_below(root):
                continue  # where nothing is to be done there is nothing to be seen
            if _can_be_empty(root):
                raise PlanError(f"a plan of {label} has no action at all", place)
            yield Plan(label, root, way, place)
            way, total = way + 1, total + 1
            if total > most_plans:
                raise Unlisted(f"the library has more than {most_plans} plans; {label} alone has {way}", place)
        if not way:
            raise PlanError(f"no choice of productions completes the goal {label}: their parameters disagree", place)


def _roots(grammar: _Grammar, goal: Compound, place: Place) -> Iterator[Task]:
    grammar.items = 0
    try:
        plain = grammar.plain(goal)
        if plain is not None:
            yield plain
            return
        for node, bindings in grammar.task(goal, {}, (), place):
            root = settled(node, bindings)
            assert isinstance(root, Task)
            yield root
    except RecursionError:
        raise Unlisted(f"the plans of {goal.functor} are nested too deeply; {_LOWER}", place) from None


def labels(goals: Sequence[Compound]) -> list[str]:
    """What each goal is called: its name, or the whole term where several share the name."""
    names = Counter(goal.functor for goal in goals)
    return [g.functor if names[g.functor] == 1 else term_text(as_term(g)) for g in goals]


def _can_be_empty(node: Node) -> bool:
    if isinstance(node, (Action, Condition)):
        return isinstance(node, Condition)
    kind = node.kind if isinstance(node, Shape) else "sequence"
    return kind == "optional" or (any if kind == "choice" else all)(map(_can_be_empty, node.children))


Way: TypeAlias = tuple[tuple[Node, ...], Bindings]  # what is done in order, and what is known then
Ways: TypeAlias = Iterator[Way]


class _Grammar:
    """Productions by the task they produce, and the expansion of bodies."""

    def __init__(self, productions: Sequence[Production], recursion: int = 0) -> None:
        self.methods: dict[tuple[str, int], list[Production]] = {}
        self.serial = self.items = 0
        self.recursion = recursion
        self.work = MOST_WORK + 50 * len(productions)
        self.actions: set[tuple[Term, int]] = set()  # those that were looked at, by name and length
        for production in productions:
            self.methods.setdefault(production.head.indicator, []).append(production)

    def plain(self, goal: Compound) -> Task | None:
        """The plan of a goal whose one production lists nothing but actions, as most do in large libraries.

        It needs no unification. None for any other goal: `task` does all of them, and these the same.
        """
        production, *others = self.methods[goal.indicator]
        if others:
            return None
        body = production.body
        items = body[1:] if isinstance(body, Compound) and body[0] == "," else (body,)
        actions = self.leading_actions(items, production.place)
        return called(goal, production.head, actions) if len(actions) == len(items) else None

    def task(
        self, term: Compound, bindings: Bindings, above: tuple[Compound, ...], place: Place
    ) -> Iterator[tuple[Task, Bindings]]:
        """Every way to do a task: its productions in order, those together that settle no parameter outside of it."""
        inside = sum(term.indicator == other.indicator for other in above)
        if inside > self.recursion > 0:
            return
        if inside > self.recursion:
            circle = " needs ".join(str(t.functor) for t in (*above, term))
            raise Unlisted(f"the task {term.functor} contains itself ({circle}), so its plans are not listed", place)
        serial, ways, fits = self.serial, list[Way](), False
        for production in self.methods[term.indicator]:
            head, body = production.head, production.body
            if not (is_ground(head) and is_ground(body)):
                self.serial += 1
                head, body = renamed([head, body], self.serial)
            extended = unify(head, term, bindings)  # this way round the goal keeps its parameters' names
            if extended is not None:
                fits = True
                ways.extend(self.item(body, extended, (*above, term), production.place))
        for children, result in _together(ways, bindings, serial):
            yield Task(term, children), result
        if not fits and not above:
            raise PlanError(f"no production fits the goal {term_text(as_term(term))}", place)

    def item(self, item: Term, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Ways:
        """Every way to do one item of a body."""
        if not isinstance(item, (str, Compound)):
            raise PlanError(f"{term_text(renamed([item], 0)[0])} cannot stand in a plan: {ONLY_NAMES}", place)
        term = predication(item)
        self.count(place)
        if item == NIL:
            yield (), bindings
        elif item == "{}":
            raise PlanError("{} asks nothing: write {Goal}, as in {vessel(V), \\+ at(V, sink)}", place)
        elif is_condition(item):
            yield (Condition(relation_of(term), place),), bindings
        elif term.indicator == BY and BY not in self.methods:
            yield (checked_step(term, place, self.methods.__contains__),), bindings
        elif term.functor in SHAPES and term.args and term.indicator not in self.methods:
            yield from self.shape(term, bindings, above, place)
        elif term.indicator in self.methods:
            for task, extended in self.task(term, bindings, above, place):
                yield (task,), extended
        else:
            yield (checked_action(term, place),), bindings

    def count(self, place: Place) -> None:
        """One item more of the goal; no goal may have too many."""
        self.items += 1
        if self.items > MOST_ITEMS:
            raise Unlisted(f"a goal has more than {MOST_ITEMS} steps with all its choices; {_LOWER}", place)
        self.work -= 1
        if self.work < 0:
            raise Unlisted("all goals together have too many steps with all their choices", place)

    def shape(self, term: Compound, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Ways:
        """Every way to do what stands in a shape."""
        if term.functor not in CHOICES:
            kind: OneOf["unordered", "steps"] = "steps" if term.functor == "steps" else "unordered"
            items, order = partial_order(term, place)
            for children, extended in self.sequence(items, bindings, above, place, self.wrapped):
                yield (Shape(kind, children, order),), extended
            return
        part = self.optional(term, bindings, above, place) if term.functor == "optional" else None
        if part is not None:
            yield part
            return
        serial = self.serial
        rows = CHOICES[term.functor](term, place)
        ways = [way for items in rows for way in self.sequence(items, bindings, above, place)]
        yield from _together(ways, bindings, serial) if term.functor == ";" else ways

    def optional(self, term: Compound, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Way | None:
        """An optional part as a node of the plan; None where it is a choice."""
        serial = self.serial
        ways = list(islice(self.sequence(term.args, bindings, above, place), 2))
        if len(ways) != 1 or settles(bindings, ways[0][1], serial):
            return None
        return (Shape("optional", ways[0][0]),), ways[0][1]

    def wrapped(self, item: Term, bindings: Bindings, above: tuple[Compound, ...], place: Place) -> Ways:
        """Every way to do one item, as exactly one node."""
        for nodes, extended in self.item(item, bindings, above, place):
            yield (_one(nodes),), extended

    def sequence(
        self,
        items: Items,
        bindings: Bindings,
        above: tuple[Compound, ...],
        place: Place,
        single: Callable[[Term, Bindings, tuple[Compound, ...], Place], Ways] | None = None,
    ) -> Ways:
        """Every way to do the items one after the other; ``single`` does one of them (by default `item`)."""
        actions = self.leading_actions(items, place)
        items = items[len(actions) :]
        if not items:
            yield actions, bindings
            return
        for first, extended in (single or self.item)(items[0], bindings, above, place):
            for rest, result in self.sequence(items[1:], extended, above, place, single):
                yield (*actions, *first, *rest), result

    def leading_actions(self, items: Items, place: Place) -> tuple[Action, ...]:
        """The items up to the first that is no plain action: nothing is to be chosen there."""
        actions = []
        for item in items:
            self.count(place)
            term = Compound((item,)) if isinstance(item, str) else item
            if not (isinstance(term, Compound) and self.is_action(term, place)):
                break
            actions.append(Action(term, place))
        return tuple(actions)

    def is_action(self, term: Compound, place: Place) -> bool:
        """Whether an item is an action: large libraries have few names, each is looked at once."""
        name = term[0], len(term)
        if name not in self.actions:
            if term.indicator in self.methods or term[0] in SHAPES or term[0] in NO_ACTIONS:
                return False
            checked_action(term, place)
            self.actions.add(name)
        return True


def _one(nodes: tuple[Node, ...]) -> Node:
    return nodes[0] if len(nodes) == 1 else Shape("sequence", nodes)


def _together(ways: Sequence[Way], before: Bindings, serial: int) -> Ways:
    """The ways as alternatives of one choice, but for those that say something of parameters that were there before."""
    free = [
        way for way in ways
        if not any(v.serial <= serial for v in way[1].keys() - before.keys()) and not _is_asked_alone(way[0])
    ]  # fmt: skip
    if len(free) < 2:
        yield from ways
        return
    choice = _choice([with_values(_one(nodes), bindings) for nodes, bindings in free])
    at = next(at for at, way in enumerate(ways) if way is free[0])
    yield from ways[:at]
    yield (() if is_hollow(choice) else (choice,)), before
    yield from (way for way in ways[at:] if not any(way is other for other in free))


def _choice(ways: Sequence[Node]) -> Node:
    """One of the ways is done; with one in which there is nothing to do, it is one of the others or nothing."""
    full = tuple(way for way in ways if not is_hollow(way))
    if not full:
        return Shape("sequence", ())
    choice = Shape("choice", full) if len(full) > 1 else full[0]
    return choice if len(full) == len(ways) else Shape("optional", (choice,))


def _is_asked_alone(nodes: Sequence[Node]) -> bool:
    """Whether nothing is done there but to ask: whether it is done cannot be seen, so it is a way of its own."""
    return all(map(is_hollow, nodes)) and any(map(conditions_below, nodes))
