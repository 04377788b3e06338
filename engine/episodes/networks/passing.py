"""What becomes of open items of which nothing is seen: every way in which they are over, and what their methods are.

What a task is passed over with is worked out once for every task that differs in more than the names of its variables
(tabling). Ways that lead to the same are one, with the fewest misses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.closing import Closing
from casper.engine.episodes.networks.items.compiling import indicator
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.numbering import numbered
from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    LINK,
    OPT,
    REP,
    Env,
    Row,
    filled,
    moved,
    slot,
    slots_of,
    unified,
)
from casper.engine.episodes.networks.remembering import Asked, Failed

MOST_PASSED = 30  # tasks within one another that are passed over
Passed: TypeAlias = tuple[Env, int, tuple[Asked, ...]]  # the substitution, leaves that were missed, conditions due


class Taken(NamedTuple):
    """One way: the substitution, what is left, misses, the leaf, whether the plan says whose it is, conditions due."""

    env: Env
    rest: Row
    missed: int
    leaf: Any
    is_theirs: bool
    due: tuple[Asked, ...]
    settled: int = 0  # arguments of the leaf of which nothing was known


class Grown(NamedTuple):
    """What a task makes of an observation, with slots numbered anew: the values of its own slots come first."""

    values: Row
    rest: Row
    leaf: Any
    due: tuple[Asked, ...]
    missed: int
    is_theirs: bool
    slots: int
    settled: int


class Passing:
    """How items are over unseen, with so many misses at most.

    Args:
        methods: the grammar.
        asking: the knowledge base.
        noted: where reasons are written down that kept something from being done.
    """

    def __init__(self, methods: Methods, asking: Asking, noted: list[str] | None = None) -> None:
        self.methods, self.asking, self.noted = methods, asking, noted
        self.fresh, self.moment = 0, -1  # when conditions are due that are asked now; -1: now
        self.was_cut = False
        self.closing = Closing(methods, asking)
        self._passed: dict[tuple[Any, int, int], list[Grown] | None] = {}

    def passing_row(self, row: Row, env: Env, budget: int) -> list[Passed]:
        """Every way in which the items of a row are over unseen, with at most so many misses."""
        passed: list[Passed] = [(env, 0, ())]
        for item in row:
            passed = [
                (after, missed + more, (*due, *asked))
                for before, missed, due in passed
                for after, more, asked in self.passing(item, before, budget - missed)
            ]
        return passed

    def passing(self, item: Any, env: Env, budget: int) -> list[Passed]:
        """Every way in which an item is over unseen; of those that come to the same the one with fewest misses."""
        kind = item[0]
        if kind is OPT:
            return [(env, 0, ())]
        if kind is ACT:
            return [(env, 1, ())] if budget > 0 else []
        if kind is COND:
            return [(env, 0, () if self.asking.kb is None else (self.asking.due(item[1], moment=self.moment),))]
        if self.methods.least_of(item) > budget:
            return []
        if kind is CALL or kind is LINK:
            return self._passing_call(item, env, budget)
        if kind is ALT:
            return [passed for each in item[1] for passed in self.passing(each, env, budget)]
        if kind is REP:
            return self.passing_row((item[1],) * item[2], env, budget)
        return self.passing_row(item[1], env, budget)

    def _passing_call(self, item: Any, env: Env, budget: int) -> list[Passed]:
        closed, names = closed_of(item, env)
        found: list[Passed] = []
        for grown in self._pass(closed, budget):
            taken = self._taken(grown, names, env)
            found.append((taken.env, taken.missed, taken.due))
        return found

    def _pass(self, item: Any, budget: int) -> list[Grown]:
        key = (item, budget, self.moment)
        if key in self._passed:
            known = self._passed[key]
            if known is None:  # it is passed over within itself
                self.was_cut = True
                return []
            return known
        if sum(1 for known in self._passed.values() if known is None) > MOST_PASSED:
            self.was_cut = True
            return []
        self._passed[key] = None
        outside, self.fresh = self.fresh, 0
        own = slots_of(item, {})
        found: dict[Any, Grown] = {}
        for body, env, asked in self._ways(item, len(own)):
            if self.methods.least_of_row(body) <= budget:
                for after, missed, due in self.passing_row(body, env, budget):
                    self._keep(Taken(after, (), missed, (), False, (*asked, *due)), own, found)
        self.fresh = outside
        self._passed[key] = known = list(found.values())
        return known

    def _ways(self, item: Any, slots: int) -> Iterator[tuple[Row, Env, tuple[Asked, ...]]]:
        """What a task, or one under way, is over with."""
        if item[0] is CALL:
            for body, env in self._bodies(item[1], slots):
                yield body, env, ()
            return
        closed = unified(item[1], item[2], {})
        if closed is not None:
            yield (), closed, ()
        yield from self._upwards(item, slots)

    # --- what tasks are done with ----------------------------------------------------------------------------------

    def _bodies(self, term: Any, slots: int) -> Iterator[tuple[Row, Env]]:
        """The bodies of the methods that fit a task whose slots are numbered from 0."""
        self.fresh = slots
        for method in self.methods.of(term):
            if method.is_plain:
                frame, env = list(term[1:]), dict[Any, Any]()
                count = len(frame)
            else:
                frame, count = [], 0
            base = self.fresh
            self.fresh += method.slots - count
            frame += [slot(base + number) for number in range(method.slots - count)]
            if not method.is_plain:
                bound = unified(filled(method.head, frame), term, {})
                if bound is None:
                    continue
                env = bound
            yield filled(method.body, frame), env

    def _upwards(self, link: Any, slots: int) -> Iterator[tuple[Row, Env, tuple[Asked, ...]]]:
        """What comes next where a task was done that another one began with: the rest of a method, and a link on."""
        _, target, begun, moment = link
        self.fresh = slots
        for corner in self.methods.corners.of.get(indicator(begun), ()):
            frame = [slot(self.fresh + number) for number in range(corner.method.slots)]
            self.fresh += corner.method.slots
            env = unified(filled(corner.begun, frame), begun, {})
            if env is not None:
                passed = filled(corner.passed, frame)
                onward = (LINK, target, filled(corner.method.head, frame), moment)
                now, self.moment = self.moment, moment
                ways = self.passing_row(passed, env, 0)
                self.moment = now
                for after, _, due in ways:
                    yield (*filled(corner.rest, frame), onward), after, due

    # --- what comes of it ------------------------------------------------------------------------------------------

    def _taken(self, grown: Grown, names: list[Any], env: Env) -> Taken:
        values, rest, leaf, due = grown[:4]
        if grown.slots:
            base, self.fresh = self.fresh, self.fresh + grown.slots
            values, rest, leaf, due = moved((values, rest, leaf, due), base)
        after = env.copy()
        for name, value in zip(names, values):
            after[name] = value
        return Taken(after, rest, grown.missed, leaf, grown.is_theirs, due, grown.settled)

    def _keep(self, taken: Taken, own: Any, found: dict[Any, Grown]) -> None:
        settled = self.asking.settled(taken.due, taken.env) if taken.due else (taken.env, ())
        if isinstance(settled, Failed):
            for reason in settled.reasons:
                self._note(reason)
            return
        env, due = settled
        names: dict[Any, Any] = {}
        parts = numbered((tuple(own), taken.rest, taken.leaf, due), env, names)
        key = (*parts, taken.is_theirs)
        before = found.get(key)
        if before is None and not self.can_close(taken.rest, env, due):
            return
        if before is None or before.missed > taken.missed:
            values, rest, leaf, open_ = parts
            found[key] = Grown(values, rest, leaf, open_, taken.missed, taken.is_theirs, len(names), taken.settled)

    def can_close(self, row: Row, env: Env, due: tuple[Asked, ...]) -> bool:
        """Whether every task that is open or under way may still be done, by what is known of its parameters."""
        outside = self.fresh
        found = self.closing.can_close(row, env, due, self._upwards)
        self.fresh = outside
        return found

    def _note(self, reason: str | Callable[[], str]) -> None:
        if self.noted is not None:
            self.noted.append(reason if isinstance(reason, str) else reason())


def closed_of(term: Any, env: Env) -> tuple[Any, list[Any]]:
    """A term with its slots numbered from 0, and the slots that they were."""
    names: dict[Any, Any] = {}
    return numbered(term, env, names), list(names)
