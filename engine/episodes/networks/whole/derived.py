"""A derivation as it was found: tasks within tasks down to leaves; as a part of a plan, and as a tree to be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from casper.engine.episodes.networks.items.terms import Env, outward, resolve
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term
from casper.plans.trees.nodes import Action, Node, Task

if TYPE_CHECKING:
    import networkx as nx

Part: TypeAlias = "int | Done"  # a leaf by its number, or a task


class Done(NamedTuple):
    """A task, and what it was done by, in the order of the plan."""

    term: Any
    parts: tuple[Part, ...]


def resolved(task: Done, env: Env) -> Done:
    """With everything bound that the substitution binds."""
    parts = tuple(part if isinstance(part, int) else resolved(part, env) for part in task.parts)
    return Done(resolve(task.term, env), parts)


def as_task(told: Done, actions: Sequence[Action]) -> Task | None:
    """A derivation as a part of a plan, of these actions; None where they are not done in the order of the plan."""
    in_order = iter(range(len(actions)))

    def made(part: Done) -> Task | None:
        children: list[Node] = []
        for each in part.parts:
            if isinstance(each, int):
                child: Node | None = actions[each] if each == next(in_order) else None
            else:
                child = made(each)
            if child is None:
                return None
            children.append(child)
        return Task(outward(part.term), tuple(children))

    return made(told)


def drawn(told: Done, rows: Sequence[tuple[Compound, str, Term | None]]) -> nx.DiGraph:
    """A derivation as a tree (attributes: `plans.trees.tree`); ``rows`` are its leaves: action, status, who does it."""
    import networkx as nx

    tree: nx.DiGraph = nx.DiGraph()

    def grow(part: Part, above: int | None) -> str:
        number = len(tree)
        tree.add_node(number)
        if above is not None:
            tree.add_edge(above, number)
        if isinstance(part, int):
            action, status, by = rows[part]
            node = {"term": term_text(as_term(action)), "name": action.functor, "kind": "action", "leaf": part}
            tree.nodes[number].update(node, by=None if by is None else term_text(by))
        else:
            below = {grow(each, number) for each in part.parts}
            status = "observed" if below == {"observed"} else "unobserved"
            term: Compound = outward(part.term)
            kind = "goal" if above is None else "task"
            tree.nodes[number].update(term=term_text(as_term(term)), name=term.functor, kind=kind, leaf=None, by=None)
        tree.nodes[number].update(status=status, optional=False, rival=None)
        return status

    grow(told, None)
    return tree
