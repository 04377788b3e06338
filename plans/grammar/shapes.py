"""The shapes that a production's body may have, as text has them (docs/language.md, "Plans").

A choice stands for rows of items, of which one is done: the table `CHOICES`. ``unordered`` and ``steps`` stand for
items that are all done, partly ordered: `partial_order` reads them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from casper.kb.errors import Place, PlanError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, list_items
from casper.kb.terms.unification import renamed

MOST_TIMES = 1000
BY = ("by", 2)  # an action with who does it
Items: TypeAlias = tuple[Term, ...]
Order: TypeAlias = frozenset[tuple[int, int]]
"""Pairs of item numbers of which the first comes before the second."""


def partial_order(term: Compound, place: Place) -> tuple[Items, Order]:
    """The items of ``unordered`` or ``steps`` in an order that they allow, and which must come before which."""
    if term.functor == "unordered":
        return term.args, frozenset()
    items, pairs = _labelled(term, place)
    order = _sorted(items, pairs, place)
    return tuple(items[label] for label in order), frozenset((order[a], order[b]) for a, b in pairs)


def _labelled(term: Compound, place: Place) -> tuple[dict[Term, Term], list[tuple[Term, Term]]]:
    """The items of ``steps`` by label, and its pairs of labels."""
    lists = [list_items(arg) for arg in term.args]
    if [tail for _, tail in lists] != [NIL, NIL] or not lists[0][0]:
        raise PlanError("steps takes a list of labelled items and a list of pairs: steps([a: X, b: Y], [a < b])", place)
    items: dict[Term, Term] = {}
    for entry in lists[0][0]:
        if not (isinstance(entry, Compound) and entry.indicator == (":", 2)):
            shown = term_text(entry, sequences=True)
            raise PlanError(f"{shown} has no label: write it as name: {shown}", place)
        if entry[1] in items:
            raise PlanError(f"two steps are labelled {term_text(entry[1])}", place)
        items[entry[1]] = entry[2]
    pairs = []
    for pair in lists[1][0]:
        if not (isinstance(pair, Compound) and pair.indicator == ("<", 2) and pair[1] in items and pair[2] in items):
            raise PlanError(f"{term_text(pair)} is no pair of step labels: write a < b", place)
        pairs.append((pair[1], pair[2]))
    return items, pairs


def _sorted(items: dict[Term, Term], pairs: list[tuple[Term, Term]], place: Place) -> dict[Term, int]:
    """Each label's number in the first order, as they are written, that keeps the pairs."""
    import networkx as nx  # only plans with partial orders need it

    graph: nx.DiGraph = nx.DiGraph()
    graph.add_nodes_from(items)
    graph.add_edges_from(pairs)
    if not nx.is_directed_acyclic_graph(graph):
        raise PlanError("the order of these steps runs in a circle", place)
    written = {label: at for at, label in enumerate(items)}
    return {label: at for at, label in enumerate(nx.lexicographical_topological_sort(graph, written.__getitem__))}


def _repeat(term: Compound, place: Place) -> Iterator[Items]:
    """As often as must be, and then once more, and once more, as long as it may be."""
    item, least, most = times_of(term, place)
    more: Items = ()
    for _ in range(most - least):
        more = (Compound(("optional", item, *more)),)
    return iter([((item,) * least + more)])


def times_of(term: Compound, place: Place) -> tuple[Term, int, int]:
    """The item of ``repeat``, and how often it is done at least and at most."""
    item, least, most = term.args if term.arity == 3 else (None, None, None)
    if type(least) is not int or type(most) is not int or not 0 <= least <= most or most == 0:
        shown = term_text(renamed([term], 0)[0], sequences=True)
        raise PlanError(f"{shown}: repeat takes an item and two whole numbers: repeat(stir, 1, 3)", place)
    if most > MOST_TIMES:
        raise PlanError(f"repeat does an item at most {MOST_TIMES} times, not {most}", place)
    return item, least, most


CHOICES: dict[str, Callable[[Compound, Place], Iterator[Items]]] = {
    ",": lambda term, _: iter([term.args]),
    ";": lambda term, _: iter([(alternative,) for alternative in term.args]),
    "optional": lambda term, _: iter([term.args, ()]),
    "repeat": _repeat,
}
SHAPES = frozenset({*CHOICES, "unordered", "steps"})


def items_in(body: Term) -> Iterator[Term]:
    """Every item of a production's body, from left to right, through brackets, shapes, alternatives and labels.

    An item is an action, a task, a condition ``{Goal}``, a step ``by(Who, Action)``, or ``[]``.
    """
    waiting = [body]
    while waiting:
        item = waiting.pop()
        if isinstance(item, Compound) and item.indicator == ("steps", 2):
            entries = list_items(item[1])[0]
            waiting.extend(x[2] if isinstance(x, Compound) and x.indicator == (":", 2) else x for x in entries[::-1])
        elif isinstance(item, Compound) and item.functor in SHAPES and item.args:
            times = item.functor == "repeat" and item.arity == 3
            waiting.extend(reversed(item.args[:1] if times else item.args))
        else:
            yield item
