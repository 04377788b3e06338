"""Left corners: how tasks are grown that can begin with themselves, so that nothing has to be cut.

To get somewhere a vehicle may have to get there first, for which its driver may have to get to it, for which …: what is
seen first may be done for a task at any depth. It is not decided at which. A *link* ``(LINK, A, B, moment)`` says that
the task A is under way and that B, which A can begin with, is all that was done of it, whatever lies between. It is
taken further upwards: B is what some method of a task C begins with, the rest of that method comes next, and then the
link from A to C; where A is B, nothing is left of it. (Left-corner parsing: Rosenkrantz and Lewis 1970; the tables are
by name and arity.)

Tasks that can begin with one another are a *circle*. Links are made within circles only. What a link leaves to be done
comes one after the other: where a task of a circle is begun beside others, without an order, what these take before it
is over is not found (`interleaves`; whoever grows them says that they were cut).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import inf
from typing import Any, NamedTuple, Protocol

from casper.engine.episodes.networks.items.compiling import Compiled, left_of
from casper.engine.episodes.networks.items.terms import ACT, ALT, CALL, COND, PAR, REP, Row
from casper.kb.terms.clauses import Indicator
from casper.plans.networks.tables import Tables


class Measured(Protocol):
    """What is asked of methods (`methods.Methods`)."""

    @property
    def tables(self) -> Tables:
        """The grammar's."""

    @property
    def number(self) -> Mapping[Indicator, int]:
        """Each task's number."""

    def of(self, term: tuple[Any, ...]) -> tuple[Compiled, ...]:
        """The methods of a task."""

    def least_of(self, item: Any) -> float:
        """The fewest leaves of an item."""

    def least_of_row(self, row: Row) -> float:
        """The fewest leaves of a row."""

    def least_before(self, group: Any, at: int) -> float:
        """The fewest leaves before an item of a group."""

    def row_distance(self, row: Row, action: Indicator) -> float:
        """How many leaves come at least before an action."""

    def add_first(self, row: Row, found: set[Any], names: set[Indicator]) -> None:
        """Add what may come first."""


class Corner(NamedTuple):
    """A method of ``task`` that can begin with another task of its circle.

    ``passed`` is what is over by then though nothing was seen of it (conditions, and tasks with nothing to do),
    ``begun`` the call of the other task, ``rest`` what comes after it.
    """

    task: Indicator
    method: Compiled
    passed: Row
    begun: tuple[Any, ...]
    rest: Row


class Corners:
    """The circles of a grammar, and tables of its links."""

    def __init__(self, methods: Measured) -> None:
        self.methods = methods
        self._least: dict[Indicator, Mapping[Indicator, float]] = {}
        self._distances: dict[tuple[Indicator, Indicator], Mapping[Indicator, float]] = {}
        self._first: dict[tuple[Indicator, Indicator], frozenset[Indicator]] = {}

    @cached_property
    def circle(self) -> Mapping[Indicator, int]:
        """By task of a circle the number of the circle."""
        begins = self.methods.tables.begins
        number = self.methods.number
        found: dict[Indicator, int] = {}
        for task, mask in begins.items():
            if mask >> number[task] & 1 and task not in found:
                for other, theirs in begins.items():
                    if mask >> number[other] & 1 and theirs >> number[task] & 1:
                        found[other] = number[task]
        return found

    @cached_property
    def members(self) -> Mapping[int, Sequence[Indicator]]:
        """By number of a circle its tasks."""
        found: dict[int, list[Indicator]] = {}
        for task, number in self.circle.items():
            found.setdefault(number, []).append(task)
        return found

    @cached_property
    def of(self) -> Mapping[Indicator, Sequence[Corner]]:
        """By task the methods of its circle that can begin with it."""
        found: dict[Indicator, list[Corner]] = {}
        for task, number in self.circle.items():
            for method in self.methods.of(as_call(task)):
                for passed, begun, rest in self._in_row(method.body, number):
                    found.setdefault((begun[0], len(begun) - 1), []).append(Corner(task, method, passed, begun, rest))
        return found

    def _in_row(self, row: Row, circle: int) -> Iterator[tuple[Row, Any, Row]]:
        for at, item in enumerate(row):
            for passed, begun, rest in self._in_item(item, circle):
                yield (*row[:at], *passed), begun, (*rest, *row[at + 1 :])
            if self.methods.least_of(item):
                return

    def _in_item(self, item: Any, circle: int) -> Iterator[tuple[Row, Any, Row]]:
        kind = item[0]
        if kind is CALL:
            if self.circle.get((item[1][0], len(item[1]) - 1)) == circle:
                yield (), item[1], ()
        elif kind is ALT:
            for each in item[1]:
                yield from self._in_item(each, circle)
        elif kind is REP:
            again = ((REP, item[1], max(0, item[2] - 1), item[3] - 1),) if item[3] > 1 else ()
            for passed, begun, rest in self._in_item(item[1], circle):
                yield passed, begun, (*rest, *again)
        elif kind is PAR:
            for at, each in enumerate(item[1]):
                if not self.methods.least_before(item, at):
                    earlier = tuple([x for other, x in enumerate(item[1]) if item[2][at] >> other & 1])
                    for passed, begun, rest in self._in_item(each, circle):
                        yield (*earlier, *passed), begun, left_of(item[1], item[2], at, rest)
        elif kind is not ACT and kind is not COND:
            yield from self._in_row(item[1], circle)

    def interleaves(self, circle: int) -> bool:
        """Whether tasks of the circle are begun in a group beside items that need not wait for them."""
        return any(
            any(item[0] is PAR and self._begins_beside(item, circle) for item in method.body)
            for task in self.members[circle]
            for method in self.methods.of(as_call(task))
        )

    def _begins_beside(self, group: Any, circle: int) -> bool:
        return len(group[1]) > 1 and next(self._in_item(group, circle), None) is not None

    # --- tables of links -------------------------------------------------------------------------------------------

    def least(self, target: Indicator, begun: Indicator) -> float:
        """The fewest leaves that a task still takes once another one that it began with is done."""
        known = self._least.get(target)
        if known is None:
            known = self._least[target] = self._relaxed(target, None)
        return known.get(begun, inf)

    def distance(self, target: Indicator, begun: Indicator, action: Indicator) -> float:
        """How many leaves come at least before an action of the name."""
        known = self._distances.get((target, action))
        if known is None:
            known = self._distances[target, action] = self._relaxed(target, action)
        return known.get(begun, inf)

    def _relaxed(self, target: Indicator, action: Indicator | None) -> Mapping[Indicator, float]:
        """By task that was done the least way upwards: to the target, or to the action."""
        known: dict[Indicator, float] = {target: 0.0} if action is None else {}
        changed = True
        while changed:
            changed = False
            for begun, corners in self.of.items():
                for corner in corners:
                    onward = self.methods.least_of_row(corner.rest) + known.get(corner.task, inf)
                    here = inf if action is None else self.methods.row_distance(corner.rest, action)
                    if min(onward, here) < known.get(begun, inf):
                        known[begun], changed = min(onward, here), True
        return known

    def first(self, target: Indicator, begun: Indicator) -> frozenset[Indicator]:
        """The actions that may come next while nothing is missed."""
        known = self._first.get((target, begun))
        if known is None:
            actions: set[Indicator] = set()
            seen: set[Indicator] = set()
            waiting = [begun]
            while waiting:
                for corner in self.of.get(waiting.pop(), ()):
                    self.methods.add_first(corner.rest, set(), actions)
                    if corner.task not in seen and not self.methods.least_of_row(corner.rest):
                        seen.add(corner.task)
                        waiting.append(corner.task)
            known = self._first[target, begun] = frozenset(actions)
        return known


def as_call(task: Indicator) -> tuple[Any, ...]:
    """A call of the task, whatever its arguments."""
    return (task[0], *[None] * task[1])
