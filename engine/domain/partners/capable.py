"""Who is watched and who helps, which leaf an observation may be, and what each agent can do of a plan."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from casper.engine.domain.partners.agents import agent_of, partners_of
from casper.engine.domain.partners.remembered import Remembered
from casper.engine.explanation.situation import Situation
from casper.engine.verification.binding import Binding, bindings_of
from casper.engine.verification.history import Done, in_order, in_plan_order
from casper.engine.verification.matching import Agents, Matcher, NameMatcher, ParameterMatcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.verified_matching import VerifyingMatcher, settle
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import substitute
from casper.plans.library import GOAL, PlanLibrary
from casper.plans.trees.plan import Plan


class Capable:
    """The part of a `Domain` that knows its agents."""

    name: str
    kb: KnowledgeBase
    library: PlanLibrary
    verifies: bool

    @property
    def partner(self) -> str:
        """The agent that is watched: ``setting(agents, partner, Name)``, else the first human there is."""
        return self._remembered.of("partner", lambda: agent_of(self.kb, "partner", "human"))

    @property
    def partners(self) -> tuple[str, ...]:
        """All who are watched: those of ``setting(agents, partner, Name)``, else every human there is."""
        return partners_of(self.kb)

    @property
    def robot(self) -> str:
        """The agent that helps: ``setting(agents, robot, Name)``, else the first robot there is."""
        return self._remembered.of("robot", lambda: agent_of(self.kb, "robot", "robot"))

    @cached_property
    def _remembered(self) -> Remembered:
        return Remembered(self.kb)

    def _matcher(
        self, verification: bool, partner: str | None = None, earlier: Sequence[Compound | Done] = ()
    ) -> Matcher:
        if not verification:
            return NameMatcher(self.library.ways)
        if not self.verifies:
            return ParameterMatcher(self.library.ways, Agents(partner or self.partner, self.robot))
        return VerifyingMatcher(self.library.ways, self.kb, partner or self.partner, self.robot, earlier)

    def capability(
        self,
        situation: Situation,
        leaf: int,
        agent: str,
        partner: str | None = None,
        earlier: Sequence[Compound | Done] = (),
    ) -> tuple[Compound, bool]:
        """A leaf's action with every part filled in that can be, and whether the knowledge base lets the agent do it.

        What was done (by the ``partner``, after what was done ``earlier``), and what comes before the leaf, is taken
        as done by then. A domain that verifies nothing lets nobody do anything.
        """
        plan = situation.plan
        binding = situation.binding or (None,) * len(plan.variables)
        by = plan.actions[leaf].by
        who = None if by is None else Agents(self.partner, self.robot).named(substitute(by, bindings_of(plan, binding)))
        if not self.verifies or (isinstance(who, str) and who != agent):
            return situation.leaves[leaf], False
        known = bindings_of(plan, self._settled(plan, binding))
        action = substitute(plan.leaves[leaf], known)
        statement = Compound((action.functor, agent, *action.args))
        if self.kb.depends_on_history:
            who, done = partner or self.partner, situation.done | plan.chart.before[leaf] & situation.belonging
            actions = [substitute(other, known) for other in plan.leaves]
            theirs = [Compound((a.functor, who, *a.args)) for a in actions]
            verdict = self.kb.verify(statement, in_plan_order(theirs, done, plan.chart.before, in_order(earlier)))
        else:
            verdict = self.kb.verify(statement)
        filled = verdict.completed if verdict.valid else verdict.statement
        return Compound((filled.functor, *filled.args[1:])), verdict.valid is True

    def _settled(self, plan: Plan, binding: Binding) -> Binding:
        """The binding as far as the goal's condition completes it."""
        if not self.kb.defines(*GOAL):
            return binding
        known = binding[: len(plan.variables)]
        found = self._remembered.of((id(plan), known), lambda: settle(self.kb, plan, known), plan)
        return binding if isinstance(found, Mismatch) else found
