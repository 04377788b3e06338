"""Growth: every way in which open items take one observation.

An open task is grown by its methods only until a first leaf meets the observation; the rest stays a task. What a task
makes of an observation is worked out once for every task that differs in more than the names of its variables, and
kept (tabling); tables of the grammar rule out most of it before it begins (`methods`). Ways that lead to the same are
one, with the fewest misses. What a task that can begin with itself begins with is left open (`corners`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.items.compiling import indicator, left_of
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.terms import (
    ACT,
    ALT,
    CALL,
    COND,
    LINK,
    PAR,
    REP,
    Env,
    Row,
    Slot,
    filled,
    outward,
    resolve,
    slot,
    slots_of,
    unified,
)
from casper.engine.episodes.networks.passing import Grown, Passed, Passing, Taken, closed_of
from casper.engine.verification.matching import ROBOT
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term

Barred: TypeAlias = tuple[int, int]  # a circle, and the misses with which a task of it is left to links
FREE: Barred = (-1, -1)


class Growth(Passing):
    """How items take one observation, by an agent, with so many misses at most.

    Args:
        methods: the grammar.
        asking: the knowledge base.
        action: what was observed, a term whose open slots are unknown arguments; only its name counts where
            ``arguments`` is None.
        robot: who is meant by ``robot``.
        noted: where reasons are written down that kept something from being taken.
    """

    def __init__(
        self,
        methods: Methods,
        asking: Asking,
        action: Any,
        arity: int | None,
        agent: str | None,
        robot: str | None,
        noted: list[str] | None = None,
    ) -> None:
        super().__init__(methods, asking, noted)
        self.agent, self.robot, self.action, self.name = agent, robot, action, action[0]
        self.by_name = arity is None
        arities = {a for name, a in methods.tables.bit if name == self.name} if arity is None else {arity}
        self.indicators: list[Indicator] = [(self.name, a) for a in sorted(arities)]
        self._grown: dict[tuple[Any, int], list[Grown]] = {}
        self._linked: dict[tuple[Any, int], list[Grown]] = {}

    # --- taking ----------------------------------------------------------------------------------------------------

    def reach(self, item: Any, budget: float) -> bool:
        """Whether the action may be met in the item with so many misses."""
        return any([self.methods.distance(item, action) <= budget for action in self.indicators])

    def row(self, row: Row, env: Env, budget: int, barred: Barred) -> Iterator[Taken]:
        """Every way in which a row takes the observation: in its first item, or with that passed over."""
        passed: list[Passed] = [(env, 0, ())]
        for at, item in enumerate(row):
            for before, missed, due in passed:
                if self.reach(item, budget - missed):
                    for taken in self.item(item, before, budget - missed, barred):
                        rest = (*taken.rest, *row[at + 1 :])
                        yield taken._replace(rest=rest, missed=missed + taken.missed, due=(*due, *taken.due))
            passed = [
                (after, missed + more, (*due, *asked))
                for before, missed, due in passed
                for after, more, asked in self.passing(item, before, budget - missed)
            ]
            if not passed:
                return

    def item(self, item: Any, env: Env, budget: int, barred: Barred) -> Iterator[Taken]:
        """Every way in which an item takes the observation."""
        kind = item[0]
        if kind is CALL:
            yield from self._call(item[1], env, budget, barred)
        elif kind is ACT:
            taken = self._action(item, env)
            if taken is not None:
                yield taken
        elif kind is PAR:
            yield from self._group(item, env, budget, barred)
        elif kind is ALT:
            for each in item[1]:
                if self.reach(each, budget):
                    yield from self.item(each, env, budget, barred)
        elif kind is REP:
            yield from self._repeated(item, env, budget, barred)
        elif kind is LINK:
            yield from self._link(item, env, budget)
        elif kind is not COND:  # a row, optional or not
            yield from self.row(item[1], env, budget, barred)

    def _action(self, item: Any, env: Env) -> Taken | None:
        term, by = item[1], item[2]
        if term[0] != self.name:
            return None
        after = env
        if by is not None and self.agent is not None:
            who = resolve(by, env)
            who = self.robot if who == ROBOT and self.robot is not None else who
            bound = unified(who, self.agent, after)
            if bound is None:
                self._note(lambda: f"{_shown(resolve(term, env))} is {_shown(who)}'s step, not {self.agent}'s")
                return None
            after = bound
        if not self.by_name:
            bound = unified(term, self.action, after)
            if bound is None:
                self._note(lambda: f"{_shown(resolve(term, env))} is to be done, not {_shown(self.action)}")
                return None
            after = bound
        leaf = resolve(term, after)
        refused = self.asking.refusal(leaf, self.agent)
        if refused:
            for reason in refused:
                self._note(reason)
            return None
        before = resolve(term, env)
        settled = sum([old.__class__ is Slot and new.__class__ is not Slot for old, new in zip(before, leaf)])
        return Taken(after, (), 0, leaf, by is not None, (), settled)

    def _group(self, item: Any, env: Env, budget: int, barred: Barred) -> Iterator[Taken]:
        _, items, before = item
        tried: set[Any] = set()
        unordered = not any(before)
        for at, each in enumerate(items):
            if not self.reach(each, budget - self.methods.least_before(item, at)):
                continue
            if unordered:
                same = resolve(each, env)
                if same in tried:  # equal siblings are one
                    continue
                tried.add(same)
            earlier = tuple([other for number, other in enumerate(items) if before[at] >> number & 1])
            for start, missed, due in self.passing_row(earlier, env, budget):
                for taken in self.item(each, start, budget - missed, barred):
                    rest = left_of(items, before, at, taken.rest)
                    yield taken._replace(rest=rest, missed=missed + taken.missed, due=(*due, *taken.due))

    def _repeated(self, item: Any, env: Env, budget: int, barred: Barred) -> Iterator[Taken]:
        _, each, least, most = item
        rest = ((REP, each, max(0, least - 1), most - 1),) if most > 1 else ()
        for taken in self.item(each, env, budget, barred):
            yield taken._replace(rest=(*taken.rest, *rest))
        if rest:
            for start, missed, due in self.passing(each, env, budget):
                if missed:  # without a miss it is as good as to begin with this one
                    for taken in self.item(rest[0], start, budget - missed, barred):
                        yield taken._replace(missed=missed + taken.missed, due=(*due, *taken.due))

    # --- tasks -----------------------------------------------------------------------------------------------------

    def _call(self, term: Any, env: Env, budget: int, barred: Barred) -> Iterator[Taken]:
        circle = self.methods.corners.circle.get(indicator(term), -2)
        if (circle, budget) == barred:
            return
        closed, names = closed_of(term, env)
        for grown in self._grow(closed, budget, circle):
            yield self._taken(grown, names, env)

    def _link(self, item: Any, env: Env, budget: int) -> Iterator[Taken]:
        """What a task that is under way makes of the observation: what comes after some task that was done in it."""
        closed, names = closed_of(item, env)
        key = (closed, budget)
        known = self._linked.get(key)
        if known is None:
            self._linked[key] = []  # what comes round to itself has nothing to add
            outside, self.fresh = self.fresh, 0
            own = slots_of(closed, {})
            found: dict[Any, Grown] = {}
            for row, start, due in self._upwards(closed, len(own)):
                for taken in self.row(row, start, budget, FREE):
                    self._keep(taken._replace(due=(*due, *taken.due)), own, found)
            self.fresh = outside
            known = self._linked[key] = list(found.values())
        for grown in known:
            yield self._taken(grown, names, env)

    def _grow(self, term: Any, budget: int, circle: int) -> list[Grown]:
        """What a task with its slots numbered from 0 makes of the observation."""
        key = (term, budget)
        known = self._grown.get(key)
        if known is None:
            outside, self.fresh = self.fresh, 0
            own = slots_of(term, {})
            found: dict[Any, Grown] = {}
            if circle < 0:
                for body, env in self._bodies(term, len(own)):
                    for taken in self.row(body, env, budget, FREE):
                        self._keep(taken, own, found)
            else:
                self._grow_circle(term, budget, circle, found)
            self.fresh = outside
            known = self._grown[key] = list(found.values())
        return known

    def _grow_circle(self, term: Any, budget: int, circle: int, found: dict[Any, Grown]) -> None:
        """As `_grow`, of a task that can begin with itself: what was seen is of some task of its circle."""
        own = slots_of(term, {})
        self.fresh = len(own)
        self.was_cut = self.was_cut or self.methods.corners.interleaves(circle)
        moment = self.asking.now if self.asking.looks_back else 0
        for task in self.methods.corners.members[circle]:
            for method in self.methods.of((task[0], *[None] * task[1])):
                frame = [slot(self.fresh + number) for number in range(method.slots)]
                self.fresh += method.slots
                link = (LINK, term, filled(method.head, frame), moment)
                for taken in self.row(filled(method.body, frame), {}, budget, (circle, budget)):
                    self._keep(taken._replace(rest=(*taken.rest, link)), own, found)


def _shown(term: Any) -> str:
    return term_text(as_term(outward(term)) if isinstance(term, tuple) else outward(term))
