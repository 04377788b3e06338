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
from itertools import islice
from typing import Any, TypeAlias

from kanren.core import eq
from unification import reify, var

State: TypeAlias = Any  # a mapping of kanren variables, perhaps a ConstrainedState
Goal: TypeAlias = Callable[[State], Iterator[State]]
Rest: TypeAlias = "tuple[Goal, Rest] | None"


class Conjunction:
    """All of the goals, in order."""

    __slots__ = ("goals",)

    def __init__(self, goals: Iterable[Goal]) -> None:
        self.goals = tuple(goals)

    def __call__(self, state: State) -> Iterator[State]:
        """The states in which every goal holds."""
        return work(self, state)


class Disjunction:
    """Any of the goals."""

    __slots__ = ("goals",)

    def __init__(self, goals: Iterable[Goal]) -> None:
        self.goals = tuple(goals)

    def __call__(self, state: State) -> Iterator[State]:
        """The states of every goal, each goal in its turn."""
        return work(self, state)


class Delayed:
    """A goal that is made when it is needed: what a relation that calls itself wraps the call in."""

    __slots__ = ("args", "make")

    def __init__(self, make: Callable[..., Goal], *args: Any) -> None:
        self.make, self.args = make, args

    def __call__(self, state: State) -> Iterator[State]:
        """Make the goal and run it."""
        return work(self, state)


def lall(*goals: Goal) -> Goal:
    """Every goal holds; without goals, always."""
    return Conjunction(goals)


def lany(*goals: Goal) -> Goal:
    """Some goal holds; without goals, never."""
    return Disjunction(goals)


def conde(*clauses: Iterable[Goal]) -> Goal:
    """Some clause holds, each clause being a conjunction of its goals."""
    return Disjunction(Conjunction(clause) for clause in clauses)


def delay(make: Callable[..., Goal], *args: Any) -> Goal:
    """``make(*args)``, but only when the search comes to it."""
    return Delayed(make, *args)


def run(n: int | None, x: Any, *goals: Goal) -> Any:
    """The values of ``x`` for which every goal holds: the first ``n``, all for 0, lazily for None (as kanren's)."""
    answers = (reify(x, state) for state in work(Conjunction(goals), {}))
    return answers if n is None else tuple(islice(answers, n) if n else answers)


def work(goal: Goal, state: State) -> Iterator[State]:
    """The states in which a goal holds: the scheduler."""
    tasks: deque[tuple[Iterator[State], Rest]] = deque()
    _begin(goal, state, None, tasks)
    while tasks:
        stream, rest = tasks.popleft()
        reached = next(stream, None)
        if reached is None:
            continue
        tasks.append((stream, rest))
        if rest is None:
            yield reached
        else:
            _begin(rest[0], reached, rest[1], tasks)


def _begin(goal: Goal, state: State, rest: Rest, tasks: deque[tuple[Iterator[State], Rest]]) -> None:
    """Queue what a goal comes down to: composed goals are taken apart here, not called."""
    waiting: list[tuple[Goal, Rest]] = [(goal, rest)]
    while waiting:
        goal, rest = waiting.pop()
        if isinstance(goal, Conjunction):
            for part in reversed(goal.goals):
                rest = (part, rest)
            if rest is None:
                tasks.append((iter((state,)), None))
            else:
                waiting.append(rest)
        elif isinstance(goal, Disjunction):
            waiting.extend((part, rest) for part in reversed(goal.goals))
        elif isinstance(goal, Delayed):  # a turn in the queue first: who only ever calls itself lets others go on
            tasks.append((iter((state,)), (_Due(goal), rest)))
        elif isinstance(goal, _Due):
            waiting.append((goal.goal.make(*goal.goal.args), rest))
        else:
            tasks.append((iter(goal(state)), rest))


class _Due:
    """A delayed goal whose turn has come; only the scheduler sees one."""

    __slots__ = ("goal",)

    def __init__(self, goal: Delayed) -> None:
        self.goal = goal

    def __call__(self, state: State) -> Iterator[State]:
        return work(self.goal.make(*self.goal.args), state)


__all__ = ["Conjunction", "Delayed", "Disjunction", "conde", "delay", "eq", "lall", "lany", "run", "var", "work"]
