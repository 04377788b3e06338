"""Conjunction and disjunction of goals, fair and flat: drop-ins for kanren's ``lall``, ``conde`` and ``run``.

kanren's own ``lall`` interleaves nested generators: a conjunction costs the square of its intermediate states, and a
long chain of goals ends in a RecursionError. Here a composed goal is data; one queue of tasks works it off:

* a task is a stream of states with what is still to be done to each of them (a linked list of goals);
* taking one state from a stream costs the same however many streams have finished;
* every task gets its turn, so an infinite stream never starves another;
* depth is bounded by memory only, since nothing is nested.

A composed goal is still a function from a state to an iterator of states, so it mixes with anyone's goals.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import wraps
from itertools import islice
from types import GeneratorType
from typing import Any, ParamSpec, TypeAlias

from unification import reify, var

from casper.kb.goals.occurs import State, unified

Goal: TypeAlias = Callable[[State], Iterator[State]]
Rest: TypeAlias = "tuple[Goal, Rest] | None"
Tasks: TypeAlias = "deque[tuple[Iterator[Any], Rest]]"
P = ParamSpec("P")


class Conjunction:
    """All of the goals, in order."""

    __slots__ = ("goals",)

    def __init__(self, goals: Iterable[Goal]) -> None:
        self.goals = _kept(goals)

    def __call__(self, state: State) -> Iterator[State]:
        """The states in which every goal holds."""
        return Stream(self, state)


class Disjunction:
    """Any of the goals."""

    __slots__ = ("goals",)

    def __init__(self, goals: Iterable[Goal]) -> None:
        self.goals = _kept(goals)

    def __call__(self, state: State) -> Iterator[State]:
        """The states of every goal, each goal in its turn."""
        return Stream(self, state)


class Staged:
    """A goal that is made of the state when the search comes to it, or None where nothing holds."""

    __slots__ = ("make",)

    def __init__(self, make: Callable[[State], Goal | None]) -> None:
        self.make = make

    def __call__(self, state: State) -> Iterator[State]:
        """Make the goal and run it."""
        return Stream(self, state)


class _Kept:
    """An iterator that is drawn from as far as somebody looks, and can be looked through again."""

    __slots__ = ("drawn", "source")

    def __init__(self, source: Iterator[Goal]) -> None:
        self.source, self.drawn = source, list[Goal]()

    def __iter__(self) -> Iterator[Goal]:
        at = 0
        while True:
            if at == len(self.drawn):
                found = next(self.source, None)
                if found is None:
                    return
                self.drawn.append(found)
            yield self.drawn[at]
            at += 1


def _kept(goals: Iterable[Goal]) -> Iterable[Goal]:
    return _Kept(goals) if isinstance(goals, Iterator) else tuple(goals)


def eq(left: Any, right: Any) -> Goal:
    """Both terms are the same; a variable is never the same as a term that contains it."""

    def goal(state: State) -> Iterator[State]:
        found = unified(left, right, state)
        return iter(()) if found is False else iter((found,))

    return goal


def lall(*goals: Goal | Iterable[Goal]) -> Goal:
    """Every goal holds; without goals, always. One iterable of goals will do, too."""
    return Conjunction(_alone(goals))


def lany(*goals: Goal | Iterable[Goal]) -> Goal:
    """Some goal holds; without goals, never. One iterable of goals will do, too; an iterator may be endless."""
    return Disjunction(_alone(goals))


def conde(*clauses: Iterable[Goal] | Iterator[Iterable[Goal]]) -> Goal:
    """Some clause holds, each clause being a conjunction of its goals. One iterator of clauses may be endless."""
    found: Any = clauses[0] if len(clauses) == 1 and isinstance(clauses[0], Iterator) else clauses
    return Disjunction(map(Conjunction, found) if isinstance(found, Iterator) else [Conjunction(c) for c in found])


def _alone(goals: tuple[Any, ...]) -> Iterable[Goal]:
    """The goals themselves, where they were handed in as one iterable."""
    return goals[0] if len(goals) == 1 and isinstance(goals[0], Iterable) else goals


def delay(make: Callable[..., Goal], *args: Any, **options: Any) -> Goal:
    """``make(*args)``, but only when the search comes to it; kanren calls it ``Zzz``."""
    return Staged(lambda _: make(*args, **options))


def defrel(make: Callable[P, Goal]) -> Callable[P, Goal]:
    """A relation that may call itself: each call is a goal that is made when the search comes to it.

        @defrel
        def path(a, b):
            z = var()
            return conde([edge(a, b)], [edge(a, z), path(z, b)])
    """

    @wraps(make)
    def call(*args: P.args, **options: P.kwargs) -> Goal:
        return Staged(lambda _: make(*args, **options))

    return call


def run(n: int | None, x: Any, *goals: Goal, results_filter: Callable[[Iterator[Any]], Any] | None = None) -> Any:
    """The values of ``x`` for which every goal holds: the first ``n``, all for 0, lazily for None (as kanren's).

    ``results_filter`` gets the answers as they come, and gives those to be kept.
    """
    answers: Any = (reify(x, state) for state in Stream(Conjunction(goals), {}))
    if results_filter is not None:
        answers = results_filter(answers)
    return answers if n is None else tuple(islice(answers, n) if n else answers)


class Stream:
    """The states in which a goal holds, and the scheduler that finds them.

    What a goal of somebody else's hands on of a composed goal, by ``return goal(state)`` or ``yield from goal(state)``,
    is worked off in the queue of the one who asks: so such goals may call themselves as deep as they like.
    """

    __slots__ = ("_first", "tasks")

    def __init__(self, goal: Goal, state: State) -> None:
        self.tasks: Tasks = deque()
        self._first: tuple[Goal, State] | None = (goal, state)

    def __iter__(self) -> Stream:
        return self

    def __next__(self) -> State:
        """The next state."""
        if self._first is not None:
            goal, state = self._first
            self._first = None
            _begin(goal, state, None, self.tasks)
        tasks = self.tasks
        while tasks:
            stream, rest = tasks.popleft()
            reached = next(stream, None)
            if reached is None:
                continue
            if type(stream) is GeneratorType and stream.gi_yieldfrom is not None:
                _take_over(stream, rest, tasks)
            tasks.append((stream, rest))
            if rest is None:
                return reached
            _begin(rest[0], reached, rest[1], tasks)
        raise StopIteration

    def unbegun(self) -> tuple[Goal, State] | None:
        """The goal and the state, where nothing was asked for yet: whoever takes them asks instead."""
        first, self._first = self._first, None
        return first


def _take_over(stream: Iterator[Any], rest: Rest, tasks: Tasks) -> None:
    """Of a generator that only hands on what a composed goal finds: the tasks of that goal."""
    inner: Any = stream
    while type(inner) is GeneratorType:
        inner = inner.gi_yieldfrom
    if isinstance(inner, Stream):
        while inner.tasks:
            task, more = inner.tasks.popleft()
            tasks.append((task, _joined(more, rest)))


def _joined(first: Rest, then: Rest) -> Rest:
    goals = []
    while first is not None:
        goals.append(first[0])
        first = first[1]
    for goal in reversed(goals):
        then = (goal, then)
    return then


def _begin(goal: Goal, state: State, rest: Rest, tasks: Tasks) -> None:
    """Queue what a goal comes down to: composed goals are taken apart here, not called."""
    waiting: list[tuple[Goal, Rest]] = [(goal, rest)]
    while waiting:
        goal, rest = waiting.pop()
        if isinstance(goal, Conjunction):
            for part in reversed(tuple(goal.goals)):
                rest = (part, rest)
            if rest is None:
                tasks.append((iter((state,)), None))
            else:
                waiting.append(rest)
        elif isinstance(goal, Disjunction):
            if isinstance(goal.goals, tuple):
                waiting.extend((part, rest) for part in reversed(goal.goals))
            else:  # perhaps without end: one after the other, each when its turn comes
                tasks.append((((part, state) for part in goal.goals), (_DRAWN, rest)))
        elif isinstance(goal, Staged):  # a turn in the queue first: who only ever calls itself lets others go on
            tasks.append((iter(((goal, state),)), (_DUE, rest)))
        elif goal is _DRAWN:
            goal, state = state
            waiting.append((goal, rest))
        elif goal is _DUE:
            staged, state = state
            made = staged.make(state)
            if made is not None:
                waiting.append((made, rest))
        else:
            _ask(goal(state), rest, tasks)


def _ask(stream: Iterable[State], rest: Rest, tasks: Tasks) -> None:
    """Queue the states of a goal of somebody else's."""
    handed_on = stream.unbegun() if isinstance(stream, Stream) else None
    if handed_on is None:
        tasks.append((iter(stream), rest))
    else:
        tasks.append((iter((handed_on,)), (_DRAWN, rest)))


def _DRAWN(state: State) -> Iterator[State]:
    """Stands in the queue for a goal that comes with its state; only the scheduler sees it."""
    return iter(())


def _DUE(state: State) -> Iterator[State]:
    """Stands in the queue for a staged goal that comes with its state; only the scheduler sees it."""
    return iter(())


__all__ = [
    "Conjunction",
    "Disjunction",
    "Goal",
    "Staged",
    "State",
    "Stream",
    "conde",
    "defrel",
    "delay",
    "eq",
    "lall",
    "lany",
    "run",
    "var",
]
