"""What is left of a state, as leaves: a smallest rest, in an order that the plan allows."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile
from typing import Any, NamedTuple

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    LINK,
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

MOST_LEAVES = 300  # of a rest that is told
MOST_DEEP = 100  # tasks within tasks


class Leaf(NamedTuple):
    """A leaf that is yet to be done: the action, who does it, and the mask of the leaves before it."""

    action: Any
    by: Any
    before: int


class Frontier:
    """The smallest rest of a row of items, with what its methods say of parameters.

    Of a task the first method is taken that is smallest by the grammar's table and whose conditions are not known to
    fail, nor to make one of those fail that are ``open``; a part that may be left out is left out.
    """

    def __init__(self, methods: Methods, asking: Asking, row: Row, open_: Sequence[Asked] = ()) -> None:
        self.methods, self.asking, self.open = methods, asking, tuple(open_)
        self.env: Env = {}
        self.fresh = len(slots_of(row, {}))
        self.found: list[Leaf] = []
        self._row(row, 0, 0)
        self.leaves = [leaf._replace(action=resolve(leaf.action, self.env), by=self._who(leaf)) for leaf in self.found]

    def _who(self, leaf: Leaf) -> Any:
        return None if leaf.by is None else resolve(leaf.by, self.env)

    def _row(self, row: Row, before: int, deep: int) -> int:
        """Add the leaves of a row; the mask of them."""
        mask = 0
        for item in row:
            mask |= self._item(item, before | mask, deep)
        return mask

    def _item(self, item: Any, before: int, deep: int) -> int:
        kind = item[0]
        if kind is ACT:
            return self._leaf(item, before)
        if kind is COND:
            return self._ask(item[1])
        if kind is OPT or len(self.found) >= MOST_LEAVES:
            return 0
        if kind is CALL:
            return self._task(item[1], before, deep)
        if kind is LINK:
            return self._link(item, before, deep)
        if kind is ALT:
            return self._item(min(item[1], key=self.methods.least_of), before, deep)
        if kind is REP:
            return self._row((item[1],) * item[2], before, deep)
        if kind is PAR:
            return self._group(item, before, deep)
        return self._row(item[1], before, deep)

    def _leaf(self, item: Any, before: int) -> int:
        self.found.append(Leaf(item[1], item[2], before))
        return 1 << len(self.found) - 1

    def _ask(self, relation: Any) -> int:
        """Take over what a condition settles; one that fails, or is open, is left alone: much may change till then."""
        if self.asking.kb is not None:
            settled = self.asking.settled((self.asking.due(relation), *self.open), self.env)
            if not isinstance(settled, Failed):
                self.env, self.open = settled
        return 0

    def _group(self, item: Any, before: int, deep: int) -> int:
        masks: list[int] = []
        for each, earlier in zip(item[1], item[2]):
            needed = before
            for other, mask in enumerate(masks):
                needed |= mask if earlier >> other & 1 else 0
            masks.append(self._item(each, needed, deep))
        total = 0
        for mask in masks:
            total |= mask
        return total

    def _task(self, term: Any, before: int, deep: int) -> int:
        if deep >= MOST_DEEP:
            return 0
        fitting: list[tuple[float, int, Row, Env]] = []
        for number, method in enumerate(self.methods.of(term)):
            frame = [slot(self.fresh + at) for at in range(method.slots)]
            env = unified(filled(method.head, frame), resolve(term, self.env), self.env)
            if env is not None:
                body = filled(method.body, frame)
                fitting.append((self.methods.least_of_row(body) + self._obstacles(body, env), number, body, env))
            self.fresh += method.slots
        if not fitting:
            return 0
        _, _, body, self.env = min(fitting, key=lambda each: each[:2])
        return self._row(body, before, deep + 1)

    def _link(self, item: Any, before: int, deep: int) -> int:
        """The shortest way upwards from what was done of a task."""
        _, target, begun, moment = item
        goal, mask = indicator(target), 0
        closed = unified(target, begun, self.env)
        fits = closed is not None and indicator(begun) == goal and not self._obstacles((), closed)
        if deep >= MOST_DEEP or fits:
            self.env = closed if fits and closed is not None else self.env
            return 0
        ways: list[tuple[float, int, Row, Env]] = []
        for number, corner in enumerate(self.methods.corners.of.get(indicator(begun), ())):
            frame = [slot(self.fresh + at) for at in range(corner.method.slots)]
            self.fresh += corner.method.slots
            env = unified(filled(corner.begun, frame), begun, self.env)
            if env is not None:
                row = (*filled(corner.rest, frame), (LINK, target, filled(corner.method.head, frame), moment))
                least = self.methods.least_of_row(row) + self._obstacles(filled(corner.passed, frame), env)
                ways.append((least, number, row, env))
        if ways:
            _, _, row, self.env = min(ways, key=lambda each: each[:2])
            mask = self._row(row, before, deep + 1)
        return mask

    def _obstacles(self, body: Row, env: Env) -> float:
        """A great number where a condition that the body begins with is known to fail as things are.

        What looks back at what was done is not known yet where something is to be done before.
        """
        if self.asking.kb is None:
            return 0.0
        begins_with = takewhile(lambda item: item[0] is COND, body)
        due = [self.asking.due(item[1]) for item in begins_with]
        settled = self.asking.settled((*(one for one in due if not (one[0] and self.found)), *self.open), env)
        return 1e9 if isinstance(settled, Failed) else 0.0
