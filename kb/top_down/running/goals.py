"""Goals that are terms: what ``call/N``, ``not/1`` and ``maplist/N`` are given, taken apart when they are reached."""

from __future__ import annotations

from typing import Any, TypeAlias

from casper.kb.terms.syntax import COMPARISONS
from casper.kb.top_down.compiled.cells import deref
from casper.kb.top_down.compiled.code import CALL, COMPARE, NEGATE, Frame, Node
from casper.kb.top_down.running.strands import BRANCHES, Choice, Cont, Strand

State: TypeAlias = tuple["Node | None", Frame, Cont, bool]  # what is to be done next, and whether that is certain


def _args(frame: Frame) -> tuple[Any, ...]:
    return tuple(frame[1:])


def node_for(kind: int, name: Any, arity: int, following: Node | None = None) -> Node:
    """A node for a goal whose arguments are all that its frame holds."""
    node = Node(kind, (name, arity), _args)
    node.next = following
    return node


def joined(goal: Any, extra: tuple[Any, ...]) -> Any:
    """A goal with more arguments behind its own."""
    if not extra:
        return goal
    return (*goal, *extra) if isinstance(goal, tuple) else (goal, *extra)


def goal_state(goal: Any, cont: Cont, certain: bool, strand: Strand, serial: int) -> State | None:
    """What is to be done for a known goal; None where it fails outright (a number is no goal).

    A disjunction makes a choice point of that serial.
    """
    goal = deref(goal)
    if not isinstance(goal, (str, tuple)):
        return None
    name, args = (goal[0], tuple(goal[1:])) if isinstance(goal, tuple) else (goal, ())
    frame: Frame = [0, *args]
    if name == "," and len(args) > 1:
        return _conjunction(len(args)), frame, cont, certain
    if name == ";" and len(args) > 1:
        strand.choices.append(Choice(len(strand.trail), serial, certain, BRANCHES, None, 1, args, cont))
        return _CALL_ONE, [0, args[0]], cont, certain
    if name == "\\+" and len(args) == 1:
        return node_for(NEGATE, "call", 1), frame, cont, certain
    if name in COMPARISONS and len(args) == 2:
        return node_for(COMPARE, name, 2), frame, cont, certain
    return node_for(CALL, name, len(args)), frame, cont, certain


_CALL_ONE = node_for(CALL, "call", 1)


def _conjunction(size: int) -> Node:
    following: Node | None = None
    for at in range(size, 0, -1):
        node = Node(CALL, ("call", 1), _at(at))
        node.next = following
        following = node
    assert following is not None
    return following


def _at(slot: int) -> Any:
    return lambda frame: (frame[slot],)


def next_branch(choice: Choice, strand: Strand) -> State:
    """The next alternative of a disjunction."""
    branch = choice.args[choice.at]
    choice.at += 1
    if choice.at == len(choice.args):
        strand.choices.pop()
    return _CALL_ONE, [0, branch], choice.cont, choice.certain
