"""The contract of a day over plans that are listed (`PlanLibrary.ways`), by their charts and a matcher.

It is also the specification of ways of growing plans that list nothing.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias, runtime_checkable

from casper.engine.collaboration.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.episodes.growing import Step, Taken
from casper.engine.episodes.past import Past, with_statement
from casper.engine.explanation.explanation import Explanation
from casper.engine.explanation.situation import Situation
from casper.engine.verification.history import in_order
from casper.engine.verification.matching import (
    Binding,
    Matcher,
    Mismatch,
    NameMatcher,
    ParameterMatcher,
    Recipe,
    Slot,
    bindings_of,
    filled,
    slots_of,
)
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.engine.verification.vocabulary import names_only
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground, substitute, variables_of
from casper.plans.trees.plan import Plan

if TYPE_CHECKING:
    import networkx as nx

MOST_MISSED = 5  # leaves that go unseen before one that is seen
MOST_KEPT = 50_000  # steps that are remembered
LAG = 100  # observations that can be taken back


@runtime_checkable
class LooksBack(Protocol):
    """A matcher whose verdicts depend on who acts, and may depend on what was done earlier."""

    partner: str  # whom observations are of that name nobody

    @property
    def changes(self) -> int:
        """How often that has changed which verdicts rest on."""

    @property
    def looks_back(self) -> bool:
        """Whether anything depends on what was done earlier."""

    def of(self, agent: str | None, pasts: Sequence[Past], gone: int) -> Matcher:
        """The matcher for an agent after these pasts, of each moment since the first ``gone`` observations."""


# what its arguments are (None: not known apart), its action, what is closed and entered after it, missed, parameters
OpenLeaf: TypeAlias = "tuple[tuple[Slot, ...] | None, Compound, tuple[int, int], int, int]"


class Standing(NamedTuple):
    """Where an instance stands: its goal, its plan (None: none was chosen yet), closed leaves, open parts, binding."""

    goal: int
    plan: int | None = None
    closed: int = 0
    entered: int = 0
    binding: Binding = ()


class Enumerated:
    """`Growing` over plans that are listed.

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

    def __reduce__(self) -> tuple[Any, ...]:
        """By what it was made of and what was observed; what was worked out is never sent."""
        recipe: Recipe | Matcher = getattr(self._matcher, "recipe", self._matcher)
        return _resumed, (self.plans, recipe, self._capability, self.most_missed, tuple(self._pasts), self._gone)

    # --- going on ----------------------------------------------------------------------------------------------------

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

    # --- where it stands ---------------------------------------------------------------------------------------------

    def choices(self, state: Standing) -> int:
        """How many leaves could come next, over all plans of a goal that has just begun."""
        general = state[:3]
        count = self._choices.get(general)
        if count is None:
            if len(self._choices) > MOST_KEPT:
                self._choices.clear()
            ways = self._ways[state.goal] if state.plan is None else [state.plan]
            count = sum(len(self.plans[way].chart.next_leaves(state.closed)) for way in ways)
            self._choices[general] = count
        return count

    def is_done(self, state: Standing) -> bool:
        """Whether no leaf that belongs to the plan is open."""
        return self.least_left(state) == 0

    def least_left(self, state: Standing) -> int:
        """The open leaves that belong to the plan; of a goal that has just begun those of its smallest one."""
        if state.plan is None:
            return min(self._open(way, 0, 0) for way in self._ways[state.goal])
        return self._open(state.plan, state.closed, state.entered)

    def _open(self, plan: int, closed: int, entered: int) -> int:
        key = (plan, closed, entered)
        left = self._left.get(key)
        if left is None:
            if len(self._left) > MOST_KEPT:
                self._left.clear()
            left = self._left[key] = (self.plans[plan].chart.belonging(entered) & ~closed).bit_count()
        return left

    def rest(self, state: Standing) -> Sequence[Compound]:
        """The open leaves that belong to the plan, in its order."""
        situation = self.situation(state)
        return tuple(situation.leaves[leaf] for leaf in situation.open_leaves if situation.belonging >> leaf & 1)

    def goal_of(self, state: Standing) -> Compound:
        """The goal with what is known of its parameters."""
        number = self._ways[state.goal][0] if state.plan is None else state.plan
        plan = self.plans[number]
        known: Compound = substitute(plan.goal, bindings_of(plan, state.binding))
        return known

    def situation(self, state: Standing) -> Situation:
        """Where the instance's plan stands (its goal's first one, while none was chosen)."""
        if state.plan is not None:
            return Situation.of(self.plans[state.plan], state.closed, state.binding)
        plan = self.plans[self._ways[state.goal][0]]
        return Situation.of(plan, 0, (None,) * len(plan.variables))

    def part(self, state: Standing, agent: str) -> CollaborativePlan | None:
        """The longest run of the rest that the agent can do (paper section III-G)."""
        return collaborative_plan(agent, self.situation(state), self._capability)

    # --- telling -----------------------------------------------------------------------------------------------------

    def tree(self, goal: int, history: Sequence[Taken[Standing]]) -> nx.DiGraph:
        """The plan with the leaves that were taken marked; a goal that took nothing is its first plan."""
        last = history[-1].step.state if history else Standing(goal)
        number = self._ways[goal][0] if last.plan is None else last.plan
        plan, progress, marks = self.plans[number], (0, 0), list[int]()
        for taken in history:
            after = (taken.step.state.closed, taken.step.state.entered)
            marks.append(self._leaf(plan, progress, after, taken.step.leaf))
            progress = after
        return Explanation(plan, tuple(marks), last.binding, 0.0, 0.0).tree()

    @staticmethod
    def _leaf(plan: Plan, before: tuple[int, int], after: tuple[int, int], action: Compound) -> int:
        """Which leaf of this action it is that leads from one state to the other."""
        open_ones = (at for at, leaf in enumerate(plan.leaves) if leaf == action and not before[0] >> at & 1)
        return next(at for at in open_ones if plan.chart.close((*before, 0, 0), at)[:2] == after)

    def reasons(self, state: Standing, seen: Seen, agent: str | None) -> Sequence[str]:
        """What the matcher refused; otherwise that the goal has no such action, or none left."""
        matcher, label = self._for(agent), self.goals[state.goal]
        found: dict[str, None] = {}
        names = [option.action for option, _ in options_of(seen)]
        has_it = False
        for standing in self._begun(state, matcher):
            assert standing.plan is not None
            for option, _ in options_of(seen):
                for leaf in self._named[standing.plan].get(option.action, ()):
                    has_it = True
                    if not standing.closed >> leaf & 1:
                        bound = self._matched(standing, leaf, option, matcher)
                        found.update(dict.fromkeys(bound.reasons if isinstance(bound, Mismatch) else ()))
        if found:
            return tuple(found)
        if not has_it:
            return (f"{label} has no {' or '.join(names)}",)
        return (f"no {' or '.join(names)} is left in {label} after what was observed",)

    def leaves(self) -> Sequence[Compound]:
        """The plans' actions, each once."""
        leaves = [leaf for plan in self.plans for leaf in plan.leaves]
        return tuple(dict.fromkeys(names_only(leaves) if isinstance(self._matcher, NameMatcher) else leaves))

    # --- the past ----------------------------------------------------------------------------------------------------

    def observed(self, seen: Seen, agent: str | None, t: float | None) -> None:
        """Remember what was done, where it was made out in full and anything depends on it."""
        past = self._pasts[-1]
        if self._verdicts is not None and self._verdicts.looks_back:
            self._matchers.clear()
            if isinstance(seen, Observation) and seen.args is not None and all(map(is_ground, seen.args)):
                statement = Compound((seen.action, self._verdicts.partner if agent is None else agent, *seen.args))
                (*_, done) = in_order([statement if t is None else (statement, t)], past)
                past = with_statement(past, *done)
        self._gone += len(self._pasts) > LAG
        self._pasts.append(past)

    def forget(self) -> None:
        """Take the last observation out of the past."""
        self._pasts.pop()
        if self.looks_back:
            self._matchers.clear()

    def fork(self) -> Enumerated:
        """One with the same past; what was worked out is shared unless it depends on the past."""
        other = copy(self)
        other._pasts = deque(self._pasts, LAG + 1)
        if self.looks_back:
            other._matchers = {}
        return other


def _resumed(
    plans: Sequence[Plan],
    recipe: Recipe | Matcher,
    capability: Capability,
    most_missed: int,
    pasts: Sequence[Past],
    gone: int,
) -> Enumerated:
    """One that remembers the same."""
    matcher = recipe[0](plans, *recipe[1:]) if isinstance(recipe, tuple) else recipe
    growing = Enumerated(plans, matcher, capability, most_missed)
    growing._pasts, growing._gone = deque(pasts, LAG + 1), gone
    return growing
