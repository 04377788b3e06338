"""Spelling a plan out: each choice, each order and each set of optional parts that it allows, as a plan of its own.

Items that no order relates interleave. A task whose actions do not stay together in a row has no node there: its
actions hang from the task above.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

from casper.plans.trees.chart import children_before
from casper.plans.trees.nodes import Action, Condition, Node, Task
from casper.plans.trees.plan import Plan

Row: TypeAlias = tuple[Node, ...]  # nodes without shapes, one after the other


def spelled_out(plan: Plan) -> Iterator[Plan]:
    """Every plain plan that the plan stands for; itself, if it has no shapes."""
    if plan.is_plain:
        yield plan
        return
    for (root,) in _rows(plan.root):
        assert isinstance(root, Task)
        yield Plan(plan.label, root, plan.way, plan.place)


def _rows(node: Node) -> Iterator[Row]:
    """Every row of nodes that a node stands for."""
    if isinstance(node, (Action, Condition)):
        yield (node,)
    elif isinstance(node, Task):
        for rows in _choices(node.children):
            yield (Task(node.term, _joined(rows)),)
    elif node.kind == "choice":
        for child in node.children:
            yield from _rows(child)
    elif node.kind in ("unordered", "steps"):
        before = children_before(node)
        for rows in _choices(node.children):
            yield from _interleaved(rows, before)
    else:
        yield from map(_joined, _choices(node.children))
        if node.kind == "optional":
            yield ()


def _choices(nodes: Sequence[Node]) -> Iterator[tuple[Row, ...]]:
    """Every way to choose a row for each node, one after the other: nothing is listed in advance."""
    if not nodes:
        yield ()
        return
    for row in _rows(nodes[0]):
        for rest in _choices(nodes[1:]):
            yield (row, *rest)


def _joined(rows: Sequence[Row]) -> Row:
    return tuple(node for row in rows for node in row)


def _interleaved(rows: Sequence[Row], before: Sequence[set[int]]) -> Iterator[Row]:
    """Every order of the rows' actions that keeps each row's own, and the rows that come before others."""
    leaves = [[leaf for node in row for leaf in _steps_below(node)] for row in rows]
    done = [0] * len(rows)
    turns: list[int] = []  # which row each action is taken from

    def go_on() -> Iterator[Row]:
        if len(turns) == sum(map(len, leaves)):
            yield _grouped(rows, leaves, turns)
            return
        for at, row in enumerate(leaves):
            if done[at] < len(row) and all(done[other] == len(leaves[other]) for other in before[at]):
                done[at] += 1
                turns.append(at)
                yield from go_on()
                turns.pop()
                done[at] -= 1

    yield from go_on()


def _steps_below(node: Node) -> list[Node]:
    """The node's actions and conditions from left to right."""
    if isinstance(node, (Action, Condition)):
        return [node]
    return [step for child in node.children for step in _steps_below(child)]


def _grouped(rows: Sequence[Row], leaves: Sequence[Sequence[Node]], turns: Sequence[int]) -> Row:
    """The actions in the order of the turns; a row that stays together keeps its nodes."""
    found: list[Node] = []
    taken = [0] * len(rows)
    for at, row in enumerate(turns):
        together = turns[at : at + len(leaves[row])] == [row] * len(leaves[row])
        if taken[row] == 0 and together:
            found.extend(rows[row])
            taken[row] = -1
        elif taken[row] >= 0:
            found.append(leaves[row][taken[row]])
            taken[row] += 1
    return tuple(found)
