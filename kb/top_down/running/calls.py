"""Calls that are more than a look-up or a clause: tables, built-ins, goals about goals, negation.

Each function gives what is to be done next, or None where the branch fails.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound
from casper.kb.top_down.builtins.control import REFUTED
from casper.kb.top_down.compiled.cells import (
    Cell,
    Trail,
    deref,
    freeze,
    frozen_is_ground,
    inward,
    thaw,
    undo,
    unify,
    variant,
)
from casper.kb.top_down.compiled.code import NEGATE, STOP, Frame, Node, Procedure
from casper.kb.top_down.linking import ASKED, BUILT_IN, STORED, TABLED, Link
from casper.kb.top_down.running.engine import Workspace
from casper.kb.top_down.running.goals import State, goal_state, joined, next_branch, node_for
from casper.kb.top_down.running.readiness import closed, floundering, later
from casper.kb.top_down.running.strands import ANSWERS, BRANCHES, CLAUSES, VALUES, Choice, Cont, Strand
from casper.kb.top_down.running.tables import Consumer, Table

NESTED = object()  # a negated goal is being worked out first


def special(
    work: Workspace, link: Link, node: Node, args: tuple[Any, ...], frame: Frame, cont: Cont, strand: Strand
) -> State | None:
    """A call of a tabled, built-in, computed or control predicate."""
    if link.how == BUILT_IN:
        return _built_in(work, link, node, args, frame, cont, strand)
    if link.how == TABLED:
        _tabled(work, node.key, link.what, args, _after(node, frame, cont), strand)
        return None
    if link.how == ASKED:
        atom = Compound((node.key[0], *(freeze(arg, {}, Compound) for arg in args)))
        rows = ((answer.args, True) for answer in link.what(atom))
        offer(work, rows, args, _after(node, frame, cont), strand)
        return None
    return _control(work, link.what, node, args, frame, cont, strand)


def _after(node: Node, frame: Frame, cont: Cont) -> Cont:
    return cont if node.next is None else (node.next, frame, cont)


def waiting(work: Workspace, node: Node, frame: Frame) -> Node | None:
    """What is done first while a condition has to wait.

    Raises:
        ProgramError: nothing can be; unless such a body is to fail.
    """
    found = later(node, frame, work.links)
    if found is None and not work.floundering_fails:
        raise floundering(node, frame)
    return found


def _built_in(
    work: Workspace, link: Link, node: Node, args: tuple[Any, ...], frame: Frame, cont: Cont, strand: Strand
) -> State | None:
    walked = tuple([deref(arg) for arg in args])
    if not link.what.ready(*walked):
        first = waiting(work, node, frame)
        return None if first is None else (first, frame, cont, strand.certain)
    try:
        outcome = link.what.run(*walked)
    except work.undecided:
        if all(frozen_is_ground(freeze(arg, {})) for arg in walked):
            return node.next, frame, cont, False
        work.engines[-1].doubtful = True
        return None
    if outcome is None:
        return None
    if type(outcome) is tuple:
        top = strand.choices[-1].serial if strand.choices else 0
        for arg, value in zip(walked, outcome):
            if value is not None and not unify(arg, value, strand.trail, top):
                return None
        return node.next, frame, cont, strand.certain
    offer(work, ((values, True) for values in outcome), walked, _after(node, frame, cont), strand)
    return None


def offer(work: Workspace, rows: Iterator[tuple[Any, bool]], args: tuple[Any, ...], cont: Cont, strand: Strand) -> None:
    """Make a choice point of rows of values, each with whether it is certain; the branch goes on by taking one."""
    work.serial += 1
    strand.choices.append(Choice(len(strand.trail), work.serial, strand.certain, VALUES, rows, 0, args, cont))


def _tabled(
    work: Workspace, key: Indicator, procedure: Procedure, args: tuple[Any, ...], cont: Cont, strand: Strand
) -> None:
    holes: dict[int, Any] = {}
    frozen = tuple([freeze(arg, holes) for arg in args])
    call, engine = (key, variant(frozen)), work.engines[-1]
    work.toil += len(call[1]) // 64  # type: ignore[arg-type]
    table = work.done.get(call)
    if table is not None:
        engine.doubtful = engine.doubtful or table.doubtful
        if table.answers:
            offer(work, iter(table.answers), args, cont, strand)
        return
    table = engine.tables.get(call)
    if table is None:
        table = engine.tables[call] = Table()
        cells: dict[Any, Cell] = {}
        fresh = tuple([thaw(arg, cells) for arg in frozen])
        sink: Cont = (Node(STOP, key, _nothing, None, table), [0, *fresh], None)
        clauses = procedure.fitting(fresh).candidates(fresh)
        engine.queue.append(Strand.of(Choice(0, 0, True, CLAUSES, clauses, 0, fresh, sink)))
    engine.queue.append(Consumer(table, cont, args, strand.certain).strand())


def _nothing(_: Frame) -> tuple[Any, ...]:
    return ()


def _control(
    work: Workspace, what: object, node: Node, args: tuple[Any, ...], frame: Frame, cont: Cont, strand: Strand
) -> State | None:
    if isinstance(what, bool):
        return (node.next, frame, cont, strand.certain) if what else None
    goal = deref(args[0])
    if what == REFUTED:
        refuting = node_for(NEGATE, "call", 1, node.next)
        refuting.build = lambda _: (goal,)
        return refuting, frame, cont, strand.certain
    if type(goal) is list:
        first = waiting(work, node, frame)
        return None if first is None else (first, frame, cont, strand.certain)
    work.serial += 1
    return goal_state(joined(goal, args[1:]), _after(node, frame, cont), strand.certain, strand, work.serial)


# --- going back -----------------------------------------------------------------------------------------------------


def retried(work: Workspace, choice: Choice, strand: Strand) -> State | None:
    """What a choice point of values, answers or goals gives next; None where it fails (and where it is used up)."""
    if choice.kind == BRANCHES:
        return next_branch(choice, strand)
    if choice.kind == ANSWERS:
        return _consumed(work, choice, strand)
    found = next(choice.what, None)
    if found is None:
        strand.choices.pop()
        return None
    values, certain = found
    cells: dict[Any, Cell] = {}
    for arg, value in zip(choice.args, values):
        if value is not None and not unify(arg, inward(value, cells, work.serial), strand.trail, choice.serial):
            return None
    return None if choice.cont is None else (None, [], choice.cont, choice.certain and certain)


def _consumed(work: Workspace, choice: Choice, strand: Strand) -> State | None:
    consumer: Consumer = choice.what
    found = consumer.next()
    if found is None:
        strand.choices.pop()
        return None
    row, certain = found
    cont, args = consumer.saved.revived(work.serial)
    cells: dict[Any, Cell] = {}
    for arg, value in zip(args, row):
        if not unify(arg, thaw(value, cells, work.serial), strand.trail, choice.serial):
            return None
    return None, [], cont, consumer.certain and certain


# --- negation -------------------------------------------------------------------------------------------------------


def negated(work: Workspace, node: Node, frame: Frame, strand: Strand) -> State | object | None:
    """Whether nothing proves a goal: go on, perhaps uncertain, or fail, or `NESTED`: find out first."""
    args = node.build(frame)
    frozen = closed(node, frame, args)
    if frozen is None:
        first = waiting(work, node, frame)
        return None if first is None else (first, frame, None, strand.certain)
    link = work.links[node.key]
    if link.how == STORED:
        return None if _any_row(link, args, frozen) else (node.next, frame, None, strand.certain)
    goal = (node.key, variant(frozen))
    work.toil += len(goal[1]) // 64  # type: ignore[arg-type]
    if goal in work.verdicts:
        verdict = work.verdicts[goal]
        return None if verdict else (node.next, frame, None, strand.certain and verdict is False)
    place = work.in_progress.get(goal, work.open.get(goal))
    if place is not None:
        engine = work.engines[-1]
        engine.low = min(engine.low, place)
        return node.next, frame, None, False
    work.refute(goal, frozen, strand)
    return NESTED


def _any_row(link: Link, args: Iterable[Any], frozen: tuple[Any, ...]) -> bool:
    """Whether some stored row is an instance of a goal."""
    columns = tuple([at for at, arg in enumerate(frozen) if frozen_is_ground(arg)])
    if len(columns) == len(frozen):
        return frozen in link.what
    trail = Trail()
    for row in link.what.matching(columns, tuple([frozen[at] for at in columns])):
        fits = unify(("", *args), ("", *row), trail, 1 << 62)
        undo(trail, 0)
        if fits:
            return True
    return False

