"""The parameters of a plan: what becomes of each, and names a person can read for those that stay open."""

from __future__ import annotations

from dataclasses import replace

from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, substitute, variables_of, walk
from casper.plans.trees.nodes import Action, Condition, Node, Shape, Task


def settled(node: Node, bindings: Bindings) -> Node:
    """The tree of a plan with every parameter replaced by what became of it, under its author's name if it is open."""
    return node if _is_settled(node) else _named(node, _Values(bindings))


def called(goal: Compound, head: Compound, actions: tuple[Action, ...]) -> Task | None:
    """A task that is done by nothing but actions, settled as its goal calls it.

    None where that takes unification: the head has a value, or a parameter twice, and the goal is another term.
    """
    if head == goal:
        return Task(goal, actions)
    given = dict(zip(head.args, goal.args))
    if len(given) < head.arity or not all(isinstance(parameter, Variable) for parameter in given):
        return None
    values = _Values({}, given)
    return Task(goal, tuple([Action(values.within(action.term), action.place) for action in actions]))


def with_values(node: Node, bindings: Bindings) -> Node:
    """The tree with what became of its parameters: alternatives may give those of one production different values."""
    if isinstance(node, Action):
        by = None if node.by is None else substitute(node.by, bindings)
        return replace(node, term=substitute(node.term, bindings), by=by)
    if isinstance(node, Condition):
        return replace(node, term=substitute(node.term, bindings))
    children = tuple(with_values(child, bindings) for child in node.children)
    if isinstance(node, Shape):
        return replace(node, children=children)
    return Task(substitute(node.term, bindings), children)


def settles(before: Bindings, after: Bindings, serial: int) -> bool:
    """Whether parameters that were there before (those with a serial number up to this one) were given a value."""
    values = [substitute(v, after) for v in after.keys() - before.keys() if v.serial <= serial]
    fresh = {v for v in values if isinstance(v, Variable) and v.serial > serial}
    return len(fresh) != len(values)


def _is_settled(node: Node) -> bool:
    """Whether the tree has no parameter at all."""
    if not isinstance(node, Shape) and len(node.term) > 1 and not is_ground(node.term):
        return False
    if isinstance(node, Action):
        return node.by is None or is_ground(node.by)
    return isinstance(node, Condition) or all(map(_is_settled, node.children))


def _named(node: Node, values: _Values) -> Node:
    if isinstance(node, Action):
        by = None if node.by is None else values.within(node.by)
        return Action(values.within(node.term), node.place, by)
    if isinstance(node, Condition):
        return Condition(values.within(node.term), node.place)
    if isinstance(node, Shape):
        return Shape(node.kind, tuple([_named(child, values) for child in node.children]), node.order)
    term = values.within(node.term)  # a task's parameters are named before those of what it is done by
    return Task(term, tuple([_named(child, values) for child in node.children]))


class _Values(dict[Variable, Term]):
    """What each parameter of one plan is in the end: some are given, the others worked out when they are first met."""

    def __init__(self, bindings: Bindings, given: Bindings | None = None) -> None:
        super().__init__(given or {})
        self._bindings = bindings
        self._taken = {variable.name for variable in variables_of(*self.values())}

    def __missing__(self, variable: Variable) -> Term:
        value = walk(variable, self._bindings)
        self[variable] = self._fresh_name(variable) if value == variable else self.within(value)
        return self[variable]

    def within(self, term: Term) -> Term:
        """The term with every parameter in it replaced."""
        if isinstance(term, Variable):
            return self[term]
        return Compound([self.within(part) for part in term]) if isinstance(term, Compound) else term

    def _fresh_name(self, variable: Variable) -> Variable:
        """The author's name for the variable, numbered where two different ones share it."""
        base = variable.name
        name, number = base, 1
        while name in self._taken:
            number += 1
            name = f"{base}{number}" if not base.startswith("_#") else f"_#{number}0{base[2:]}"
        self._taken.add(name)
        return Variable(name)
