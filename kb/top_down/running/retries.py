"""Going back: what a choice point gives next."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.terms.values.effort import charge
from casper.kb.top_down.compiled.cells import Cell, inward, thaw, undo
from casper.kb.top_down.compiled.code import CALL
from casper.kb.top_down.compiled.unifying import unify
from casper.kb.top_down.running.clauses import resolved
from casper.kb.top_down.running.engine import Workspace
from casper.kb.top_down.running.goals import next_branch, node_for
from casper.kb.top_down.running.stored import next_row
from casper.kb.top_down.running.strands import ANSWERS, BRANCHES, CLAUSES, ROWS, VALUES, Choice, State, Strand
from casper.kb.top_down.running.tables import Consumer


def retried(work: Workspace, strand: Strand) -> State | None:
    """What the newest choice point gives next; None where that fails (and where it is used up, it is gone)."""
    choice = strand.choices[-1]
    trail = strand.trail
    if len(trail) > choice.mark:
        undo(trail, choice.mark)
    if choice.kind == CLAUSES:
        strand.pop()
        return resolved(work, choice.what, choice.at, choice.args, choice.cont, choice.doubt, strand)
    return _RETRIES[choice.kind](work, choice, strand)


_FAIL = node_for(CALL, "fail", 0)  # a step: none of endlessly many values may fit


def _next_values(work: Workspace, choice: Choice, strand: Strand) -> State | None:
    found = next(choice.what, None)
    if found is None:
        strand.pop()
        return None
    values, doubt = found
    cells: dict[Any, Cell] = {}
    trail, top = strand.trail, choice.serial
    for arg, value in zip(choice.args, values):
        if value is not None and not unify(arg, inward(value, cells, work.serial), trail, top):
            charge(32 * len(cells))
            return _FAIL, [], choice.cont, ""
    charge(32 * len(cells))  # values with many open parts are work, too
    return None, [], choice.cont, choice.doubt or doubt


def _next_answer(work: Workspace, choice: Choice, strand: Strand) -> State | None:
    consumer: Consumer = choice.what
    found = consumer.next()
    if found is None:
        strand.pop()
        return None
    row, doubt = found
    cont, args = consumer.saved.revived(work.serial)
    cells: dict[Any, Cell] = {}
    for arg, value in zip(args, row):
        if not unify(arg, thaw(value, cells, work.serial), strand.trail, choice.serial):
            return None
    return None, [], cont, consumer.doubt or doubt


_RETRIES: dict[int, Callable[[Workspace, Choice, Strand], State | None]] = {
    ROWS: next_row,
    VALUES: _next_values,
    BRANCHES: next_branch,
    ANSWERS: _next_answer,
}
