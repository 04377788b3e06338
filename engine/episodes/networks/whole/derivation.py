"""Which tasks lie between a goal and its leaves: a derivation of what was done, and of a smallest rest.

States do not keep it: which tasks lie between is not decided while they grow. To be told it is found again, top-down
and depth first, the way that the grammar's author would read it; where none is found in so many steps, nothing is told
of tasks. Parameters and conditions are looked at (those that look back at what was done are not).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf
from typing import Any, NamedTuple

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    OPT,
    PAR,
    REP,
    Env,
    Row,
    filled,
    resolve,
    slot,
    slots_of,
    unified,
)
from casper.engine.episodes.networks.remembering import Asked, Failed
from casper.engine.episodes.networks.whole.derived import Done, Part, resolved

MOST_STEPS = 2_000  # items looked at


class _Way(NamedTuple):
    """What an item was done by: the leaves that are left, the substitution, and the parts.

    ``spare`` is how many of the leaves the items that are to come do not need, ``due`` are conditions that are open.
    """

    left: tuple[int, ...]
    env: Env
    parts: tuple[Part, ...]
    spare: float
    due: tuple[Asked, ...] = ()


class _Enough(Exception):
    """It takes too many steps."""


def derivation(methods: Methods, asking: Asking, goal: Any, leaves: Sequence[Any]) -> Done | None:
    """A derivation of just these leaves (of ours, in the order in which they are done); None where none is found."""
    search = _Search(methods, asking, goal, leaves)
    try:
        for way in search.item((CALL, goal), _Way(tuple(range(len(leaves))), {}, (), len(leaves)), False):
            if not way.left and not isinstance(asking.settled(way.due, way.env), Failed):
                return search.bound(way)
    except (_Enough, RecursionError):
        pass
    return None


class _Search:
    def __init__(self, methods: Methods, asking: Asking, goal: Any, leaves: Sequence[Any]) -> None:
        self.methods, self.asking, self.leaves = methods, asking, leaves
        self.fresh = 1 + max(map(int, slots_of((goal, tuple(leaves)), {})), default=-1)
        self.steps = 0

    def bound(self, way: _Way) -> Done:
        """The goal with everything bound that is known at the end."""
        (goal,) = way.parts
        assert isinstance(goal, Done)
        return resolved(goal, way.env)

    def row(self, row: Row, way: _Way, is_free: bool) -> Iterator[_Way]:
        """Every way to do a row; where it is free, leaves that others take may lie between its own."""
        if not row:
            yield way
            return
        needed = self.methods.least_of_row(row[1:])
        if needed > way.spare:
            return
        for first in self.item(row[0], way._replace(spare=way.spare - needed), is_free):
            after = first = first._replace(spare=first.spare + needed)
            if is_free and len(first.left) < len(way.left):  # what comes next comes later than what was taken
                last = max(set(way.left) - set(first.left))
                after = first._replace(left=tuple(at for at in first.left if at > last))
            for rest in self.row(row[1:], after, is_free):
                yield rest._replace(left=_also(first.left, after.left, rest.left))

    def item(self, item: Any, way: _Way, is_free: bool) -> Iterator[_Way]:
        """Every way to do an item."""
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise _Enough
        kind = item[0]
        if kind is ACT:
            yield from self._action(item, way, is_free)
        elif kind is CALL:
            yield from self._task(item[1], way, is_free)
        elif kind is COND:
            yield from self._condition(item[1], way)
        elif kind is OPT:
            yield from self.row(item[1], way, is_free)
            yield way
        elif kind is ALT:
            for each in item[1]:
                yield from self.item(each, way, is_free)
        elif kind is REP:
            for times in range(item[3], item[2] - 1, -1):
                if times * self.methods.least_of(item[1]) <= way.spare:
                    yield from self.row((item[1],) * times, way, is_free)
        elif kind is PAR:
            yield from self._group(item, way, is_free)
        else:
            yield from self.row(item[1], way, is_free)

    def _action(self, item: Any, way: _Way, is_free: bool) -> Iterator[_Way]:
        for number, at in enumerate(way.left if is_free else way.left[:1]):
            env = unified(item[1], self.leaves[at], way.env)
            if env is not None:
                left = (*way.left[:number], *way.left[number + 1 :])
                yield _Way(left, env, (*way.parts, at), way.spare - 1, way.due)

    def _task(self, term: Any, way: _Way, is_free: bool) -> Iterator[_Way]:
        ways = sorted(self.methods.of(term), key=lambda method: not method.body)  # all is to be used: [] comes last
        for method in ways:
            if not self._may_take(method.body, way, is_free):
                continue
            frame = [slot(self.fresh + at) for at in range(method.slots)]
            self.fresh += method.slots
            env = unified(filled(method.head, frame), resolve(term, way.env), way.env)
            if env is not None:
                for after in self.row(filled(method.body, frame), way._replace(env=env, parts=()), is_free):
                    yield after._replace(parts=(*way.parts, Done(term, after.parts)))

    def _may_take(self, body: Row, way: _Way, is_free: bool) -> bool:
        """Whether there are leaves enough for a method, and such as it has; with none it needs to take nothing."""
        least = self.methods.least_of_row(body)
        here = {indicator(self.leaves[at]) for at in way.left}
        if not self.methods.needed_by(body, self.methods.needed) <= here:
            return False
        near = (self.methods.row_distance(body, indicator(self.leaves[at])) for at in way.left)
        if is_free:
            return least <= way.spare and (not least or any(distance < inf for distance in near))
        return least <= way.spare and (not least or next(near, inf) == 0)

    def _condition(self, relation: Any, way: _Way) -> Iterator[_Way]:
        due = self.asking.due(relation) if self.asking.kb is not None else (1, relation)
        settled = (way.env, way.due) if due[0] else self.asking.settled((*way.due, due), way.env)
        if not isinstance(settled, Failed):
            yield way._replace(env=settled[0], due=settled[1])

    def _group(self, item: Any, way: _Way, is_free: bool) -> Iterator[_Way]:
        """Items that may interleave; together they take what comes first, unless others may lie between, too."""
        for done in self._members(item, 0, way, {}):
            taken = set(way.left) - set(done.left)
            if is_free or taken == set(way.left[: len(taken)]):
                yield done

    def _members(self, item: Any, at: int, way: _Way, taken: dict[int, set[int]]) -> Iterator[_Way]:
        if at == len(item[1]):
            yield way
            return
        needed = self.methods.least_of_row(item[1][at + 1 :])
        if needed > way.spare:
            return
        earlier = {leaf for other, own in taken.items() if item[2][at] >> other & 1 for leaf in own}
        least = max(earlier, default=-1)
        here = way._replace(left=tuple(leaf for leaf in way.left if leaf > least), spare=way.spare - needed)
        for done in self.item(item[1][at], here, True):
            own = set(here.left) - set(done.left)
            left = tuple(leaf for leaf in way.left if leaf not in own)
            after = done._replace(left=left, spare=done.spare + needed)
            yield from self._members(item, at + 1, after, {**taken, at: own})


def _also(before: tuple[int, ...], offered: tuple[int, ...], left: tuple[int, ...]) -> tuple[int, ...]:
    """What is left of the leaves when some of them were offered and not all taken."""
    if before is offered:
        return left
    taken = set(offered) - set(left)
    return tuple(at for at in before if at not in taken)
