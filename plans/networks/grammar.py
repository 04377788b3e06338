"""Productions as methods: what a task is done by, as a network of items, one production at a time.

A method's items are tasks (`Call`), actions, conditions, and `Group`s of these; nothing is looked up in other
productions, so a grammar is as long as its text, whatever it would unroll to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

from casper.kb.errors import Place, PlanError
from casper.kb.terms.clauses import Indicator, Production
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, predication
from casper.kb.terms.unification import renamed
from casper.plans.grammar.conditions import is_condition, relation_of
from casper.plans.grammar.shapes import BY, SHAPES, Order, partial_order, times_of
from casper.plans.grammar.steps import ONLY_NAMES, checked_action, checked_step
from casper.plans.trees.nodes import Action, Condition

Kind: TypeAlias = Literal["sequence", "choice", "optional", "unordered", "steps", "repeat"]


@dataclass(frozen=True, slots=True)
class Call:
    """A task that is to be done, by whichever method fits."""

    term: Compound
    place: Place = field(default=Place(), compare=False)


@dataclass(frozen=True, slots=True)
class Group:
    """Items that are done together.

    ``sequence``: one after the other; ``choice``: one of them; ``optional``: in order, or nothing; ``unordered`` and
    ``steps``: all, in any order that keeps the pairs of ``order`` (item numbers); ``repeat``: the one item, from
    ``least`` to ``most`` times. A sequence without items is nothing to do.
    """

    kind: Kind
    items: tuple[Item, ...]
    order: Order = frozenset()
    least: int = 1
    most: int = 1


Item: TypeAlias = Call | Action | Condition | Group
NOTHING = Group("sequence", ())


@dataclass(frozen=True, slots=True)
class Method:
    """One production: the head it does, and its body."""

    head: Compound
    body: Item
    place: Place


class Grammar:
    """The methods of every task, in the author's order; each production is compiled when it is first needed.

    Args:
        productions: the author's.

    Raises:
        PlanError: what stands in a body is no item (as soon as its method is asked for).
    """

    def __init__(self, productions: Sequence[Production]) -> None:
        self.productions = productions
        self._of: dict[Indicator, list[Production]] = {}
        for production in productions:
            self._of.setdefault(production.head.indicator, []).append(production)
        self._methods: dict[Indicator, tuple[Method, ...]] = {}

    @property
    def tasks(self) -> Sequence[Indicator]:
        """Name and arity of everything that has a production, in the order of the first ones."""
        return list(self._of)

    def __contains__(self, task: Indicator) -> bool:
        return task in self._of

    def methods(self, task: Indicator) -> tuple[Method, ...]:
        """The methods of a task; none for what has no production."""
        found = self._methods.get(task)
        if found is None:
            found = tuple(Method(p.head, self._item(p.body, p.place), p.place) for p in self._of.get(task, ()))
            self._methods[task] = found
        return found

    @cached_property
    def everything(self) -> dict[Indicator, tuple[Method, ...]]:
        """All methods by task."""
        return {task: self.methods(task) for task in self._of}

    def _item(self, item: Term, place: Place) -> Item:
        if item == NIL:
            return NOTHING
        if item == "{}":
            raise PlanError("{} asks nothing: write {Goal}, as in {vessel(V), \\+ at(V, sink)}", place)
        if not isinstance(item, (str, Compound)):
            raise PlanError(f"{term_text(renamed([item], 0)[0])} cannot stand in a plan: {ONLY_NAMES}", place)
        term = predication(item)
        if is_condition(term):
            return Condition(relation_of(term), place)
        if term.indicator in self._of:
            return Call(term, place)
        if term.indicator == BY:
            return checked_step(term, place, self._of.__contains__)
        if term.functor in SHAPES and term.args:
            return self._group(term, place)
        return checked_action(term, place)

    def _group(self, term: Compound, place: Place) -> Item:
        build: Callable[[Term], Item] = lambda item: self._item(item, place)  # noqa: E731
        kind = term.functor
        if kind in ("unordered", "steps"):
            items, order = partial_order(term, place)
            return Group("steps" if order else "unordered", tuple(map(build, items)), order)
        if kind == "repeat":
            item, least, most = times_of(term, place)
            return Group("repeat", (build(item),), frozenset(), least, most)
        kinds: dict[str, Kind] = {",": "sequence", ";": "choice", "optional": "optional"}
        return Group(kinds[kind], tuple(map(build, term.args)))


def items_below(item: Item) -> Iterator[Call | Action | Condition]:
    """The tasks, actions and conditions of an item, from left to right."""
    waiting = [item]
    while waiting:
        found = waiting.pop()
        if isinstance(found, Group):
            waiting.extend(reversed(found.items))
        else:
            yield found
