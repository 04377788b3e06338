"""Methods as states use them: a grammar compiled to items, and distances to what is observed.

The *distance* of an action from an item is how many leaves must at least be passed over unseen before an action of that
name can be observed in it: what is further than the misses that are allowed is never grown.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import inf
from typing import Any

from casper.engine.episodes.networks.items.compiling import Compiled, compiled, indicator
from casper.engine.episodes.networks.items.corners import Corners
from casper.engine.episodes.networks.items.numbering import numbered
from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    LINK,
    OPT,
    PAR,
    REP,
    SEQ,
    Env,
    Row,
    filled,
    slot,
    unified,
)
from casper.kb.terms.clauses import Indicator
from casper.plans.networks.grammar import Grammar
from casper.plans.networks.tables import Tables

MOST_DEEP = 20  # tasks within tasks that are looked at to see whether a task can be done


class Methods:
    """The methods of a grammar, and what its tables say of items."""

    def __init__(self, tables: Tables) -> None:
        self.tables, self.least = tables, tables.least
        self._compiled: dict[Indicator, tuple[Compiled, ...]] = {}
        self._distances: dict[Indicator, Mapping[Indicator, float]] = {}
        self.number = tables.number
        self.corners = Corners(self)
        self._fits: dict[tuple[Any, ...], bool] = {}
        self._first: dict[Indicator, frozenset[Indicator]] = {}

    @property
    def grammar(self) -> Grammar:
        """What was compiled."""
        return self.tables.grammar

    def of(self, term: tuple[Any, ...]) -> tuple[Compiled, ...]:
        """The methods of a task's name and arity."""
        key = term[0], len(term) - 1
        found = self._compiled.get(key)
        if found is None:
            found = self._compiled[key] = tuple(
                compiled(m.head, m.body) for m in self.grammar.methods(key) if self.tables.least_of(m.body) < inf
            )
        return found

    def fits(self, term: tuple[Any, ...], deep: int = 0) -> bool:
        """Whether some method's head fits a task (slots numbered from 0), and so do those of the tasks it must do.

        Each is looked at by itself, down to `MOST_DEEP`; beyond it is taken for granted.
        """
        known = self._fits.get(term)
        if known is None:
            if deep >= MOST_DEEP:
                return True
            self._fits[term] = True  # what comes round to itself is no hindrance
            known = self._fits[term] = any(self._method_fits(method, term, deep) for method in self.of(term))
        return known

    def _method_fits(self, method: Compiled, term: tuple[Any, ...], deep: int) -> bool:
        frame = [slot(100 + at) for at in range(method.slots)]
        env = unified(filled(method.head, frame), term, {})
        return env is not None and self._row_fits(filled(method.body, frame), env, deep)

    def _row_fits(self, row: Row, env: Env, deep: int) -> bool:
        for item in row:
            kind = item[0]
            if kind is CALL and not self.fits(numbered(item[1], env, {}), deep + 1):
                return False
            if (kind is PAR or kind is SEQ) and not self._row_fits(item[1], env, deep):
                return False
        return True

    # --- how few leaves --------------------------------------------------------------------------------------------

    def least_of(self, item: Any) -> float:
        """The fewest leaves that an item can be done with."""
        kind = item[0]
        if kind is ACT:
            return 1
        if kind is CALL:
            return self.least[item[1][0], len(item[1]) - 1]
        if kind is COND or kind is OPT:
            return 0
        if kind is LINK:
            return self.corners.least(indicator(item[1]), indicator(item[2]))
        if kind is REP:
            return item[2] * self.least_of(item[1]) if item[2] else 0
        leaves = [self.least_of(each) for each in item[1]]
        return min(leaves) if kind is ALT else sum(leaves)

    def least_of_row(self, row: Row) -> float:
        """The fewest leaves that a row of items can be done with."""
        return sum([self.least_of(item) for item in row])

    # --- what cannot be done without ---------------------------------------------------------------------------------

    @cached_property
    def needed(self) -> Mapping[Indicator, frozenset[Indicator]]:
        """By task the actions that every way to do it has, by name and arity: the greatest fixpoint."""
        every = frozenset(self.tables.bit)
        known = dict.fromkeys(self.tables.contained, every)
        changed = True
        while changed:
            changed = False
            for task in known:
                ways = [self.needed_by(method.body, known) for method in self.of((task[0], *[None] * task[1]))]
                found = frozenset.intersection(*ways) if ways else every
                if found != known[task]:
                    known[task], changed = found, True
        return known

    def needed_by(self, row: Row, known: Mapping[Indicator, frozenset[Indicator]]) -> frozenset[Indicator]:
        """The actions that every way to do a row has, where those of tasks are known."""
        found: frozenset[Indicator] = frozenset()
        for item in row:
            kind = item[0]
            if kind is ACT:
                found |= {indicator(item[1])}
            elif kind is CALL:
                found |= known[indicator(item[1])]
            elif kind is PAR or kind is SEQ:
                found |= self.needed_by(item[1], known)
            elif kind is ALT:
                found |= frozenset.intersection(*[self.needed_by((each,), known) for each in item[1]])
            elif kind is REP and item[2]:
                found |= self.needed_by((item[1],), known)
        return found

    # --- how far an action is --------------------------------------------------------------------------------------

    def distance(self, item: Any, action: Indicator) -> float:
        """How many leaves come at least before an action of the name in an item; infinity where there is none."""
        kind = item[0]
        if kind is ACT:
            return 0 if (item[1][0], len(item[1]) - 1) == action else inf
        if kind is CALL:
            return self._distance_from(action).get((item[1][0], len(item[1]) - 1), inf)
        if kind is COND:
            return inf
        if kind is LINK:
            return self.corners.distance(indicator(item[1]), indicator(item[2]), action)
        if kind is REP:
            return self.distance(item[1], action)
        if kind is ALT:
            return min([self.distance(each, action) for each in item[1]])
        if kind is PAR:
            return min([self.distance(each, action) + self.least_before(item, at) for at, each in enumerate(item[1])])
        return self.row_distance(item[1], action)

    def row_distance(self, row: Row, action: Indicator) -> float:
        """As `distance`, of a row."""
        nearest, passed = inf, 0.0
        for item in row:
            nearest = min(nearest, passed + self.distance(item, action))
            passed += self.least_of(item)
            if passed >= nearest:
                break
        return nearest

    def least_before(self, group: Any, at: int) -> float:
        """The fewest leaves of what must be over in a group before an item."""
        before = group[2][at]
        return sum([self.least_of(each) for other, each in enumerate(group[1]) if before >> other & 1]) if before else 0

    def add_first(self, row: Row, found: set[Any], names: set[Indicator]) -> None:
        """Add what may come first in a row: actions as they are, and names of what its tasks can begin with."""
        for item in row:
            kind = item[0]
            if kind is ACT:
                found.add(item[1])
                names.add(indicator(item[1]))
            elif kind is CALL:
                names |= self._first_of(indicator(item[1]))
            elif kind is LINK:
                names.update(self.corners.first(indicator(item[1]), indicator(item[2])))
            elif kind is PAR:
                for at, each in enumerate(item[1]):
                    if not self.least_before(item, at):
                        self.add_first((each,), found, names)
            elif kind is ALT:
                for each in item[1]:
                    self.add_first((each,), found, names)
            elif kind is not COND:
                self.add_first((item[1],) if kind is REP else item[1], found, names)
            if self.least_of(item):
                return

    def _first_of(self, task: Indicator) -> frozenset[Indicator]:
        """The actions that a task can begin with."""
        found = self._first.get(task)
        if found is None:
            mask = self.tables.first[task]
            found = frozenset(action for action, bit in self.tables.bit.items() if mask & bit)
            self._first[task] = found
        return found

    def _distance_from(self, action: Indicator) -> Mapping[Indicator, float]:
        """By task its distance from the action: the least fixpoint, from the tasks that have the action on."""
        found = self._distances.get(action)
        if found is None:
            known: dict[Indicator, float] = {}
            self._distances[action] = known
            bit = self.tables.bit.get(action, 0)
            holders = [task for task, mask in self.tables.contained.items() if mask & bit]
            changed = bool(holders)
            while changed:
                changed = False
                for task in reversed(holders):
                    for method in self.of((task[0], *[None] * task[1])):
                        nearest = self.row_distance(method.body, action)
                        if nearest < known.get(task, inf):
                            known[task], changed = nearest, True
            found = known
        return found
