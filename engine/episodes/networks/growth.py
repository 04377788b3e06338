"""Growth: every way in which open items take one observation.

An open task is grown by its methods only until a first leaf meets the observation; the rest stays a task. What a task
makes of an observation is worked out once for every task that differs in more than the names of its variables, and
kept (tabling); tables of the grammar rule out most of it before it begins (`methods`). Ways that lead to the same are
one, with the fewest misses. What a task that can begin with itself begins with is left open (`corners`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias

from casper.engine.episodes.networks.asking import Asked, Asking, Failed
from casper.engine.episodes.networks.compiling import indicator, left_of
from casper.engine.episodes.networks.methods import Methods
from casper.engine.episodes.networks.terms import (
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
    Slot,
    filled,
    moved,
    numbered,
    outward,
    resolve,
    slot,
    slots_of,
    unified,
)
from casper.engine.verification.matching import ROBOT
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term

MOST_TRIED = 100  # links looked at to see whether one can close
MOST_PASSED = 30  # tasks within one another that are passed over
Barred: TypeAlias = tuple[int, int]  # a circle, and the misses with which a task of it is left to links
FREE: Barred = (-1, -1)
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


class Growth:
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
        self.methods, self.asking, self.agent, self.robot = methods, asking, agent, robot
        self.action, self.name, self.noted = action, action[0], noted
        self.by_name = arity is None
        arities = {a for name, a in methods.tables.bit if name == self.name} if arity is None else {arity}
        self.indicators: list[Indicator] = [(self.name, a) for a in sorted(arities)]
        self.fresh, self.moment = 0, -1  # when conditions are due that are asked now; -1: now
        self.was_cut = False
        self._grown: dict[tuple[Any, int], list[Grown]] = {}
        self._linked: dict[tuple[Any, int], list[Grown]] = {}
        self._passed: dict[tuple[Any, int, int], list[Grown] | None] = {}

    # --- taking ----------------------------------------------------------------------------------------------------

    def reach(self, item: Any, budget: float) -> bool:
        """Whether the action may be met in the item with so many misses."""
        return any(self.methods.distance(item, indicator) <= budget for indicator in self.indicators)

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
        closed, names = _closed(term, env)
        for grown in self._grow(closed, budget, circle):
            yield self._taken(grown, names, env)

    def _link(self, item: Any, env: Env, budget: int) -> Iterator[Taken]:
        """What a task that is under way makes of the observation: what comes after some task that was done in it."""
        closed, names = _closed(item, env)
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

    def _taken(self, grown: Grown, names: list[Any], env: Env) -> Taken:
        values, rest, leaf, due = grown[:4]
        if grown.slots:
            base, self.fresh = self.fresh, self.fresh + grown.slots
            values, rest, leaf, due = moved((values, rest, leaf, due), base)
        after = env.copy()
        for name, value in zip(names, values):
            after[name] = value
        return Taken(after, rest, grown.missed, leaf, grown.is_theirs, due, grown.settled)

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

    def can_close(self, row: Row, env: Env, due: tuple[Asked, ...]) -> bool:
        """Whether every task that is open or under way may still be done, by what is known of its parameters."""
        for item in row:
            if item[0] is LINK and not self._can_close(item, env, due):
                return False
            if item[0] is CALL and not self.methods.fits(numbered(item[1], env, {})):
                return False
            if item[0] is PAR and not all(self.can_close((each,), env, due) for each in item[1]):
                return False
            if item[0] is SEQ and not self.can_close(item[1], env, due):
                return False
        return True

    def _can_close(self, link: Any, env: Env, due: tuple[Asked, ...]) -> bool:
        """Whether there is a way upwards from what was done of a task to all of it, by their parameters and conditions.

        After `MOST_TRIED` steps it is taken for granted.
        """
        if self.asking.kb is None and len(link[1]) == 1:
            return True
        start = numbered((link, _about(link, due, env)), env, {})
        known = self.asking.closing.get(start)
        if known is None:
            outside = self.fresh
            known = self.asking.closing[start] = self._search(start)
            self.fresh = outside
        return known

    def _search(self, start: Any) -> bool:
        seen, waiting = {start}, [start]
        while waiting and len(seen) < MOST_TRIED:
            link, due = waiting.pop()
            closed = unified(link[1], link[2], {})
            if closed is not None and not isinstance(self.asking.settled(due, closed), Failed):
                return True
            for row, env, asked in self._upwards(link, len(slots_of((link, due), {}))):
                settled = self.asking.settled((*due, *asked), env)
                if not isinstance(settled, Failed):
                    after = numbered((row[-1], _about(row[-1], settled[1], settled[0])), settled[0], {})
                    if after not in seen:
                        seen.add(after)
                        waiting.append(after)
        return bool(waiting)

    def _keep(self, taken: Taken, own: Any, found: dict[Any, Grown]) -> None:
        settled = self.asking.settled(taken.due, taken.env) if taken.due else (taken.env, ())
        if isinstance(settled, Failed):
            for reason in settled.reasons:
                self._note(reason)
            return
        env, due = settled
        if not self.can_close(taken.rest, env, due):
            return
        names: dict[Any, Any] = {}
        parts = numbered((tuple(own), taken.rest, taken.leaf, due), env, names)
        key = (*parts, taken.is_theirs)
        before = found.get(key)
        if before is None or before.missed > taken.missed:
            values, rest, leaf, open_ = parts
            found[key] = Grown(values, rest, leaf, open_, taken.missed, taken.is_theirs, len(names), taken.settled)

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

    # --- passing over ----------------------------------------------------------------------------------------------

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
        closed, names = _closed(item, env)
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

    def _note(self, reason: str | Callable[[], str]) -> None:
        if self.noted is not None:
            self.noted.append(reason if isinstance(reason, str) else reason())


def _closed(term: Any, env: Env) -> tuple[Any, list[Any]]:
    """A term with its slots numbered from 0, and the slots that they were."""
    names: dict[Any, Any] = {}
    return numbered(term, env, names), list(names)


def _about(link: Any, due: tuple[Asked, ...], env: Env) -> tuple[Asked, ...]:
    """The open conditions that say something of a link's slots."""
    if not due:
        return ()
    slots = slots_of(resolve(link, env), {})
    return tuple([asked for asked in due if any(each in slots for each in slots_of(resolve(asked[1], env), {}))])


def _shown(term: Any) -> str:
    return term_text(as_term(outward(term)) if isinstance(term, tuple) else outward(term))
