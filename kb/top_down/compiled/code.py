"""Clauses compiled for the machine: closures that match a head, and a chain of nodes for the body.

A clause runs in a frame ``[stamp, argument…, variable…]``. A variable that is an argument by itself lives in the
argument's slot, so most heads have nothing to match. Nodes are linked by what comes next in the author's order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from operator import itemgetter
from typing import Any, TypeAlias

from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import is_ground, variables_of
from casper.kb.top_down.compiled.cells import deref
from casper.kb.top_down.compiled.heads import Matcher, instance, is_deep, matchers

Frame: TypeAlias = list[Any]
Build: TypeAlias = Callable[[Frame], Any]
Slots: TypeAlias = dict[Variable, int]
Pattern: TypeAlias = tuple[bool, ...]  # which arguments are known

CALL, COMPARE, NEGATE, AGGREGATE, STOP = range(5)


class Node:
    """One condition of a body, and what comes after it.

    Attributes:
        kind: CALL, COMPARE (a test on values), NEGATE, AGGREGATE or STOP (what an answer of a goal goes to).
        key: the predicate; of a comparison, its operator in front.
        build: the arguments' terms, out of a frame.
        next: the node after it, None at the end of the body.
        literal: what it was compiled from.
        own: slots of a negation's or aggregate's own wildcards, which may stay open.
        sink: of a STOP, whose answer it is.
    """

    __slots__ = ("build", "key", "kind", "literal", "negated", "next", "orders", "own", "sink")

    def __init__(
        self, kind: int, key: Indicator, build: Build, literal: Literal | None = None, sink: Any = None
    ) -> None:
        self.kind, self.key, self.build, self.literal, self.sink = kind, key, build, literal, sink
        self.negated = literal is not None and literal.negated
        self.next: Node | None = None
        self.own: tuple[int, ...] = ()
        self.orders: dict[int, Node] = {}

    def before(self, following: Node | None) -> Node:
        """The same condition with something else after it."""
        copy = Node(self.kind, self.key, self.build, self.literal, self.sink)
        copy.own, copy.next = self.own, following
        return copy

    def chain(self) -> list[Node]:
        """This node and all after it."""
        found, node = [], self
        while node is not None:
            found.append(node)
            node = node.next  # type: ignore[assignment]
        return found

    def starting_with(self, at: int) -> Node:
        """The chain from here, its ``at``-th node moved to the front (compiled once)."""
        found = self.orders.get(at)
        if found is None:
            nodes = self.chain()
            found = self.orders[at] = linked([nodes[at], *nodes[:at], *nodes[at + 1 :]])
        return found


def linked(nodes: Sequence[Node]) -> Node:
    """Copies of the nodes, each before the next."""
    following: Node | None = None
    for node in reversed(nodes):
        following = node.before(following)
    assert following is not None
    return following


class CompiledClause:
    """A clause: what its head asks of the arguments, and its body."""

    __slots__ = ("blank", "body", "clause", "fresh", "matchers")

    def __init__(self, clause: Clause, body: Sequence[Literal] | None = None) -> None:
        self.clause = clause
        slots: Slots = {}
        args = clause.head.args
        for at, arg in enumerate(args, 1):
            if isinstance(arg, Variable):
                slots.setdefault(arg, at)
        in_arguments = set(slots)
        for variable in clause.variables():
            slots.setdefault(variable, 1 + len(args) + len(slots) - len(in_arguments))
        self.matchers: tuple[Matcher, ...] = matchers(args, slots, in_arguments)
        in_head = set(variables_of(*args))
        self.blank = (None,) * (len(slots) - len(in_arguments))
        self.fresh = tuple(slot for variable, slot in slots.items() if variable not in in_head)
        nodes = [node_of(literal, slots) for literal in (clause.body if body is None else body)]
        self.body: Node | None = linked(nodes) if nodes else None


def node_of(literal: Literal, slots: Slots, bound: Mapping[Variable, object] | None = None) -> Node:
    """A condition compiled; wildcards in ``bound`` are somebody else's by now."""
    node = Node(_kind(literal), literal.atom.indicator, builder(literal.atom.args, slots), literal)
    if literal.is_strict:
        inside = variables_of(literal.atom[2] if literal.is_aggregate else literal.atom)
        wild = (v for v in inside if v.is_anonymous and v not in (bound or ()))
        node.own = tuple(slots[v] for v in wild)
    return node


def _kind(literal: Literal) -> int:
    if literal.is_comparison:
        return COMPARE
    return AGGREGATE if literal.is_aggregate else NEGATE if literal.negated else CALL


def builder(args: Sequence[Term], slots: Slots) -> Build:
    """A function from a frame to the tuple of the arguments."""
    if len(args) > 1 and all(isinstance(arg, Variable) for arg in args):
        return itemgetter(*(slots[arg] for arg in args))
    parts = [_part(arg, slots) for arg in args]
    if len(parts) == 1:
        (only,) = parts
        return lambda frame: (only(frame),)
    if len(parts) == 2:
        first, second = parts
        return lambda frame: (first(frame), second(frame))
    if len(parts) == 3:
        one, two, three = parts
        return lambda frame: (one(frame), two(frame), three(frame))
    return lambda frame: tuple([part(frame) for part in parts])


def _part(term: Term, slots: Slots) -> Build:
    if isinstance(term, Variable):
        return itemgetter(slots[term])
    if not isinstance(term, Compound) or is_ground(term):
        return lambda frame: term
    if is_deep(term):
        return lambda frame: instance(term, slots, frame)
    if len(term) == 3:
        name, left, right = term[0], _part(term[1], slots), _part(term[2], slots)

        def build(frame: Frame) -> Any:
            one, two = left(frame), right(frame)
            open_ = type(one) is list or type(one) is tuple or type(two) is list or type(two) is tuple
            return (name, one, two) if open_ else Compound((name, one, two))

        return build
    parts = [_part(part, slots) for part in term]
    return lambda frame: _built([part(frame) for part in parts])


def _built(parts: list[Any]) -> Any:
    """A compound term: known to be ground where all its parts are, so that nobody looks for a cell in it."""
    open_ = any(type(part) is list or type(part) is tuple for part in parts)
    return tuple(parts) if open_ else Compound(parts)


class Procedure:
    """The clauses of one predicate, found by what their first argument can be."""

    __slots__ = ("all", "constants", "fitted", "open", "patterns", "structures")

    def __init__(self, clauses: Sequence[CompiledClause], arity: int) -> None:
        self.fitted: Callable[[Pattern], Procedure] | None = None  # the same with bodies ordered for what is known
        self.patterns: dict[Pattern, Procedure] = {}
        self.all = tuple(clauses)
        self.open: tuple[CompiledClause, ...] = self.all
        self.constants: dict[Term, tuple[CompiledClause, ...]] = {}
        self.structures: dict[Term, tuple[CompiledClause, ...]] = {}
        if arity:
            self._index([clause.clause.head[1] for clause in clauses])

    def fitting(self, args: tuple[Any, ...], fitted: Callable[[Pattern], Procedure]) -> Procedure:
        """The procedure whose bodies are ordered (by ``fitted``) for what is known of a call's arguments."""
        pattern = tuple([type(deref(arg)) is not list for arg in args])
        found = self.patterns.get(pattern)
        if found is None:
            found = self.patterns[pattern] = fitted(pattern)
        return found

    def _index(self, firsts: Sequence[Term]) -> None:
        self.open = tuple(c for c, first in zip(self.all, firsts) if isinstance(first, Variable))
        table: dict[tuple[bool, Term], list[CompiledClause]] = {}
        waiting: list[CompiledClause] = []
        for clause, first in zip(self.all, firsts):
            if isinstance(first, Variable):
                waiting.append(clause)
                for found in table.values():
                    found.append(clause)
            else:
                is_structure = isinstance(first, tuple)
                key = (is_structure, first[0] if is_structure else first)
                table.setdefault(key, list(waiting)).append(clause)
        for (is_structure, name), found in table.items():
            (self.structures if is_structure else self.constants)[name] = tuple(found)
