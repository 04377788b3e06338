"""Aggregates: what all answers of a goal amount to, each answer once."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from typing import Any

from casper.kb.terms.clauses import Clause
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import Bindings, is_ground, unify
from casper.kb.terms.values.aggregates import aggregate
from casper.kb.terms.values.arithmetic import EvaluationFailed
from casper.kb.terms.values.effort import charge
from casper.kb.top_down.compiled.cells import deref, freeze, inward, variant
from casper.kb.top_down.compiled.code import Frame, Node
from casper.kb.top_down.compiled.unifying import unify as unify_cells
from casper.kb.top_down.linking import RESOLVED
from casper.kb.top_down.lookups import shape_of
from casper.kb.top_down.running.engine import Goal, Workspace
from casper.kb.top_down.running.readiness import open_of, waiting
from casper.kb.top_down.running.strands import NESTING, Cont, State, Strand
from casper.kb.top_down.running.tables import Table


def aggregated(work: Workspace, node: Node, frame: Frame, cont: Cont, doubt: str, strand: Strand) -> State | None:
    """Collect the answers, if they are not known, and go on with what they amount to."""
    what, atom, result = node.build(frame)
    holes = open_of(node, frame, what, atom)
    if holes is None:
        return waiting(work, node, frame, cont, doubt)
    asked = freeze(atom, holes, Compound)
    name, args = (asked[0], tuple(asked[1:])) if isinstance(asked, tuple) else (asked, ())
    goal = ((name, len(args)), variant(args))
    table, strand.collected = strand.collected or work.done.get(goal), None
    if table is not None:
        return _worked_out(work, freeze(what, holes, Compound), args, table, (node, frame, cont), doubt, strand, result)
    table = _by_look_ups(work, goal, asked)
    if table is not None:
        here = node, frame, cont
        return _worked_out(work, freeze(what, holes, Compound), args, table, here, doubt, strand, result)
    place = work.in_progress.get(goal)
    if place is not None:
        engine = work.engines[-1]
        engine.low = min(engine.low, place)
        reason = f"{node.key[0]} is part of what it is worked out of"
        return node.next, frame, cont, doubt or reason
    strand.node, strand.frame, strand.cont, strand.doubt = node, frame, cont, doubt
    strand.event = NESTING
    atom = deref(atom)
    work.collect(goal, tuple([freeze(arg, holes) for arg in atom[1:]]) if args else (), strand)
    return None


def _by_look_ups(work: Workspace, goal: Goal, asked: Term) -> Table | None:
    """The answers of a goal that stands for look-ups in stored relations; None for any other."""
    link = work.links[goal[0]]
    if link.how != RESOLVED or len(link.what.all) != 1 or not isinstance(asked, Compound):
        return None
    clause: Clause = link.what.all[0].clause
    values = unify(clause.head, asked, {})
    if values is None:
        return None
    shaped = shape_of(clause.body, values)
    planned = None if shaped is None else work.links.lookups.of(shaped[0])
    if shaped is None or planned is None:
        return None
    _, constants, names = shaped
    places = [names.get(arg, -1) if type(arg) is Variable else -1 for arg in asked.args]
    if any(place < 0 and not is_ground(arg) for place, arg in zip(places, asked.args)):
        return None
    table = Table()
    for row in planned.answers(constants, work.look):
        table.add(tuple([arg if at < 0 else row[at] for at, arg in zip(places, asked.args)]), "", deque())
    work.done[goal] = table
    return table


def _worked_out(
    work: Workspace,
    what: Term,
    args: tuple[Term, ...],
    table: Table,
    here: tuple[Node, Frame, Cont],
    doubt: str,
    strand: Strand,
    result: Any,
) -> State | None:
    node, frame, cont = here
    charge(8 * len(table.answers))
    reason = _doubt(table)
    if reason:
        return node.next, frame, cont, doubt or reason
    try:
        value = len(table.known) if what == "count" else aggregate(what, _each(args, table))
    except EvaluationFailed as failure:
        return node.next, frame, cont, doubt or failure.sentence
    if value is None:
        return None
    fits = unify_cells(result, inward(value, {}, work.serial), strand.trail, strand.top)
    return (node.next, frame, cont, doubt) if fits else None


def _each(args: tuple[Term, ...], table: Table) -> list[Bindings]:
    return [_bindings(args, row) for row, doubt in table.answers if not doubt]


def _doubt(table: Table) -> str:
    """Why an answer is undefined, where one is."""
    certain: set[Hashable] = {key for key, is_certain in table.known.items() if is_certain}
    if len(certain) == len(table.known):
        return ""
    return next(doubt for row, doubt in table.answers if doubt and variant(row) not in certain)


def _bindings(args: tuple[Term, ...], row: tuple[Term, ...]) -> Bindings:
    """The values of a goal's variables in one of its answers."""
    found: Bindings = {}
    for arg, value in zip(args, row):
        value = freeze(value, {}, Compound)
        if type(arg) is Variable and arg not in found:
            found[arg] = value
        elif arg != value:
            extended = unify(arg, value, found)
            assert extended is not None
            found = extended
    return found
