"""What a domain says of its partners: fresh readings and days, and what each agent can do of a plan."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial
from threading import Lock
from typing import Any

from casper.engine.domain.agents import agent_of, partners_of
from casper.engine.domain.remembered import Remembered
from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.going import MOST_MISSED as MOST_MISSED_OF_ENDLESS
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.networks.reading import GrownReading
from casper.engine.episodes.prices import Prices, prices_of
from casper.engine.episodes.taking import MOST_MISSED
from casper.engine.explanation.situation import Situation
from casper.engine.reading.policy import Policy, policy_named
from casper.engine.reading.priors import priors_of
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.recognition.scoring import score_named
from casper.engine.verification.binding import Binding, bindings_of
from casper.engine.verification.history import Done, in_order, in_plan_order
from casper.engine.verification.matching import Agents, Matcher, NameMatcher, ParameterMatcher
from casper.engine.verification.mismatch import Mismatch
from casper.engine.verification.verified_matching import VerifyingMatcher, settle
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, Place, PlanError
from casper.kb.terms.terms import Compound
from casper.kb.terms.unification import substitute
from casper.plans.grammar.expansion import labels
from casper.plans.library import GOAL, PlanLibrary
from casper.plans.trees.plan import Plan

PRIOR = ("prior", 2)
MOST_KEPT = 8  # readings to make others of


class Readings:
    """The part of a `Domain` that reads partners."""

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

    def reading(
        self,
        policy: str = "strict",
        verification: bool = True,
        noise: float | None = None,
        goals: int = 1,
        score: str = "paper",
        budget: int | None = None,
        partner: str | None = None,
        earlier: Sequence[Compound | Done] = (),
    ) -> Reading:
        """A fresh reading of a partner; with ``noise`` and ``goals`` left alone it is the paper's.

        Readings of several partners share the library's tables and what the knowledge base said.

        Args:
            policy: ``strict`` or ``best`` (`engine.reading.policy`).
            verification: False sees action names only and never asks the knowledge base about an observation.
            noise: the factor on a score for each observation that is needless or misread; None: there are none.
            goals: how many goals the partner may pursue at once.
            score: the name of a score (`engine.recognition.scoring`).
            budget: how many states are kept (None: 20,000; of two goals at once 50,000, of more 3,000). Where there
                are more, the reading is not exact, and says so.
            partner: who is read; None: the domain's `partner`.
            earlier: statements of what was done before, oldest first: did/2 holds of them. A pair (statement, seconds)
                says when; of the others only the order is known.

        Raises:
            CasperError: no such policy or score, a price or a number of goals that is none, or priors that do not
                sum to 1. PlanError: the domain has no plans.
        """
        self._needs_plans()
        Options(noise, goals, budget=budget).check()
        known = tuple(earlier) if self.kb.depends_on_history else ()
        who = partner or self.partner
        key = (policy, verification, noise, goals, score, budget, who, known, self.kb.changes)
        with self._lock:  # partners may be read in threads of their own
            if key not in self._unread:
                options = Options(noise, goals, self._priors(), score_named(score), budget)
                fresh = self._fresh(policy_named(policy), options, verification, who, known)
                if len(self._unread) >= MOST_KEPT or any(other[-1] != key[-1] for other in self._unread):
                    self._unread.clear()
                self._unread[key] = fresh
            return self._unread[key].fork()

    def day(
        self,
        begin: float | None = None,
        abandon: float | None = None,
        needless: float | None = None,
        missed: float | None = None,
        helping: float | None = None,
        settled: float | None = None,
        verification: bool = True,
        most_missed: int | None = None,
        bounds: Bounds | None = None,
    ) -> Day[Any]:
        """A fresh day with one partner or several: goal after goal, several at once, changes of mind.

        Args:
            begin, abandon, needless, missed, helping, settled: prices (`engine.episodes.prices`); None: as the domain
                says, by ``setting(plans, begin, P)`` and so on, or the defaults.
            verification: False sees action names only and never asks the knowledge base about an observation.
            most_missed: how many leaves may go unseen before one that is seen.
            bounds: how much is kept (`engine.episodes.hypotheses.growth`).

        Raises:
            CasperError: prices or priors that make no sense. PlanError: the domain has no plans.
        """
        self._needs_plans()
        given = {"begin": begin, "abandon": abandon, "needless": needless, "missed": missed, "helping": helping}
        prices = prices_of(self.kb.rows, self._price_place, **given, settled=settled)
        if most_missed is not None and (type(most_missed) is not int or most_missed < 0):
            raise DomainError(f"most_missed is a whole number from 0, not {most_missed}")
        return Day(self._growing(verification, most_missed), prices, self._priors(), bounds or Bounds())

    def _needs_plans(self) -> None:
        if not self.library.productions:
            raise PlanError(f"the domain {self.name} has no plans to explain anything with; add them in plans.pl")

    def _growing(self, verification: bool, most_missed: int | None) -> Growing[Any]:
        """How goal instances go on: over the listed plans, where they can be listed."""
        if not self.library.is_listed:
            return self.networks(verification, MOST_MISSED_OF_ENDLESS if most_missed is None else most_missed)
        most = MOST_MISSED if most_missed is None else most_missed
        return Enumerated(self.library.ways, self._matcher(verification), self.capability, most)

    @property
    def prices(self) -> Prices:
        """What the domain says of the prices of a day, and the defaults elsewhere."""
        return prices_of(self.kb.rows, self._price_place)

    def _price_place(self, name: str) -> Place | None:
        found = [clause.place for clause in self.kb.clauses_of(("setting", 3)) if clause.head[1:3] == ("plans", name)]
        return found[-1] if found else None

    def _fresh(
        self, policy: Policy, options: Options, verification: bool, who: str, known: tuple[Compound | Done, ...]
    ) -> Reading:
        """A reading over the listed plans; where there is no end to them, over plans grown as far as is observed."""
        if self.library.is_listed:
            matcher = self._matcher(verification, who, known)
            default = who == self.partner and not known
            can = self.capability if default else partial(self.capability, partner=who, earlier=known)
            fresh = Reading(self.library, matcher, policy, can, options)
        else:
            fresh = GrownReading(self.library, self.networks(verification), policy, self.capability, options)
        fresh.words = self.kb.words
        return fresh

    def networks(self, verification: bool = True, most_missed: int = MOST_MISSED_OF_ENDLESS) -> Networks:
        """How the goals go on when plans are grown lazily (`engine.episodes.growing`): nothing is unrolled.

        Args:
            verification: False sees action names only and never asks the knowledge base about an observation.
            most_missed: how many leaves may go unseen between two observations.
        """
        library = self.library
        goals = list(zip(labels([goal for goal, _ in library.goal_terms]), [goal for goal, _ in library.goal_terms]))
        asking = Asking(self.kb if self.verifies and verification else None)
        agents = self.partner, self.robot
        by_name = not verification
        return Networks(library.tables, goals, asking, *agents, by_name=by_name, most_missed=most_missed)

    @cached_property
    def _lock(self) -> Lock:
        return Lock()

    @cached_property
    def _remembered(self) -> Remembered:
        return Remembered(self.kb)

    def _priors(self) -> dict[str, float]:
        places = {clause.head.args: clause.place for clause in self.kb.clauses_of(PRIOR)}
        return priors_of(self.kb.rows(*PRIOR), self.library.goals, places.get)

    @cached_property
    def _unread(self) -> dict[tuple[Any, ...], Reading]:
        """Readings in which nothing was observed, by their options and the state of the knowledge base."""
        return {}

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
