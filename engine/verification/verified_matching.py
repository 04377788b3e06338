"""Matching with the knowledge base: whether the partner may have done what they are taken to have done, and why not.

Verdicts are remembered for as long as the knowledge base stays as it is: by all readings of a domain where nothing
depends on what happened earlier (did/2), otherwise until the next observation.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from casper.engine.verification.binding import Binding, binding_of, bindings_of
from casper.engine.verification.conditions import Conditions
from casper.engine.verification.history import Done, in_order
from casper.engine.verification.matching import Agents, ParameterMatcher, Recipe
from casper.engine.verification.mismatch import Mismatch, Refused
from casper.engine.verification.observation import Observation
from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import is_ground, substitute, unify
from casper.plans.trees.plan import Plan

MOST_REMEMBERED = 200_000  # matches; then all are forgotten
Question: TypeAlias = tuple[int, int, Observation, Binding]  # plan, leaf, observation, binding before


class VerifyingMatcher(ParameterMatcher):
    """Parameters, the goal's own condition, and the validity of what the partner is taken to have done.

    Forks share what was asked. A knowledge base may change at any time: what it said before is forgotten then.
    ``earlier`` is what was done before the first observation, oldest first, with seconds where they are known. did/2
    has the time of an observation that came with one, and of any other that it was later than all before.
    """

    def __init__(
        self,
        plans: Sequence[Plan],
        kb: KnowledgeBase,
        partner: str,
        robot: str | None = None,
        earlier: Sequence[Compound | Done] = (),
    ) -> None:
        super().__init__(plans, Agents(partner, robot))
        self.kb, self.partner, self._earlier = kb, partner, tuple(earlier)
        self._conditions = Conditions(kb)
        self._histories: list[tuple[Done, ...]] = [in_order(earlier)]  # after each observation
        self._gone = 0  # observations before those
        self._forget()

    @property
    def recipe(self) -> Recipe:
        """How another process makes one for the same plans."""
        return VerifyingMatcher, self.kb, self.partner, self.agents.robot, self._earlier

    def _forget(self) -> None:
        self._changes, self._looks_back = self.kb.changes, self.kb.depends_on_history
        self._goals: dict[tuple[int, Binding], Binding | Mismatch] = {}
        self._answers: dict[Question, Binding | Mismatch] = {}

    def initial(self, plan: int) -> Binding | Mismatch:
        """What the goal's condition alone settles: ``goal(breakfast(F)) :- biscuits(F)`` makes F the biscuits."""
        return self._allowed(plan, (None,) * len(self.plans[plan].variables))

    def match(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        """Unify, then ask the knowledge base about the goal and about the action."""
        if self.kb.changes != self._changes or len(self._answers) > MOST_REMEMBERED:
            self._forget()
        key = (plan, leaf, observation, binding)
        answer = self._answers.get(key)
        if answer is None:
            answer = self._answers[key] = self._asked(plan, leaf, observation, binding)
        return answer

    def _asked(self, plan: int, leaf: int, observation: Observation, binding: Binding) -> Binding | Mismatch:
        result = super().match(plan, leaf, observation, binding)
        if isinstance(result, Mismatch):
            return result
        result = self._allowed(plan, result)
        if isinstance(result, Mismatch):
            return result
        action = substitute(self.plans[plan].leaves[leaf], bindings_of(self.plans[plan], result))
        verdict = self.kb.verify(Compound((action.functor, self.partner, *action.args)), self._histories[-1])
        return Refused(verdict.reasons) if verdict.valid is False else result

    def observed(self, observation: Observation) -> None:
        """Remember the action for did/2, where it is known in full."""
        self._histories.append(self._after(observation))
        self._past_changed()

    def _after(self, observation: Observation) -> tuple[Done, ...]:
        """What happened so far, and this."""
        history = self._histories[-1]
        if observation.args is None or not all(is_ground(arg) for arg in observation.args):
            return history
        statement = Compound((observation.action, self.partner, *observation.args))
        return in_order([statement if observation.t is None else (statement, observation.t)], history)

    def ask(
        self, plan: int, due: Sequence[tuple[int, bool]], observation: Observation, binding: Binding
    ) -> Binding | Mismatch:
        """What the knowledge base says of the conditions, at the moment when each was due.

        One that several values would satisfy stays open, behind the parameters, until more is known.
        """
        chosen, moment = self.plans[plan], self._gone + len(self._histories) - 1
        width = len(chosen.variables)
        values, waiting = binding[:width], list[Any](binding[width:])
        for number, is_past in due:
            looks_back = self._conditions.looks_back(chosen.conditions[number].term)
            waiting.append((number, moment + is_past if looks_back else 0))
        before: Binding | None = None
        while waiting and values != before:  # what one settles another may need
            before, still = values, list[Any]()
            for number, then in waiting:
                if 0 < then < self._gone:  # what had happened by then is not known any more
                    still.append((number, then))
                    continue
                history = self._histories[max(then - self._gone, 0)] if then <= moment else self._after(observation)
                answer = self._conditions.ask(chosen.conditions[number].term, bindings_of(chosen, values), history)
                if isinstance(answer, Refusal):
                    return Refused(answer.reasons)
                if answer is None:
                    still.append((number, then))
                else:
                    values = binding_of(chosen, answer)
            waiting = still
        return (*values, *sorted(waiting))

    def forget(self) -> None:
        """Take the last observation out of the history."""
        self._histories.pop()
        self._past_changed()

    def _past_changed(self) -> None:
        if self._looks_back:
            self._answers = {}

    @property
    def looks_back(self) -> bool:
        """Whether a verdict may depend on what was done earlier (did/2)."""
        return self.kb.depends_on_history

    @property
    def changes(self) -> int:
        """How often the knowledge base has changed."""
        return self.kb.changes

    def of(self, agent: str | None, pasts: Sequence[Sequence[Done]], gone: int = 0) -> VerifyingMatcher:
        """The matcher for an agent (None: the partner); what was asked of the partner is shared.

        ``pasts`` are what was done before each observation since the first ``gone`` ones, and before the next.
        """
        other = object.__new__(VerifyingMatcher)
        other.__dict__.update(self.__dict__)
        other._histories, other._gone = [tuple(past) for past in pasts], gone
        if self.looks_back or agent not in (None, self.partner):
            other._answers = {}
        other.partner = self.partner if agent is None else agent
        return other

    def fork(self) -> VerifyingMatcher:
        """One with the same past."""
        other = object.__new__(VerifyingMatcher)
        other.__dict__.update(self.__dict__)
        other._histories = list(self._histories)
        if self._looks_back:
            other._answers = dict(self._answers)
        return other

    def _allowed(self, plan: int, binding: Binding) -> Binding | Mismatch:
        width = len(self.plans[plan].variables)
        key = (plan, binding[:width])
        if key not in self._goals:
            stated = self.kb.defines("goal", 1)
            self._goals[key] = settle(self.kb, self.plans[plan], key[1]) if stated else key[1]
        allowed = self._goals[key]
        return allowed if isinstance(allowed, Mismatch) else (*allowed, *binding[width:])


def settle(kb: KnowledgeBase, plan: Plan, binding: Binding) -> Binding | Mismatch:
    """The binding completed by the goal's condition where only one value will do; a mismatch where none does."""
    known = bindings_of(plan, binding)
    goal = Compound(("goal", as_term(substitute(plan.goal, known))))
    answers: list[Binding] = []
    try:
        for answer in kb.instances(goal):
            unified = unify(goal, answer, known)
            completed = None if unified is None else binding_of(plan, unified)
            if completed is not None and completed not in answers:
                answers.append(completed)
            if len(answers) > 1:
                return binding
    except (BudgetExceeded, Undefined):
        return binding  # unknown is not no
    if answers:
        return answers[0]
    refusal = kb.why_not(goal)
    return Refused(refusal.reasons if refusal is not None else ())
