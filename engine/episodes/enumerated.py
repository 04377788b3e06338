"""The contract of a day over plans that are listed (`PlanLibrary.ways`), by their charts and a matcher.

It is also the specification of ways of growing plans that list nothing. How instances take observations is `taking`;
here is where they stand, what is told of them, and what they know of the past.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from copy import copy
from typing import TYPE_CHECKING, Any

from casper.engine.collaboration.collaboration import Capability, CollaborativePlan, collaborative_plan
from casper.engine.episodes.growing import Taken
from casper.engine.episodes.past import Past, with_statement
from casper.engine.episodes.standing import Standing
from casper.engine.episodes.taking import LAG, MOST_KEPT, Taking
from casper.engine.explanation.explanation import Explanation
from casper.engine.explanation.situation import Situation
from casper.engine.verification.binding import bindings_of
from casper.engine.verification.history import in_order
from casper.engine.verification.matching import Matcher, NameMatcher, Recipe
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.observation import Observation, Seen, options_of
from casper.engine.verification.vocabulary import names_only
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import is_ground, substitute
from casper.plans.trees.plan import Plan

if TYPE_CHECKING:
    import networkx as nx


class Enumerated(Taking):
    """`Growing` over plans that are listed; how it is made is `Taking`'s."""

    def __reduce__(self) -> tuple[Any, ...]:
        """By what it was made of and what was observed; what was worked out is never sent."""
        recipe: Recipe | Matcher = getattr(self._matcher, "recipe", self._matcher)
        return _resumed, (self.plans, recipe, self._capability, self.most_missed, tuple(self._pasts), self._gone)

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
