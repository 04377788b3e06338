"""Goals that are terms: what ``call/N``, ``not/1`` and ``maplist/N`` are given, taken apart when they are reached.

Control has its reading in logic: ``(C -> T ; E)`` is ``(C, T ; \\+ C, E)``, and ``forall(C, A)`` is ``\\+ (C, \\+ A)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from casper.kb.errors import ProgramError, Undefined
from casper.kb.terms.clauses import AGGREGATE as AGGREGATE_NAME
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound
from casper.kb.terms.values.aggregates import check_way
from casper.kb.top_down.compiled.cells import deref, freeze
from casper.kb.top_down.compiled.code import AGGREGATE, CALL, COMPARE, NEGATE, Frame, Node
from casper.kb.top_down.running.strands import BRANCHES, Choice, Cont, State, Strand


def _args(frame: Frame) -> tuple[Any, ...]:
    return tuple(frame[1:])


def node_for(kind: int, name: Any, arity: int, following: Node | None = None) -> Node:
    """A node for a goal whose arguments are all that its frame holds."""
    node = Node(kind, (name, arity), _args)
    node.next = following
    return node


def joined(goal: Any, extra: tuple[Any, ...]) -> Any:
    """A goal with more arguments behind its own.

    Raises:
        ProgramError: it is made of other goals, and takes no more.
    """
    if not extra:
        return goal
    if is_control(goal):
        text = term_text(freeze(goal, {}, Compound))
        raise ProgramError(f"({text}) is a whole goal and takes no more arguments: write a rule for it, and call that")
    return (*goal, *extra) if isinstance(goal, tuple) else (goal, *extra)


def is_control(goal: Any) -> bool:
    """Whether a goal is made of other goals, and complete."""
    if not isinstance(goal, tuple):
        return False
    return goal[0] in (",", ";") or ((goal[0], len(goal) - 1) in CONTROL and goal[0] not in ("true", "fail", "false"))


def goal_state(goal: Any, cont: Cont, doubt: str, strand: Strand, serial: int) -> State | None:
    """What is to be done for a known goal. A disjunction makes a choice point of that serial.

    Raises:
        Undefined: a number is no goal.
        ProgramError: an aggregate is none.
    """
    goal = deref(goal)
    if not isinstance(goal, (str, tuple)):
        raise Undefined(f"call/1 needs a goal, not {term_text(goal)}")
    name, args = (goal[0], tuple(goal[1:])) if isinstance(goal, tuple) else (goal, ())
    frame: Frame = [0, *args]
    if name in (",", "->") and args:
        return _conjunction(len(args)), frame, cont, doubt
    if name == ";" and args:
        strand.push(Choice(len(strand.trail), serial, doubt, BRANCHES, None, 1, _branches(args), cont))
        return next_branch(None, strand.choices[-1], strand)
    if (name, len(args)) in (("\\+", 1), ("not", 1)):
        return _negation(args[0], cont, doubt)
    if (name, len(args)) == ("forall", 2):
        return _negation((",", args[0], ("\\+", args[1])), cont, doubt)
    if (name, len(args)) in (("findall", 3), (AGGREGATE_NAME, 3)):
        return _aggregate(name, args, cont, doubt)
    if name in COMPARISONS and len(args) == 2:
        return node_for(COMPARE, name, 2), frame, cont, doubt
    return node_for(CALL, name, len(args)), frame, cont, doubt


def _negation(goal: Any, cont: Cont, doubt: str) -> State:
    goal = deref(goal)
    if isinstance(goal, tuple) and not is_control(goal) and goal[0] not in COMPARISONS:
        return node_for(NEGATE, goal[0], len(goal) - 1), [0, *goal[1:]], cont, doubt
    return node_for(NEGATE, "call", 1), [0, goal], cont, doubt


def _aggregate(name: str, args: tuple[Any, ...], cont: Cont, doubt: str) -> State:
    what, goal, result = args
    what = deref(what) if name == AGGREGATE_NAME else ("bag", what)
    check_way(freeze(what, {}, Compound), None)
    return node_for(AGGREGATE, name, 3), [0, what, ("call", goal), result], cont, doubt


def _branches(args: tuple[Any, ...]) -> tuple[Any, ...]:
    """The alternatives of a disjunction; what comes after a condition that decides needs that it fails."""
    first = deref(args[0])
    if len(args) > 1 and isinstance(first, tuple) and first[0] == "->" and len(first) == 3:
        otherwise = args[1] if len(args) == 2 else (";", *args[1:])
        return (",", first[1], first[2]), (",", ("\\+", first[1]), otherwise)
    return args


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


def next_branch(_: object, choice: Choice, strand: Strand) -> State:
    """The next alternative of a disjunction."""
    branches: Sequence[Any] = choice.args
    branch = branches[choice.at - 1]
    choice.at += 1
    if choice.at > len(branches):
        strand.pop()
    return _CALL_ONE, [0, branch], choice.cont, choice.doubt
