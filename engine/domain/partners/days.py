"""Days with partners, and how goals go on in them: over listed plans, or over plans grown as far as is observed."""

from __future__ import annotations

from typing import Any

from casper.engine.domain.partners.capable import Capable
from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.growing import Growing
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.going import MOST_MISSED as MOST_MISSED_OF_ENDLESS
from casper.engine.episodes.networks.networks import Networks
from casper.engine.episodes.prices import Prices, prices_of
from casper.engine.episodes.taking import MOST_MISSED
from casper.engine.reading.priors import priors_of
from casper.kb.errors import DomainError, Place, PlanError
from casper.plans.grammar.expansion import labels

PRIOR = ("prior", 2)



class Days(Capable):
    """The part of a `Domain` that reads days."""

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

    def _priors(self) -> dict[str, float]:
        places = {clause.head.args: clause.place for clause in self.kb.clauses_of(PRIOR)}
        return priors_of(self.kb.rows(*PRIOR), self.library.goals, places.get)
