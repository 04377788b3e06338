"""Fresh readings of a domain's partners."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial
from threading import Lock
from typing import Any

from casper.engine.domain.partners.days import Days
from casper.engine.episodes.networks.reading import GrownReading
from casper.engine.reading.policy import Policy, policy_named
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.recognition.scoring import score_named
from casper.engine.verification.history import Done
from casper.kb.terms.terms import Compound

MOST_KEPT = 8  # readings to make others of



class Readings(Days):
    """The part of a `Domain` that reads partners."""

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

    @cached_property
    def _lock(self) -> Lock:
        return Lock()

    @cached_property
    def _unread(self) -> dict[tuple[Any, ...], Reading]:
        """Readings in which nothing was observed, by their options and the state of the knowledge base."""
        return {}
