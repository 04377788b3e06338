"""Every way in which an instance of a goal takes an observation, by the charts of listed plans and a matcher."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence

from casper.engine.collaboration.collaboration import Capability
from casper.engine.episodes.growing import Step
from casper.engine.episodes.past import Past
from casper.engine.episodes.standing import LooksBack, OpenLeaf, Standing
from casper.engine.verification.binding import Binding, filled, slots_of
from casper.engine.verification.matching import Matcher, ParameterMatcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.kb.terms.unification import variables_of
from casper.plans.trees.plan import Plan

MOST_MISSED = 5  # leaves that go unseen before one that is seen
MOST_KEPT = 50_000  # steps that are remembered
LAG = 100  # observations that can be taken back


class Taking:
    """Instances of goals over plans that are listed, as they go on.

    Args:
        plans: the library's ways.
        matcher: what can be taken for what.
        capability: what an agent can do of a plan's leaves.
        most_missed: how many leaves may go unseen before one that is seen.
    """

    def __init__(
        self, plans: Sequence[Plan], matcher: Matcher, capability: Capability, most_missed: int = MOST_MISSED
    ) -> None:
        self.plans, self.most_missed = plans, most_missed
        self.goals: Sequence[str] = tuple(dict.fromkeys(plan.label for plan in plans))
        self._matcher, self._capability = matcher, capability
        self._slots = [slots_of(plan) for plan in plans] if type(matcher) is ParameterMatcher else None
        self._verdicts = matcher if isinstance(matcher, LooksBack) else None
        self._matchers: dict[str | None, Matcher] = {}
        self._changes = 0
        self._pasts: deque[Past] = deque([()], LAG + 1)
        self._gone = 0  # observations before those pasts
        numbers = {label: number for number, label in enumerate(self.goals)}
        self._ways: list[list[int]] = [[] for _ in self.goals]
        self._named: list[dict[str, list[int]]] = []
        self._free: list[list[int]] = []  # how many parameters each leaf has
        self._having: dict[str, list[int]] = {}  # by action: the goals that have it
        for number, plan in enumerate(plans):
            self._ways[numbers[plan.label]].append(number)
            self._named.append({})
            self._free.append([len(set(variables_of(leaf))) for leaf in plan.leaves])
            for at, leaf in enumerate(plan.leaves):
                self._named[-1].setdefault(leaf.functor, []).append(at)
        for goal, ways in enumerate(self._ways):
            for name in dict.fromkeys(name for way in ways for name in self._named[way]):
                self._having.setdefault(name, []).append(goal)
        self._first: dict[tuple[int, Seen, str | None], Sequence[Step[Standing]]] = {}  # of goals that begin
        self._choices: dict[tuple[int, int | None, int], int] = {}
        self._ready: dict[tuple[int | None, int, int, str], Sequence[OpenLeaf]] = {}
        self._left: dict[tuple[int, int, int], int] = {}

    @property
    def looks_back(self) -> bool:
        """Whether verdicts depend on what was done earlier."""
        return self._verdicts is not None and self._verdicts.looks_back

    def begins_with(self, seen: Seen) -> Iterable[int]:
        """The goals that have the action."""
        names = dict.fromkeys(option.action for option, _ in options_of(seen))
        found = [self._having.get(name, []) for name in names]
        return found[0] if len(found) == 1 else sorted({goal for goals in found for goal in goals})

    def begin(self, goal: int) -> Standing:
        """No plan was chosen yet."""
        return Standing(goal)

    def steps(self, state: Standing, seen: Seen, agent: str | None) -> Sequence[Step[Standing]]:
        """Every leaf of the name that is open and takes the arguments."""
        if state.plan is not None:
            if isinstance(seen, Observation):
                if self._slots is not None and seen.is_plain:
                    return self._filled(state, seen)
                leaves = self._named[state.plan].get(seen.action)
                return self._taken(state, seen, 1.0, self._for(agent), leaves) if leaves is not None else ()
            return [step for option, weight in options_of(seen) for step in self._of(state, option, weight, agent)]
        if self.looks_back:
            return self._beginning(state.goal, seen, agent)
        self._follow_changes()
        key = (state.goal, seen, agent)
        known = self._first.get(key)
        if known is None:
            if len(self._first) > MOST_KEPT:
                self._first.clear()
            known = self._first[key] = self._beginning(state.goal, seen, agent)
        return known

    def _of(self, at: Standing, seen: Observation, weight: float, agent: str | None) -> Sequence[Step[Standing]]:
        assert at.plan is not None
        if weight == 1.0 and self._slots is not None and seen.is_plain:
            return self._filled(at, seen)
        return self._taken(at, seen, weight, self._for(agent), self._named[at.plan].get(seen.action, ()))

    def _follow_changes(self) -> None:
        if self._verdicts is not None and self._verdicts.changes != self._changes:
            self._changes = self._verdicts.changes
            self._first, self._matchers = {}, {}

    def _beginning(self, goal: int, seen: Seen, agent: str | None) -> Sequence[Step[Standing]]:
        begun = list(self._begun(Standing(goal), self._for(agent)))
        pairs = [(standing, option, weight) for standing in begun for option, weight in options_of(seen)]
        return [step for standing, option, weight in pairs for step in self._of(standing, option, weight, agent)]

    def _filled(self, at: Standing, seen: Observation) -> Sequence[Step[Standing]]:
        """The same as `_taken` says, and faster, where arguments need but be compared: no reasons are asked for."""
        goal, number, closed, entered, binding = at
        args = seen.args or ()
        ready = self._ready.get((number, closed, entered, seen.action))
        if ready is None:
            ready = self._open_leaves(at, seen.action)
        found = []
        for slots, action, after, missed, free in ready:
            if slots is None:  # a compound argument must be unified
                assert number is not None
                return self._taken(at, seen, 1.0, self._matcher, self._named[number][seen.action])
            bound = filled(slots, args, binding)
            if bound is not None:
                fresh = min(binding.count(None) - bound.count(None), free) if bound is not binding else 0
                standing = Standing(goal, number, after[0], after[1], bound)
                found.append(Step(standing, missed, action, 1.0, False, fresh))
        return found

    def _open_leaves(self, at: Standing, name: str) -> Sequence[OpenLeaf]:
        """The open leaves of the name that come after few enough unseen ones, whatever the arguments."""
        if len(self._ready) > MOST_KEPT:
            self._ready.clear()
        number, closed, entered = at.plan, at.closed, at.entered
        assert number is not None and self._slots is not None
        plan, found = self.plans[number], list[OpenLeaf]()
        for leaf in self._named[number].get(name, ()):
            if not closed >> leaf & 1:
                after = plan.chart.close((closed, entered, 0, 0), leaf)
                if after[3] <= self.most_missed:
                    slots, free = self._slots[number][leaf], self._free[number][leaf]
                    found.append((slots, plan.leaves[leaf], after[:2], after[3], free))
        self._ready[number, closed, entered, name] = found
        return found

    def _taken(
        self, at: Standing, seen: Observation, weight: float, matcher: Matcher, leaves: Sequence[int]
    ) -> Sequence[Step[Standing]]:
        goal, number, closed, entered, binding = at
        assert number is not None
        found: list[Step[Standing]] = []
        for leaf in leaves:
            if not closed >> leaf & 1:
                bound = self._matched(at, leaf, seen, matcher)
                if isinstance(bound, Mismatch):
                    continue
                plan = self.plans[number]
                after = plan.chart.close((closed, entered, 0, 0), leaf)
                if after[3] <= self.most_missed:
                    standing = Standing(goal, number, after[0], after[1], bound)
                    fresh = 0
                    if bound != binding:
                        fresh = min(binding.count(None) - bound.count(None), self._free[number][leaf])
                    found.append(Step(standing, after[3], plan.leaves[leaf], weight, False, fresh))
        return found

    def _matched(self, at: Standing, leaf: int, seen: Observation, matcher: Matcher) -> Binding | Mismatch:
        """The binding after an open leaf took the observation, and the conditions that it asks where it stands."""
        _, number, closed, entered, binding = at
        assert number is not None
        bound, chart = matcher.match(number, leaf, seen, binding), self.plans[number].chart
        if isinstance(bound, Mismatch) or not chart.guards:
            return bound
        return matcher.ask(number, chart.asked((closed, entered, 0, 0), leaf), seen, bound)

    def _begun(self, state: Standing, matcher: Matcher) -> Iterator[Standing]:
        """The state itself, or every plan of a goal for which none was chosen yet."""
        if state.plan is not None:
            yield state
            return
        for number in self._ways[state.goal]:
            binding = matcher.initial(number)
            if not isinstance(binding, Mismatch):
                yield Standing(state.goal, number, 0, 0, binding)

    def _for(self, agent: str | None) -> Matcher:
        if self._verdicts is None:
            return self._matcher
        if agent not in self._matchers:
            self._matchers[agent] = self._verdicts.of(agent, tuple(self._pasts), self._gone)
        return self._matchers[agent]
