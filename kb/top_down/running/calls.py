"""Calls that are more than a look-up or a clause: tables, built-ins, computed predicates, goals about goals.

Each function gives what is to be done next, or None where the branch fails.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from casper.kb.errors import Undefined
from casper.kb.relations.relation import Row
from casper.kb.terms.terms import Compound
from casper.kb.top_down.compiled.cells import Cell, deref, freeze, thaw, variant
from casper.kb.top_down.compiled.code import STOP, Frame, Node
from casper.kb.top_down.compiled.unifying import unify
from casper.kb.top_down.linking import (
    ASKED,
    BUILT_IN,
    CONTROLLED,
    DOUBTFUL,
    PROVIDED,
    RESOLVED,
    STORED,
    TABLED,
    Computed,
    Link,
)
from casper.kb.top_down.running.clauses import chosen, only, resolved
from casper.kb.top_down.running.engine import Workspace
from casper.kb.top_down.running.goals import goal_state, joined
from casper.kb.top_down.running.readiness import UNDECIDED, goal_is_ready, later, waiting
from casper.kb.top_down.running.stored import doubtful_rows, looked_up
from casper.kb.top_down.running.strands import CLAUSES, VALUES, Choice, Cont, State, Strand
from casper.kb.top_down.running.tables import Consumer, Table


def called(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand) -> State | None:
    """The call of a predicate, by whatever answers it."""
    link = work.links[node.key]
    if link.how != RESOLVED:
        return _CALLS[link.how](work, link, node, frame, cont, doubt, strand)
    args = node.build(frame)
    if node.next is not None:
        cont = (node.next, frame, cont)
    candidates = chosen(link.what, args)
    if len(candidates) == 1:
        return only(work, candidates[0], args, cont, doubt, strand)
    return resolved(work, candidates, 0, args, cont, doubt, strand)


def _after(node: Node, frame: Frame, cont: Cont) -> Cont:
    return cont if node.next is None else (node.next, frame, cont)


def _built_in(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    walked = tuple([deref(arg) for arg in node.build(frame)])
    if not link.what.ready(*walked):
        return waiting(work, node, frame, cont, doubt)
    try:
        outcome = link.what.run(*walked)
    except UNDECIDED as reason:
        return node.next, frame, cont, doubt or reason.sentence
    if outcome is None:
        return None
    if type(outcome) is tuple:
        trail, top = strand.trail, strand.top
        for arg, value in zip(walked, outcome):
            if value is not None and not unify(arg, value, trail, top):
                return None
        return node.next, frame, cont, doubt
    rows = ((values, "") for values in outcome)
    return offered(work, rows, walked, _after(node, frame, cont), doubt, strand)


def offered(
    work: Workspace, rows: Iterator[tuple[Any, str]], args: tuple[Any, ...], cont: Cont, doubt: str, strand: Strand
) -> State | None:
    """Make a choice point of rows of values, each with what makes it doubtful; the branch goes on by taking one."""
    work.serial += 1
    strand.push(Choice(len(strand.trail), work.serial, doubt, VALUES, rows, 0, args, cont))
    return None


def _doubtful(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    args = node.build(frame)
    return offered(work, doubtful_rows(link, args, node.key[0]), args, _after(node, frame, cont), doubt, strand)


def _asked(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    args = node.build(frame)
    atom = Compound((node.key[0], *(freeze(arg, {}, Compound) for arg in args)))
    return offered(work, _answers(link.what, atom), args, _after(node, frame, cont), doubt, strand)


def _provided(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    args = node.build(frame)
    relation = link.what.relation(Compound((node.key[0], *(freeze(arg, {}, Compound) for arg in args))))
    rows = doubtful_rows(Link(DOUBTFUL, relation), args, node.key[0])
    return offered(work, rows, args, _after(node, frame, cont), doubt, strand)


def _answers(computed: Computed, atom: Compound) -> Iterator[tuple[Row, str]]:
    """What a computed predicate gives; after that, where others are undefined, anything, doubtfully."""
    try:
        for answer in computed(atom):
            yield answer.args, ""
    except Undefined as reason:
        yield (None,) * atom.arity, reason.sentence


def _tabled(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    args, cont = node.build(frame), _after(node, frame, cont)
    holes: dict[int, Any] = {}
    frozen = tuple([freeze(arg, holes) for arg in args])
    call, engine = (node.key, variant(frozen)), work.engines[-1]
    table = work.done.get(call)
    if table is not None:
        return offered(work, iter(table.answers), args, cont, doubt, strand) if table.answers else None
    table = engine.tables.get(call)
    if table is None:
        table = engine.tables[call] = Table()
        cells: dict[Any, Cell] = {}
        fresh = tuple([thaw(arg, cells) for arg in frozen])
        sink: Cont = (Node(STOP, node.key, _nothing, None, table), [0, *fresh], None)
        clauses = chosen(link.what, fresh)
        engine.queue.append(Strand.of(Choice(0, 0, "", CLAUSES, clauses, 0, fresh, sink)))
    engine.queue.append(Consumer(table, cont, args, doubt).strand())
    return None


def _nothing(_: Frame) -> tuple[Any, ...]:
    return ()


def _control(
    work: Workspace, link: Link, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand
) -> State | None:
    if isinstance(link.what, bool):
        return (node.next, frame, cont, doubt) if link.what else None
    args = node.build(frame)
    goal = deref(args[0])
    if type(goal) is list:
        return waiting(work, node, frame, cont, doubt)
    if node.next is not None and not goal_is_ready(args, work.links):
        first = later(node, frame, work.links)
        if first is not None:
            return first, frame, cont, doubt
    following = _after(node, frame, cont)
    goal = joined(goal, args[1:]) if node.key[0] == "call" else (node.key[0], goal)
    work.serial += 1
    try:
        return goal_state(goal, following, doubt, strand, work.serial)
    except Undefined as reason:
        return None, _NO_FRAME, following, doubt or reason.sentence


_NO_FRAME: Frame = []
_Call = Callable[[Workspace, Link, Node, Frame, Cont, str, Strand], "State | None"]
_CALLS: dict[int, _Call] = {
    TABLED: _tabled,
    STORED: looked_up,
    DOUBTFUL: _doubtful,
    BUILT_IN: _built_in,
    ASKED: _asked,
    PROVIDED: _provided,
    CONTROLLED: _control,
}
